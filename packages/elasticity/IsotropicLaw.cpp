#include <suture/elasticity/IsotropicLaw.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

Schema IsotropicLaw::schema() {
  Range poisson;
  poisson.low = -1.0;
  poisson.high = 0.5;
  poisson.lowOpen = poisson.highOpen = true;
  poisson.note = "Displacement and Mixed elements (Materials/<name>/Element) allow 0.4999 and more, but not 0.5";
  return Schema("the same in all directions; its parameters are next to Type")
      .real("Young Modulus", std::nullopt, "Stress over strain in a bar under tension.", Range::positive(), "stress")
      .real("Poisson Ratio", std::nullopt, "Transverse contraction over axial extension of a bar.", poisson);
}

IsotropicLaw::IsotropicLaw(const Parameters& own) : moduli_{own.get<double>("Young Modulus"), own.get<double>("Poisson Ratio")} {}

}  // namespace suture
