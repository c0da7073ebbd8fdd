#pragma once
#include <suture/simulation/SceneParts.hpp>
#include <suture/simulation/StepSolver.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace suture {

/// Solves a scene again and again while its loads, prescribed displacements and pair histories change. Factors are kept, except by methods
/// that cannot reload.
class RepeatedSolver : public StepSolver {
 public:
  /// Collective. \param parts  must outlive it \param method  prepared \param start  initial guess of the first solution
  RepeatedSolver(SceneParts& parts, std::unique_ptr<Method> method, std::optional<Start> start)
      : parts_(parts), method_(std::move(method)), start_(std::move(start)), inSitu_(inSituForces(parts)) {}

  Solution solve(const Solution* before, bool isPrepared, const std::vector<Vector>* displacement = nullptr,
                 double continues = 0.0) override;
  const Method& method() const override { return *method_; }
  std::unique_ptr<Method> takeMethod() override { return std::move(method_); }
  Solution goOnFrom(const PathState& state) override;

 private:
  SceneParts& parts_;
  std::unique_ptr<Method> method_;  // null after a method that cannot reload broke down while it was prepared
  std::optional<Start> start_;
  std::vector<BodyForces> inSitu_;

  std::vector<BodyForces> carried() const;
};

}  // namespace suture
