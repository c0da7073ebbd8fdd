#pragma once
#include <suture/answer/values/Reactions.hpp>
#include <suture/report/Run.hpp>

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace suture {

/// The resultant of a boundary condition: for a support, its reaction on the bodies; for a load, the applied load.
struct ConditionResultant {
  std::string name, kind;  ///< kind: "support" or "load"
  Resultant sum;
};

/// All conditions of the scene in its order; then the loads of user-defined subdomains. On rank 0.
std::vector<ConditionResultant> conditionResultants(const Run& run);

/// All contacts of the scene in its order. On rank 0.
std::vector<ContactResultant> contactResultants(const Run& run);

/// Sum over all conditions and rigid obstacles; zero within the accuracy of the solution. On rank 0.
Resultant sumOfResultants(const std::vector<ConditionResultant>& conditions, const std::vector<ContactResultant>& contacts);

/// Estimated errors of the forces of a run, if it has error bars. On rank 0.
class ForceErrors {
 public:
  ForceErrors(const Run& run, const std::vector<ConditionResultant>& conditions, const std::vector<ContactResultant>& contacts);

  /// Nothing for loads, and without error bars. [force]
  std::optional<double> of(const ConditionResultant& condition) const;
  std::optional<double> ofContact(int line) const;

 private:
  const Run& run_;
  double largest_ = 0.0;  // resultant
};

/// Strict bounds of the force of a condition or contact; null: not requested. Local.
const ForceInterval* intervalOf(const Run& run, const std::string& name, bool isContact);

/// Largest estimated error of the force of a support or contact, if error bars are requested. On rank 0. [force]
double largestForceError(const Run& run);

/// Lines of the console: strict bounds of forces. On rank 0.
std::string intervalsText(const Run& run, int dimension);

/// Name of a body, "" for a rigid obstacle. Local.
std::string bodyName(const Run& run, int body);

/// `extremes` and `reactions` of summary.json. On rank 0.
nlohmann::ordered_json extremesJson(const Run& run, int dimension);
/// Motions of the rigid groups, and what their conditions do to the bodies. Local, on rank 0.
std::vector<StepRow::Group> groupsOfStep(const Run& run);

/// `rigid_groups` of summary.json. On rank 0.
nlohmann::ordered_json rigidGroupsJson(const Run& run, int dimension);
nlohmann::ordered_json reactionsJson(const Run& run, int dimension);

/// `safety` of summary.json. On rank 0.
nlohmann::ordered_json safetyJson(const Run& run, int dimension);

/// Lines of the console: the extremes with bodies and positions; empty if no extremes were computed. On rank 0.
std::string extremesText(const Run& run, int dimension);

}  // namespace suture
