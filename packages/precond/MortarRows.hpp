#pragma once
#include <suture/precond/PrimalRows.hpp>

#include <map>
#include <utility>
#include <vector>

namespace suture {

/// Constraints that local problems on the two sides of closed rows of several terms (a mortar) share in BDDC, without a primal unknown for
/// every one of these rows: of a group of rows whose expressed unknowns lie inside one local problem i, and the unknowns that express them
/// in one local problem j, the rigid motions of the line, as integrals against the rows' own functions. With q such a motion,
///
///     sum_s q_s u_s  (on i)  =  sum_m (M^T q)_m u_m  (on j),
///
/// where those u_m that are primal alone count by themselves. An expressed unknown that would be primal alone (at the end of a seam) is
/// expressed in this way, too. On each j the right-hand sides are made orthonormal, because rows that share unknowns depend on each other,
/// and what is left is private: primal unknowns that only j and the rows on i know. Rows that straddle two j are left out.
class MortarRows {
 public:
  /// \param torn  the torn space, or the space itself where a rank has none; \param choice  of that. Collective.
  MortarRows(const InterfaceSpace& space, const InterfaceSpace& torn, const PrimalChoice& choice);

  struct Row {
    std::vector<std::pair<int, double>> entries;  ///< position in the trace, coefficient
    std::vector<PrimalRows::Term> terms;
  };
  /// Rows of a local problem beside those of its entities.
  const std::vector<Row>& of(int local) const { return rows_[local]; }
  /// Primal unknowns of a local problem that are private, as they move.
  const std::vector<InterfaceLayout::Unknown>& privateOf(int local) const { return private_[local]; }
  /// Terms that stand for an expressed unknown that is primal alone, or null.
  const std::vector<PrimalRows::Term>* instead(int place) const {
    const auto found = instead_.find(place);
    return found == instead_.end() ? nullptr : &found->second;
  }

 private:
  class Maker;
  std::vector<std::vector<Row>> rows_;
  std::vector<std::vector<InterfaceLayout::Unknown>> private_;
  std::map<int, std::vector<PrimalRows::Term>> instead_;
};

}  // namespace suture
