#pragma once
#include <suture/quality/answers/Reactions.hpp>
#include <suture/report/Run.hpp>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace suture {

/// The resultant of a boundary condition: of a support what it does to the bodies, of a load what it is.
struct ConditionResultant {
  std::string name, kind;  ///< kind: "support" or "load"
  Resultant sum;
};

/// All conditions of the scene in its order; loads of subdomains with physics of their own last. On rank 0.
std::vector<ConditionResultant> conditionResultants(const Run& run);

/// All contacts of the scene in its order. On rank 0.
std::vector<ContactResultant> contactResultants(const Run& run);

/// Sum over all conditions and rigid obstacles; zero, but for the accuracy of the solution. On rank 0.
Resultant sumOfResultants(const std::vector<ConditionResultant>& conditions, const std::vector<ContactResultant>& contacts);

/// Name of a body, "" of a rigid obstacle. Local.
std::string bodyName(const Run& run, int body);

/// The largest contact pressure; null without pairs. Points on the axis count. On rank 0.
const PairResult* largestPressure(const Solution& solution);

/// `extremes` and `reactions` of summary.json. On rank 0.
nlohmann::ordered_json extremesJson(const Run& run, int dimension);
nlohmann::ordered_json reactionsJson(const Run& run, int dimension);

/// Lines of the console: the extremes with bodies and places; empty if nobody looked for them. On rank 0.
std::string extremesText(const Run& run, int dimension);

}  // namespace suture
