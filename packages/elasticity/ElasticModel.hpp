#pragma once
#include <suture/base/Errors.hpp>
#include <suture/base/scene/Schema.hpp>
#include <suture/elasticity/ExactSolution.hpp>
#include <suture/elasticity/MaterialLaw.hpp>
#include <suture/elasticity/ReferenceElement.hpp>
#include <suture/elasticity/loads/InitialState.hpp>
#include <suture/elasticity/loads/Load.hpp>
#include <suture/mesh/CellBlock.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace suture {

struct SubdomainMesh;

/// Unknowns of an element: displacements only, or displacements and a pressure of its own, discontinuous between elements and
/// eliminated element by element, so that it does not lock when nu tends to 0.5.
enum class ElementForm { Displacement, Mixed };

/// True for the cells that enhanced strains are known for: Quadrilateral4 and Hexahedron8.
constexpr bool mayBeEnhanced(Cell cell) { return cell == Cell::Quadrilateral4 || cell == Cell::Hexahedron8; }

/// A linear elastic material: isotropic by its two moduli, or of another law.
struct Material {
  std::string name;
  double young = 0.0;    ///< Young modulus [stress]; of another law that of nearestIsotropic()
  double poisson = 0.0;  ///< Poisson ratio [-]; likewise
  ElementForm element = ElementForm::Displacement;
  bool enhanced = false;      ///< Quadrilateral4 and Hexahedron8 have enhanced strains instead of `element`: they bend without locking
  bool allowLocking = false;  ///< displacement elements, linear simplices among them, although nu is near 0.5
  bool named = false;         ///< the scene names the element; else it was chosen: one that does not lock
  int number =
      0;  ///< tells materials apart that have the same moduli but other laws or expansions: place in the scene's list, from 1; else 0
  std::shared_ptr<const MaterialLaw> law{};  ///< null: isotropic
  std::optional<double> density{};           ///< [mass / volume], where the scene gives it
  std::optional<double> expansion{};         ///< strain of a free body per unit of temperature, likewise [1 / temperature]

  ElasticStiffness stiffness() const { return law ? law->stiffness() : isotropicStiffness({young, poisson}); }
};

/// Quantity that vanishes across the plane. Axisymmetric scenes have the law of plane strain, with a hoop strain: their geometry is the
/// mesh's (CellBlock::axisymmetric). In space it means nothing, and is Strain.
enum class PlaneModel { Strain, Stress };

/// Materials of the bodies, the plane model and the loads: what the scene says about physics. The same on all ranks.
struct ElasticModel {
  PlaneModel plane = PlaneModel::Strain;
  bool axisymmetric = false;
  int dimension = 2;                ///< 3: Model = Solid
  std::vector<std::string> bodies;  ///< as in the scene's list `Bodies`
  std::vector<Material> materialOfBody;
  std::vector<Material> materialOfRegion;  ///< in the order of regionEntries(); empty for most scenes
  std::vector<std::string> bodyOfRegion;   ///< likewise
  std::vector<Load> loads;
  std::vector<ElasticSupport> supports;
  ExactSolution exact;  ///< as far as the scene gives it

  /// Adds a body, in C++: its elements are those that do not lock for the plane model and the dimension set before.
  /// \param body  its element group in the mesh \throws InputError  the law is none (MaterialLaw::stiffness), or none of a plane body
  void addBody(const std::string& body, std::shared_ptr<const MaterialLaw> law);

  /// Material of an element of a body: that of its region, or else the body's.
  /// \throws InternalError  the scene has regions but the mesh was not told (assignRegions).
  const Material& materialOf(const CellBlock& block, int element, int body) const;
  /// True if volume changes much less easily than shape anywhere: a Poisson ratio above 0.45, but not in plane stress.
  bool nearlyIncompressible() const;
};

/// True if the scene's `Model` is Axisymmetric. Local.
bool isAxisymmetric(const Parameters& scene);
/// 3 if the scene's `Model` is Solid, else 2. Local.
int sceneDimension(const Parameters& scene);
/// Value of the scene's `Model` that a model stands for. Local.
std::string modelName(const ElasticModel& model);

/// \throws InternalError  model and block are not both in space, or not both axisymmetric: makeAxisymmetric() was forgotten. Local.
void requireGeometry(const CellBlock& block, const ElasticModel& model);
/// Where a scene is read: the mesh is the user's. \param source  the mesh, for the message \throws InputError  `Model` and mesh are not of
/// the same dimension. Local.
void requireDimension(const CellBlock& mesh, const std::string& source, const ElasticModel& model);

/// 3-node triangles and 4-node tetrahedra lock above this Poisson ratio, but in plane stress.
constexpr double kLockingPoisson = 0.49;

