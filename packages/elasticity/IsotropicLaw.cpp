#include <suture/elasticity/IsotropicLaw.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

Schema IsotropicLaw::schema() {
  Range poisson;
  poisson.low = -1.0;
  poisson.high = 0.5;
  poisson.lowOpen = poisson.highOpen = true;
  poisson.note = "the elements Displacement and Mixed of Materials/<name>/Element go up to 0.4999 and further, not to 0.5 itself";
  return Schema("the same in all directions; its parameters stand beside Type")
      .real("Young Modulus", std::nullopt, "Stress over strain in a bar pulled along its axis.", Range::positive(), "stress")
      .real("Poisson Ratio", std::nullopt, "Contraction across over extension along a bar.", poisson);
}

IsotropicLaw::IsotropicLaw(const Parameters& own) : moduli_{own.get<double>("Young Modulus"), own.get<double>("Poisson Ratio")} {}

}  // namespace suture
