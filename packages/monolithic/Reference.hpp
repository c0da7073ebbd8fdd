#pragma once
#include <suture/monolithic/Monolithic.hpp>
#include <suture/monolithic/MonolithicSystem.hpp>
#include <suture/solver/Method.hpp>

#include <memory>
#include <vector>

namespace suture {

/// Monolithic in a distributed run: rank 0 solves the whole system by one factorisation, all ranks receive their part of the solution. XML
/// `Outer Solver/Type` = Monolithic.
class Reference : public Method {
 public:
  static Schema schema();
  Reference(const Parameters& settings, const Parameters& own);

  bool needsWholeMesh() const override { return true; }
  bool knowsFriction(const Parameters&) const override { return true; }
  /// On a path of load steps with friction: states of the pairs only. Equilibria with friction are not unique, and a path continues that of
  /// its last step.
  bool takesStart() const override { return scene().inSteps && scene().laws.restrictSliding(); }
  double megabytes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, GlobalId unknowns) const override;

 protected:
  bool needsLaw() const override { return true; }
  void doAssemble(Subdomains subdomains) override;
  /// \throws NumericalError, InputError
  Solution doSolve(Monitor& monitor, const Start* start, const Keep& keep) override;

 private:
  std::vector<ContactState> statesOf(const Start& start) const;
  void addBalancing(std::vector<PairForce> forces, Solution& solution) const;

  MonolithicOptions options_;
  std::unique_ptr<const MonolithicSystem> system_;  // on rank 0
};

}  // namespace suture
