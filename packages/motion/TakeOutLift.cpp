#include <suture/elasticity/loads/NodalLoads.hpp>
#include <suture/motion/CarriedBodies.hpp>
#include <suture/motion/RigidMotionLifting.hpp>
#include <suture/motion/TakeOutLift.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

namespace suture {

double takeOutLift(const Comm& comm, const ElasticModel& model, std::vector<SubdomainMesh>& meshes, Constraints& constraints,
                   bool carriesFreeBodies) {
  if (!prescribesMotion(comm, meshes) && !(carriesFreeBodies && hasGaps(comm, meshes))) return 0.0;
  CarriedMotions carry;
  if (carriesFreeBodies) carry = [&](const BodyParts& parts) { return carriedMotions(comm, meshes, model, parts); };
  if (!takeOutRigidMotions(comm, meshes, carry)) return 0.0;
  int has = !constraints.rules.empty();
  Teuchos::broadcast(comm, 0, 1, &has);
  if (has) adopt(comm, meshes, constraints);
  double work = 0.0, all = 0.0;
  for (const SubdomainMesh& mesh : meshes) work += subdomainLoads(mesh, model).dot(mesh.lift.motion);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, work, Teuchos::outArg(all));
  return all;
}

}  // namespace suture