/// Elements that do not go with their materials: 3-node triangles and 4-node tetrahedra that lock (unless Displacement is asked for by
/// name, or the material's `Allow Locking` is set) or are asked to be Mixed. Local. \param bodyOf  body of each element \param problems
/// gets one for each material and body: how many, what to choose instead, with the path of the material's parameter
void checkElements(const CellBlock& block, const std::function<int(int element)>& bodyOf, const ElasticModel& model, Problems& problems);

/// Schemas of `Model` (added to the scene's top list), one entry of `Bodies`, one of `Materials`.
void addModelParameters(Schema& scene);
Schema bodySchema();
Schema materialSchema();

/// Local, the same on all ranks. \param scene  the whole resolved scene (Model, Bodies, Materials, Boundary Conditions, Constants,
/// Exact Solution).
/// \throws InputError  all of: unknown material of a body or region (nearest name), and what readLoads() and readExactSolution() find
ElasticModel makeElasticModel(const Parameters& scene);

/// By how much a surface of this material (its nearest isotropic one) gives way under contact pressure: (1 - nu^2) / E, in plane stress 1 /
/// E. [1 / stress] Local.
double contactCompliance(const Material& material, PlaneModel plane);

/// Stress-strain matrix in Voigt order with engineering shear: 3 x 3 (xx, yy, xy) in 2D; 6 x 6, normals first, in 3D, where `plane` means
/// nothing: its first four rows and columns are the law of axisymmetric bodies (rr, yy, hoop, ry). [stress]
Matrix elasticity(const Material& material, PlaneModel plane, int dimension);

/// Calls `take(element, K)` with the stiffness matrix of every element, in Cartesian components, node-major: dof dimension * node + k.
/// Through Intrepid2's bases and cubature, exact for affine cells; any Cell. [force / length, per unit thickness in the plane, of the whole
/// circle in axisymmetric blocks]. Local. Mixed: the Lame constant acts on the dilatation's projection (see MixedPressure.hpp) in place of
/// the dilatation. K is exactly symmetric and valid during the call only. \throws InputError  for an inverted or folded element.
void elementStiffnesses(const CellBlock& block, const Material& material, PlaneModel plane,
                        const std::function<void(int element, ConstLocalView stiffness)>& take);
/// The same with a material for each element (the whole mesh). A lambda must say `-> const Material&`; what it refers to outlives the call.
void elementStiffnesses(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                        const std::function<void(int element, ConstLocalView stiffness)>& take);

/// Nodal forces (nodes x dimension, node-major, Cartesian) of a traction vector or pressure on sides, and of a body force on elements.
/// Consistent: integrals against the shape functions; forces of the whole circle in axisymmetric blocks. Added to `forces`. Local.
void addSideLoad(const CellBlock& block, const std::vector<Side>& sides, const Load& load, Vector& forces);
/// Adds factor x integral of (shape function x outward normal) over a side to the nodes' values: what a nodal displacement carries through
/// it.
void addSideFlux(const CellBlock& block, const Side& side, double factor, Vector& flux);
/// \param density  of an element [mass / volume]: of a Gravity or Rotation, which act on mass
void addBodyForce(const CellBlock& block, const std::vector<int>& elements, const Load& load, Vector& forces,
                  const std::function<double(int element)>& density = {});

/// Force of a load on nodes (Random or resolved PointForce) on a component of a node of the mesh: a pure function of (load, node,
/// component), and so the same however the mesh is cut. Cartesian. Local. \throws InternalError  a PointForce that is not resolved
double nodeForce(const Load& load, GlobalId node, int component);
/// The same of a Random load: uniform in value[1] + [-value[0], value[0]).
double randomForce(const Load& load, GlobalId node, int component);

/// Stresses at element centroids: elements x 4 (xx, yy, zz, xy) in the plane, zz across it or the hoop stress of axisymmetric blocks;
/// elements x 6 (xx, yy, zz, xy, yz, xz) in space; tension positive. Mixed elements: with their own pressure. `displacement`: node-major,
/// Cartesian. Initial strains are taken off, initial stresses are added. Local.
Matrix elementStresses(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                       const Vector& displacement, const InitialState& initial = InitialState());

/// The same of a subdomain by its model: materials and initial states. Local.
Matrix elementStresses(const SubdomainMesh& mesh, const ElasticModel& model, const Vector& displacement);

/// Principal stresses and their directions, row by row of elementStresses(). In the plane those in it: (s1 >= s2, angle of the first axis
/// [rad], in (-pi/2, pi/2] from the x axis, counter-clockwise). In space (s1 >= s2 >= s3, unit vector of s1, unit vector of s3), the
/// largest component of each vector above zero. Local.
Matrix principalStresses(const Matrix& stresses);

/// von Mises stress of each row of elementStresses(), the stress across the plane included. Local.
Vector vonMises(const Matrix& stresses);

}  // namespace suture
