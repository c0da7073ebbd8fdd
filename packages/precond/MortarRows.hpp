#pragma once
#include <suture/precond/PrimalRows.hpp>

#include <map>
#include <utility>
#include <vector>

namespace suture {

/// Constraints that local problems on the two sides of closed rows of several terms (a mortar) share in BDDC, without a primal unknown for
/// every row. A group consists of the rows whose expressed unknowns lie inside one local problem i, and whose expressing unknowns lie in
/// one local problem j. Its constraints are the rigid motions of the line, as integrals against the rows' own functions. With q such a
/// motion,
///
///     sum_s q_s u_s  (on i)  =  sum_m (M^T q)_m u_m  (on j),
///
/// where each u_m that is primal alone is a separate term. An expressed unknown that would be primal alone (at the end of a seam) is
/// expressed in the same way. On each j the right-hand sides are orthonormalised, because rows that share unknowns are dependent; the
/// resulting functionals are private primal unknowns, known only to j and the rows on i. Rows that straddle two j are omitted.
class MortarRows {
 public:
  /// \param torn  the torn space, or the space itself on ranks without one; \param choice  the choice in `torn`. Collective.
  MortarRows(const InterfaceSpace& space, const InterfaceSpace& torn, const PrimalChoice& choice);

  struct Row {
    std::vector<std::pair<int, double>> entries;  ///< position in the trace, coefficient
    std::vector<PrimalRows::Term> terms;
  };
  /// Rows of a local problem in addition to those of its entities.
  const std::vector<Row>& of(int local) const { return rows_[local]; }
  /// Private primal unknowns of a local problem, with their motions.
  const std::vector<InterfaceLayout::Unknown>& privateOf(int local) const { return private_[local]; }
  /// Terms that replace an expressed unknown that is primal alone, or null.
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
