// A subdomain with user-defined physics: an elastic body with thin fibres in one direction that carry only axial stress.
#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <suture/elasticity/loads/NodalLoads.hpp>
#include <suture/subdomain/RigidModes.hpp>
#include <suture/subdomain/Subdomain.hpp>

using namespace suture;

namespace {

class FibreSubdomain : public Subdomain {
 public:
  static Schema schema() {
    return Schema("the body's material with fibres in one direction")
        .real("Stiffness", std::nullopt, "Young modulus of the fibres times their volume fraction.", Range::positive(), "stress")
        .real("Angle", 0.0, "From the x axis to the fibres, anticlockwise. [degrees]");
  }

  FibreSubdomain(const SubdomainMesh& mesh, const ElasticModel& model, const Parameters& own) : Subdomain(mesh), model_(model) {
    const double angle = own.get<double>("Angle") * M_PI / 180, c = std::cos(angle), s = std::sin(angle);
    // The fibre strain is the product of `along` and the strain vector (xx, yy, zz, xy, yz, xz).
    const auto along = (Eigen::Matrix<double, 6, 1>() << c * c, s * s, 0, c * s, 0, 0).finished();
    for (int e = 0; e < mesh.elements(); ++e) {
      const Material& plain = model.materialOf(mesh, e, mesh.body);
      const auto [mine, isNew] = reinforced_.try_emplace(&plain, plain);
      mine->second.element = ElementForm::Displacement;
      if (isNew)
        mine->second.law = std::make_shared<GivenLaw>(plain.stiffness() + own.get<double>("Stiffness") * along * along.transpose());
    }
  }

 protected:
  void doAssemble(SparseMatrix& stiffness, Vector& load) override {
    stiffness = assembled([&](const auto& take) { elementStiffnesses(mesh(), materials(), model_.plane, take); });
    load = subdomainLoads(mesh(), model_);
    toAxes(load);
  }
  Matrix doRigidModes() const override {
    Matrix modes = suture::rigidModes(mesh());
    toAxes(modes);
    return modes;
  }
  Matrix doStresses(const Vector& u) const override { return elementStresses(mesh(), materials(), model_.plane, u); }

 private:
  std::function<const Material&(int)> materials() const {
    return [this](int e) -> const Material& { return reinforced_.at(&model_.materialOf(mesh(), e, mesh().body)); };
  }

  const ElasticModel& model_;
  std::map<const Material*, Material> reinforced_;
};

const Registration<Subdomain> registration("Fibres", FibreSubdomain::schema(), [](const auto& mesh, const auto& model, const auto& own) {
  return std::make_unique<FibreSubdomain>(mesh, model, own);
});

}  // namespace
