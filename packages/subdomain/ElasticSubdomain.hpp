#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/subdomain/Subdomain.hpp>

namespace suture {

/// Linear elasticity of one subdomain: stiffness and loads of its elements, rotated into the axes of the nodes.
class ElasticSubdomain : public Subdomain {
 public:
  /// `mesh` and `model` must outlive it.
  ElasticSubdomain(const SubdomainMesh& mesh, const ElasticModel& model) : Subdomain(mesh), model_(model) {}

  const Material& material() const { return model_.materialOfBody[mesh().body]; }

 protected:
  void doAssemble(SparseMatrix& stiffness, Vector& load) override;
  Matrix doRigidModes() const override;
  Vector doYoungModulus() const override;

 private:
  const ElasticModel& model_;
};

}  // namespace suture
