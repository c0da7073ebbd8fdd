#pragma once
#include <suture/simulation/SceneParts.hpp>
#include <suture/simulation/StepSolver.hpp>
#include <suture/simulation/moving/KeptStates.hpp>
#include <suture/simulation/moving/MovingConstraints.hpp>
#include <suture/simulation/moving/MovingLoads.hpp>
#include <suture/simulation/moving/Relaxation.hpp>
#include <suture/simulation/moving/Settling.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Solves load steps of bodies that slide and turn far while their strains stay small. Each round finds the contact pairs between the
/// present shapes, solves the linear scene at the present frames of the bodies, and makes the rigid part of the solution a finite motion of
/// the frames, until shapes and pair states no longer change.
class MovingSolver : public StepSolver {
 public:
  /// \param parts  must outlive it; mesh, constraints and subdomains are those of the last round. Collective.
  MovingSolver(SceneParts& parts, std::shared_ptr<const DrawnScene> drawn);

  Solution solve(const Solution* before, bool isPrepared, const std::vector<Vector>* displacement, double continues) override;
  void accept(const Solution& solution) override;
  void restore(Solution& last) override;
  std::vector<StepRow::Frame> frames() const override;
  /// `places`: contact pairs, searched again between the shapes of the solution. A closed pair is as far apart, and an open or new one
  /// penetrates, by at most this part of the largest displacement beside the frames; otherwise another round follows.
  void verify(Solution& solution) const override;
  bool isTooLong(const Solution& solution) const override;
  bool keepsPairs() const override { return false; }
  const Method& method() const override { return *method_; }
  std::unique_ptr<Method> takeMethod() override { return std::move(method_); }
  Solution goOnFrom(const PathState& state) override;

 private:
  /// Shapes and states between two rounds; on rank 0.
  struct State {
    MovingBodies bodies;
    KeptStates states;
    KeptChoices choices;  // decisions of mortars in the rounds of a step
    Vector change;        // change of the places of all nodes in the last round
  };
  /// Largest distance of closed pairs, and penetration of others, between the shapes of a round, and its place.
  struct Apart {
    double part = 0.0;  ///< relative to the largest displacement beside the frames
    std::string where;
  };
  Solution solveRounds();
  void findApart();
  double accuracyOf(const Solution& solution) const;
  void moveOn(double part);
  void place(double time);
  void takeDrawnPlaces();
  void placeMeshes();
  void placeLoads(double time);
  Start startOfRound() const;
  std::shared_ptr<const MovedBodies> moved(const Solution& solution) const;
  bool isLoose(const Solution& solution) const;
  State stateAfter(const Solution& solution, Settling& settling) const;
  const Comm& comm() const { return parts_.run.comm(); }

  SceneParts& parts_;
  std::shared_ptr<const DrawnScene> drawn_;
  std::unique_ptr<Method> method_;
  MovingLoads loads_;
  std::unique_ptr<const MovingConstraints> constraints_;  // on rank 0
  SlipHistory history_;                                   // likewise, of the accepted step
  State accepted_, now_;
  Apart apart_;                                    // in the last round
  std::vector<MovingBodies::Motion> lastMotions_;  // likewise, by part: motions in the accepted step
  double contraction_ = 1.0;                       // contraction of rounds in the last step, see Settling; the same on all ranks
  double extent_ = 0.0;                            // largest coordinate [length]
  std::vector<int> partOfSubdomain_;               // part of each subdomain of the scene; the same on all ranks
};

}  // namespace suture
