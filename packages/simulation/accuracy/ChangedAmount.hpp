#pragma once
#include <suture/simulation/SceneParts.hpp>

#include <array>
#include <string>
#include <vector>

namespace suture {

/// A number of a scene on which its potential energy J depends, and whose conjugate dJ / d(amount) is a result.
struct Amount {
  enum class Kind {
    Support,  ///< displacement of a condition along an axis; conjugate: that component of its force, acting on the body
    Contact,  ///< approach of the sides of a contact along its normal; conjugate: its pressing force
    Load      ///< factor of a load; conjugate: minus its work
  };
  Kind kind = Kind::Support;
  int number = -1;    ///< Support::condition, contact line, or place in ElasticModel::loads
  int component = 0;  ///< axis, for a support
};

/// Why the energy is not a finite convex function of the amount near its value, or why that cannot be decided: "it shares nodes with ...";
/// empty: it is. The same on all ranks. Collective.
std::string whyNotChangeable(const SceneParts& parts, const Amount& amount);

/// Normal of the sides of a contact, from side A to side B, on rank 0; zero if it has no pair.
Point normalOf(const std::vector<PairResult>& pairs, int line);

/// Changes an amount of a scene, for the time of its life. The method must reload() the scene. Local.
class ChangedAmount {
 public:
  ChangedAmount(SceneParts& parts, const Amount& amount, double by);
  ~ChangedAmount();
  ChangedAmount(const ChangedAmount&) = delete;
  ChangedAmount& operator=(const ChangedAmount&) = delete;

 private:
  void moveSupports(const Amount& amount, double by);
  void approach(int line, double by);

  SceneParts& parts_;
  // As before.
  std::vector<std::vector<NodeRule>> rules_;
  std::vector<NodeRule> wholeRules_;
  struct Gaps {
    double pair, equation;
  };
  std::vector<std::vector<Gaps>> gaps_;
  std::vector<std::map<int, double>> lifted_;
  std::vector<double> wholeGaps_, factors_;
};

}  // namespace suture
