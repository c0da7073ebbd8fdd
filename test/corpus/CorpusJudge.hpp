#pragma once
#include <corpus/CorpusRun.hpp>

#include <string>

namespace suture::corpus {

/// True if a scene has a solution, decided by the rigid motions z of its bodies that the prescribed components allow: Held, one solution;
/// Slides, some z keeps all gaps (B z = 0); None, some z opens no gap that is closed (B z <= 0) and gains work of the loads.
enum class Feasibility { Held, Slides, None };

/// Judges solutions of a scene from displacements and pair forces alone, by one loop over the elements of the whole mesh. On rank 0.
///
/// Forces are measured against the force of their body: the largest of its summed loads, reactions and forces of one contact piece. The
/// tolerance also covers the round-off of the internal forces, 30 epsilon times the largest sum of |K| |u| at a node of the body: a body
/// that moves rigidly by far more than it deforms has no more digits. Contact carries that error to other bodies: where it exceeds the
/// bound in one of them, the bounds of all are loosened by the same factor.
class Judge {
 public:
  explicit Judge(const Whole& whole);

  /// Proved either way: by contact forces p >= 0 with B^T p = loads, or by an unbounded motion. \throws NumericalError  neither found
  Feasibility feasibility() const;

  /// Complaint about a solution, or "".
  std::string verdict(const Outcome& found) const;

  /// Difference between two solutions, or "": forces always, relative to the largest pair force of the body; displacements without neutral
  /// motions, those rigid motions of the bodies that no prescribed component and no pair that carries force restrains.
  std::string difference(const Outcome& found, const Outcome& reference) const;

  /// Largest rounding error of a body's forces over the bound; 1 where all are below it.
  double rounding(const Outcome& found) const { return scales(found).loosened; }

  /// Rigid motions that nothing restrains at a solution.
  int neutralMotions(const Outcome& found) const { return static_cast<int>(neutral(found).cols()); }

 private:
  struct Scales {
    Vector force, floor, displacement;  ///< scales of each body
    Vector residual;                    ///< node components: loads + contact - internal
    double loosened = 1.0;
  };
  Scales scales(const Outcome& found) const;
  Matrix neutral(const Outcome& found) const;
  Vector contactRow(const ContactPair& pair) const;  ///< over the rigid motions of all bodies
  Matrix prescribedGram() const;
  const NodeRule* ruleAt(int node) const { return ruleOf_[node] < 0 ? nullptr : &whole_.constraints.rules[ruleOf_[node]]; }
  int bodyOf(const PairEnd& end) const { return whole_.mesh.bodyOfNode[end.node]; }

  const Whole& whole_;
  Vector loads_;
  std::vector<int> ruleOf_;
  Matrix rigid_;  ///< rigid motions of each body, three columns each, of largest displacement about 1
};

}  // namespace suture::corpus
