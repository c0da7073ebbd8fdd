#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/subdomain/Subdomain.hpp>

#include <functional>

namespace suture {

/// Linear elasticity of one subdomain: stiffness and loads of its elements, rotated into the axes of the nodes. Final, because
/// followsModel() is true; to use another law derive from MaterialLaw, for other physics derive from Subdomain.
class ElasticSubdomain final : public Subdomain {
 public:
  /// `mesh` and `model` must outlive it. \throws InternalError  an axisymmetric scene whose mesh is not axisymmetric (makeAxisymmetric).
  ElasticSubdomain(const SubdomainMesh& mesh, const ElasticModel& model) : Subdomain(mesh), model_(model) { requireGeometry(mesh, model); }

  bool followsModel() const override { return true; }
  const Material& materialOf(int element) const { return model_.materialOf(mesh(), element, mesh().body); }

 protected:
  void doAssemble(SparseMatrix& stiffness, Vector& load) override;
  Vector doLoad() override;
  Matrix doStresses(const Vector& displacement) const override;
  Matrix doRigidModes() const override;
  Hint doHint(const std::string& name) const override;

 private:
  Vector youngModulus() const;
  Vector shearDiagonal() const;
  Vector seamFlux() const;
  SparseMatrix assembleStiffness(const std::function<const Material&(int element)>& materials) const;

  const ElasticModel& model_;
};

}  // namespace suture
