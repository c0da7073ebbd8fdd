// A user-defined material law: rock in thin layers of two kinds, homogenised. Suture derives everything from its stiffness:
// elements, stresses, error estimates, the verdict, the monolithic reference.
#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <suture/elasticity/MaterialLaw.hpp>

namespace {

using namespace suture;

/// Homogenised thin isotropic layers: G. E. Backus, Long-wave elastic anisotropy produced by horizontal layering, J. Geophys. Res. 67
/// (1962), equation (13). The layers are normal to y before the rotation by `Angle`.
class LayeredRock : public MaterialLaw {
 public:
  static Schema schema() {
    return Schema("thin layers of two isotropic rocks")
        .reals("Young Moduli", std::nullopt, "Young modulus of each rock.", "stress", Range::positive())
        .reals("Poisson Ratios", std::vector<double>{0.25, 0.25}, "Poisson ratio of each rock.", "", Range{-1.0, 0.5, true, true, {}})
        .real("Fraction", 0.5, "Share of the first rock.", Range{0.0, 1.0, false, false, {}})
        .real("Angle", 0.0, "From the x axis to the layers, anticlockwise. [degrees]");
  }

  explicit LayeredRock(const Parameters& own) {
    const auto young = own.get<Teuchos::Array<double>>("Young Moduli"), poisson = own.get<Teuchos::Array<double>>("Poisson Ratios");
    if (young.size() != 2 || poisson.size() != 2) throw InputError(kind(), "needs moduli of two rocks");
    const double share[] = {own.get<double>("Fraction"), 1.0 - own.get<double>("Fraction")};
    double softness = 0.0, ratio = 0.0, along = 0.0, beside = 0.0, slip = 0.0, shear = 0.0;  // means over the layers
    for (int k = 0; k < 2; ++k) {
      const double mu = young[k] / (2 * (1 + poisson[k])), lambda = 2 * mu * poisson[k] / (1 - 2 * poisson[k]), m = lambda + 2 * mu;
      softness += share[k] / m;
      ratio += share[k] * lambda / m;
      along += share[k] * 4 * mu * (lambda + mu) / m;
      beside += share[k] * 2 * mu * lambda / m;
      slip += share[k] / mu;
      shear += share[k] * mu;
    }
    ElasticStiffness c = ElasticStiffness::Zero();  // xx, yy, zz, xy, yz, xz
    c(1, 1) = 1 / softness;
    c(0, 1) = c(1, 0) = c(1, 2) = c(2, 1) = ratio / softness;
    c(0, 0) = c(2, 2) = along + ratio * ratio / softness;
    c(0, 2) = c(2, 0) = beside + ratio * ratio / softness;
    c(3, 3) = c(4, 4) = 1 / slip;
    c(5, 5) = shear;
    stiffness_ = turned(c, own.get<double>("Angle") * M_PI / 180);
  }

 protected:
  ElasticStiffness doStiffness() const override { return stiffness_; }

 private:
  ElasticStiffness stiffness_;
};

const Registration<MaterialLaw> registration("Layered Rock", LayeredRock::schema(),
                                             [](const Parameters& own) { return std::make_unique<LayeredRock>(own); });

}  // namespace
