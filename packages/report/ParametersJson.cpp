#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <nlohmann/json.hpp>
#include <suture/base/Errors.hpp>
#include <suture/report/ParametersJson.hpp>

using Json = nlohmann::ordered_json;

namespace suture {
namespace {

template <typename T>
bool take(const Teuchos::ParameterEntry& entry, Json& value) {
  if (!entry.isType<T>()) return false;
  value = Teuchos::getValue<T>(entry);
  return true;
}

template <typename T>
bool takeArray(const Teuchos::ParameterEntry& entry, Json& value) {
  if (!entry.isType<Teuchos::Array<T>>()) return false;
  value = Json::array();
  for (const T& one : Teuchos::getValue<Teuchos::Array<T>>(entry)) value.push_back(one);
  return true;
}

}  // namespace

Json toJson(const Parameters& parameters) {
  Json all = Json::object();
  for (auto it = parameters.begin(); it != parameters.end(); ++it) {
    const std::string& name = parameters.name(it);
    const Teuchos::ParameterEntry& entry = parameters.entry(it);
    Json& value = all[name];
    if (entry.isList())
      value = toJson(parameters.sublist(name));
    else if (!(take<int>(entry, value) || take<long long>(entry, value) || take<double>(entry, value) || take<bool>(entry, value) ||
               take<std::string>(entry, value) || takeArray<double>(entry, value) || takeArray<int>(entry, value) ||
               takeArray<std::string>(entry, value)))
      throw InternalError("parameter '" + name + "' has a type that summary.json cannot hold");
  }
  return all;
}

}  // namespace suture
