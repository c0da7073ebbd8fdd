#include <Teuchos_ParameterList.hpp>
#include <sstream>
#include <suture/base/Numbers.hpp>
#include <suture/report/Units.hpp>

namespace suture {

Units unitsOf(const Parameters& scene) {
  Units units;
  if (!scene.isType<std::string>("Units")) return units;
  std::istringstream names(scene.get<std::string>("Units"));
  const auto next = [&](const std::string& quantity) {
    std::string name;
    std::getline(names, name, ',');
    name = trimmed(name);
    return name.empty() ? quantity : name;
  };
  units.length = next("length");
  units.force = next("force");
  units.stress = next("stress");
  return units;
}

}  // namespace suture
