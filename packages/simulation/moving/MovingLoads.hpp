#pragma once
#include <suture/answer/Solution.hpp>
#include <suture/motion/MovingBodies.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/simulation/moving/DrawnScene.hpp>

#include <vector>

namespace suture {

/// Loads of bodies that move far, at their present places. Linear elements balance moments about the places of their nodes without strain;
/// couples on each body make the balance exact at the places with strain.
class MovingLoads {
 public:
  /// \param resolved  the model with its loads on the drawn mesh
  explicit MovingLoads(const ElasticModel& resolved) : resolved_(resolved.loads) {}

  /// Replaces the loads of a model by those at the present places: moments and forces of groups follow from the placed meshes, points of
  /// rigid groups move, and forces at points stay at their nodes. Collective. \param bodies  on rank 0 \param meshes  placed subdomains
  void place(const Comm& comm, const DrawnScene& drawn, const MovingBodies& bodies, const std::vector<SubdomainMesh>& meshes,
             ElasticModel& model) const;
  /// Finds the moments of the forces on each part about the displacements of their nodes in a solution: sum u x F. Returns true if they
  /// have settled. Collective. \param partOfSubdomain  part of each subdomain of the scene
  bool findMoments(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<int>& partOfSubdomain,
                   const ElasticModel& model, const Solution& solution);
  /// Moments of the last accepted step, by part; empty: none yet.
  const std::vector<Point>& moments() const { return accepted_; }
  /// Takes over the moments of a step from a file. Local, the same on all ranks.
  void goOnFrom(std::vector<Point> moments) { accepted_ = moments_ = std::move(moments); }
  /// Keeps the moments for goBack(). Local.
  void accept() { accepted_ = moments_; }
  /// Takes the moments of the last accepted step again. Local.
  void goBack() { moments_ = accepted_; }

 private:
  void addCouples(const Comm& comm, const MovingBodies& bodies, ElasticModel& model) const;

  std::vector<Load> resolved_;
  std::vector<Point> moments_, accepted_;  // by part; empty: none
};

}  // namespace suture
