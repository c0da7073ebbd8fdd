#pragma once
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/precond/Preconditioner.hpp>
#include <suture/solver/Method.hpp>
#include <suture/solver/OuterSolver.hpp>

#include <memory>

namespace suture {

/// Solution by domain decomposition: subdomains are assembled and condensed to their boundaries, the outer solver solves the interface
/// problem of the scene's formulation, and the interiors are recovered.
class Decomposition : public Method {
 public:
  bool needsWholeMesh() const override { return false; }
  GlobalId interfaceUnknowns() const override { return problem_->space()->size(); }
  bool takesStart() const override { return problem_->pairs() > 0 || scene().inSteps; }
  bool reloads() const override { return problem_->reloads(); }
  const Subdomains& subdomains() const override { return subdomains_; }
  Subdomains takeSubdomains() override;
  bool knowsFriction(const Parameters& settings) const override;

 protected:
  void doAssemble(Subdomains subdomains) override;
  void doFactor() override;
  Solution doSolve(Monitor& monitor, const Start* start, const Keep& keep) override;
  void doReload() override;
  bool doRearrange() override;

 private:
  void addBalancing(const OuterResult& result, Teuchos::RCP<Preconditioner> preconditioner, Solution& solution) const;

  Subdomains subdomains_;
  std::unique_ptr<InterfaceProblem> problem_;
  Teuchos::RCP<Preconditioner> preconditioner_;  // preconditioner of the last load step; null without load steps
};

}  // namespace suture
