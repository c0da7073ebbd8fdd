#pragma once
#include <suture/interface/ContactClusters.hpp>
#include <suture/interface/InterfaceOperator.hpp>
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/pairs/ContactRow.hpp>
#include <suture/subdomain/Subdomain.hpp>

#include <memory>
#include <vector>

namespace suture {

/// The linear problem of given pair states, as seen by this rank. Plain.
struct PairTangent {
  ContactStates states;
  std::shared_ptr<const InterfaceSpace> space;      ///< unknowns of the interface, with the equations of closed pairs
  std::shared_ptr<const FrictionTangent> friction;  ///< null on all ranks without friction
};

/// Makes the linear problems of pair states from the rows of the pairs, and keeps the last one: a step of a search needs the same states
/// several times, and states that differ in the direction of friction only share their space. Local.
class PairTangents {
 public:
  /// \param space     without relations
  /// \param rows      that this rank sees, by pair; must outlive it, as must `clusters`
  /// \param owned     marks the rows that this rank owns
  /// \param components  of a pair's frame that laws of the scene may tie: one without laws that restrict sliding
  /// \param friction    pairs that may open or slip have such laws; the same on all ranks
  PairTangents(std::shared_ptr<const InterfaceSpace> space, const std::vector<std::unique_ptr<Subdomain>>& subdomains,
               const std::vector<ContactRow>& rows, std::vector<char> owned, const ContactClusters& clusters, int components,
               bool friction);

  const PairTangent& of(const ContactStates& states);

 private:
  void findNeighbours(const std::vector<std::unique_ptr<Subdomain>>& subdomains);
  std::vector<std::vector<int>> closedNeighbours(const std::vector<ContactState>& states) const;
  std::shared_ptr<const FrictionTangent> frictionOf(const std::vector<ContactState>& states, std::vector<InterfaceRelation> test) const;

  std::shared_ptr<const InterfaceSpace> space_;
  const std::vector<ContactRow>& rows_;
  std::vector<char> owned_;
  const ContactClusters& clusters_;
  int components_;
  bool restricts_;
  std::vector<std::vector<int>> neighbours_;  // rows of neighbouring pairs: along lines, or around the cells of surfaces (-1: unknown)
  PairTangent last_;
  std::vector<int> unknowns_;  // expressed by others in last_.space, with friction
};

}  // namespace suture
