#include <suture/base/scene/SceneReader.hpp>
#include <suture/elasticity/strength/Strength.hpp>

#include <Teuchos_ParameterList.hpp>

#include <cmath>
#include <limits>
#include <optional>

namespace suture {

namespace {

constexpr const char *kByYield = "Automatic", *kNoStrength = "None";
constexpr const char *kYield = "Yield Strength", *kTensile = "Tensile Strength", *kCompressive = "Compressive Strength";
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

Schema mohrCoulombSchema() {
  return Schema("shear failure of rock, soil and concrete, with Tensile Strength as a limit of tension")
      .real("Cohesion", std::nullopt, "Shear strength without pressure.", Range::atLeast(0.0), "stress")
      .real("Friction Angle", std::nullopt, "Its tangent is the gain of shear strength per pressure. [degrees]",
            {0.0, 90.0, false, true, {}});
}

Schema hoekBrownSchema() {
  return Schema("failure of rock masses; Compressive Strength is that of the intact rock; give m_i and GSI, or m_b, s and a")
      .real("m_i", std::nullopt, "Constant of the intact rock.", Range::positive())
      .optional()
      .real("GSI", std::nullopt, "Geological Strength Index of the rock mass; 100: intact rock.", {0.0, 100.0, true, false, {}})
      .optional()
      .real("D", std::nullopt, "Disturbance by blasting and unloading, from 0, also the default, to 1.", {0.0, 1.0, false, false, {}})
      .optional()
      .real("m_b", std::nullopt, "Constant of the rock mass, instead of m_i and GSI.", Range::positive())
      .optional()
      .real("s", std::nullopt, "Constant of the rock mass.", {0.0, 1.0, false, false, {}})
      .optional()
      .real("a", std::nullopt, "Exponent of the rock mass; 0.5 by default.", {0.0, 1.0, true, false, {}})
      .optional();
}

/// Values of a list, with errors for missing ones.
class StrengthValues {
 public:
  StrengthValues(const Parameters& list, Problems& problems) : list_(list), problems_(problems) {}
  std::optional<double> find(const char* name) const {
    return list_.isType<double>(name) ? std::optional<double>(list_.get<double>(name)) : std::nullopt;
  }
  double require(const char* name, const std::string& why) const {
    const std::optional<double> value = find(name);
    if (!value) problems_.add(pathOf(list_, name), "is missing: " + why);
    return value.value_or(1.0);
  }
  void refuse(const char* name, const std::string& why) const {
    if (find(name)) problems_.add(pathOf(list_, name), why);
  }

 private:
  const Parameters& list_;
  Problems& problems_;
};

HoekBrownStrength::Constants rockMass(const StrengthValues& values) {
  if (!values.find("m_b")) {
    for (const char* name : {"s", "a"}) values.refuse(name, "without m_b: give m_b, s and a, or m_i and GSI");
    const std::string why = "Hoek-Brown needs m_i and GSI of the rock mass, or m_b, s and a";
    return HoekBrownStrength::Constants::of(values.require("m_i", why), values.require("GSI", why), values.find("D").value_or(0.0));
  }
  for (const char* name : {"GSI", "D"}) values.refuse(name, "beside m_b: give m_b, s and a, or m_i and GSI");
  return {*values.find("m_b"), values.require("s", "it belongs to m_b"), values.find("a").value_or(0.5)};
}

}  // namespace

void addStrengthParameters(Schema& material) {
  const auto strength = [&](const char* name, const char* doc) {
    material.real(name, std::nullopt, doc, Range::positive(), "stress").optional();
  };
  strength(kYield, "Yield or proof strength in tension, for Strength = von Mises.");
  strength(kTensile,
           "Strength in tension, > 0: for Strength = Principal Stress; limit of tension for Mohr-Coulomb and Hoek-Brown; not used by von "
           "Mises.");
  strength(kCompressive,
           "Strength in uniaxial compression, > 0: for Strength = Principal Stress; of the intact rock for Hoek-Brown; not used by von "
           "Mises and Mohr-Coulomb.");
  material.choice(
      "Strength", kByYield,
      {{kByYield, Schema("von Mises if the material has a Yield Strength, else None")},
       {kNoStrength, Schema("no safety factors")},
       {VonMisesStrength::kName, Schema("yield of ductile materials")},
       {PrincipalStressStrength::kName, Schema("fracture of brittle materials, by Tensile Strength and, if given, Compressive Strength")},
       {MohrCoulombStrength::kName, mohrCoulombSchema()},
       {HoekBrownStrength::kName, hoekBrownSchema()}},
      "Criterion of yield or failure, for safety factors: in summary.json by body, in the field SafetyFactor, with a warning below 1. The "
      "solution does not depend on it.",
      "", {kByYield, kNoStrength, VonMisesStrength::kName, PrincipalStressStrength::kName});
}

std::shared_ptr<const Strength> strengthOf(const Parameters& material, Problems& problems) {
  const StrengthValues values(material, problems);
  std::string name = material.isType<std::string>("Strength") ? material.get<std::string>("Strength") : kByYield;
  if (name == kByYield) name = values.find(kYield) ? VonMisesStrength::kName : kNoStrength;
  if (name == kNoStrength) return nullptr;
  const std::string why = "Strength is '" + name + "'";
  const double tensile = values.find(kTensile).value_or(kUnlimited);
  if (name == VonMisesStrength::kName) return std::make_shared<VonMisesStrength>(values.require(kYield, why));
  if (name == PrincipalStressStrength::kName)
    return std::make_shared<PrincipalStressStrength>(values.require(kTensile, why), values.find(kCompressive).value_or(kUnlimited));
  const Parameters& own = material.sublist(name);
  const StrengthValues inList(own, problems);
  if (name == HoekBrownStrength::kName)
    return std::make_shared<HoekBrownStrength>(values.require(kCompressive, why + ", which uses that of the intact rock"), rockMass(inList),
                                               tensile);
  const double cohesion = own.get<double>("Cohesion"), angle = own.get<double>("Friction Angle");
  if (cohesion == 0.0 && angle == 0.0)
    problems.add(pathOf(own, "Cohesion"), "is 0, and so is the friction angle: the material would have no strength");
  return std::make_shared<MohrCoulombStrength>(cohesion, angle * M_PI / 180.0, tensile);
}

}  // namespace suture
