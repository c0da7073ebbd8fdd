#pragma once
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/subdomain/Subdomain.hpp>

#include <map>
#include <vector>

namespace suture {

/// The row (u_A - u_B) . n <= gap of one contact pair in the unknowns of its nodes, whatever their axes: coefficient one on the normal
/// component of a rotated node, several on a Cartesian one; prescribed components go to the gap. Local.
class PairRow {
 public:
  explicit PairRow(const ContactPair& pair) : pair_(pair), gap_(pair.gap) {}

  /// Adds one end. \param positions  where the subdomain's unknowns stand in the row. A side that is there already is left alone: a node
  /// that several subdomains hold is one node.
  void add(const Subdomain& subdomain, const SubdomainMesh::ContactEnd& end, const std::vector<int>& positions);

  const ContactPair& pair() const { return pair_; }
  bool complete() const { return hasA_ && hasB_; }
  /// position -> coefficient; coefficients that are nothing but rounding are left out.
  const std::map<int, double>& coefficients() const { return coefficients_; }
  double gap() const { return gap_; }  ///< initial gap less what prescribed components close of it

 private:
  ContactPair pair_;
  double gap_;
  bool hasA_ = false, hasB_ = false;
  std::map<int, double> coefficients_;
};

}  // namespace suture
