#pragma once
#include <suture/answer/Solution.hpp>
#include <suture/pairs/ContactPiece.hpp>
#include <suture/pairs/Overclosure.hpp>
#include <suture/solver/ProblemSize.hpp>

#include <string>
#include <vector>

namespace suture {

/// Results by entries of the scene's list `Contact`, for reports: the pairs of the springs of a softened contact as one pair.
struct EntryResults {
  Solution solution;
  std::vector<ContactPiece> pieces;
  ProblemSize size;  ///< with their numbers of pairs and pieces, on rank 0
};

/// Joins the pairs of springs that press on the same place: forces, bounds and works are sums; the gap is that of the bodies, negative by
/// the overclosure; the state is that of the first spring, which closes first and slips last. Local (rank 0; elsewhere a copy).
EntryResults resultsOfEntries(const std::vector<ContactLine>& lines, const Solution& solution, const std::vector<ContactPiece>& pieces,
                              const ProblemSize& size);

/// Names of the entries. Local.
std::vector<std::string> entryNames(const std::vector<ContactLine>& lines);

/// Warnings about pressures beyond the range of their law, one for each contact. Local (rank 0; nothing elsewhere).
/// \param solution  of resultsOfEntries()
std::vector<std::string> overclosureNotes(const std::vector<ContactLine>& lines, const Solution& solution, int dimension);

}  // namespace suture
