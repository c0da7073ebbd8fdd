#pragma once
#include <suture/base/Errors.hpp>
#include <suture/base/scene/Schema.hpp>
#include <suture/elasticity/ExactSolution.hpp>
#include <suture/elasticity/MaterialLaw.hpp>
#include <suture/elasticity/ReferenceElement.hpp>
#include <suture/elasticity/loads/InitialState.hpp>
#include <suture/elasticity/loads/Load.hpp>
#include <suture/elasticity/strength/Strength.hpp>
#include <suture/mesh/CellBlock.hpp>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace suture {

struct SubdomainMesh;

/// Unknowns of an element: displacements only, or displacements and a separate pressure, discontinuous between elements and eliminated
/// element by element, so that the element does not lock as nu tends to 0.5.
enum class ElementForm { Displacement, Mixed };

/// True for the cells that support enhanced strains: Quadrilateral4 and Hexahedron8.
constexpr bool mayBeEnhanced(Cell cell) { return cell == Cell::Quadrilateral4 || cell == Cell::Hexahedron8; }

/// A linear elastic material: isotropic with two moduli, or with another law.
struct Material {
  std::string name;
  double young = 0.0;    ///< Young modulus [stress]; for another law that of nearestIsotropic()
  double poisson = 0.0;  ///< Poisson ratio [-]; likewise
  ElementForm element = ElementForm::Displacement;
  bool enhanced = false;      ///< Quadrilateral4 and Hexahedron8 use enhanced strains instead of `element`: they bend without locking
  bool allowLocking = false;  ///< allows displacement elements, including linear simplices, although nu is near 0.5
  bool named = false;         ///< the scene names the element type; otherwise a non-locking one was chosen
  int number = 0;  ///< 1-based position in the scene's list, distinguishes materials with equal moduli but other laws or expansions; else 0
  std::shared_ptr<const MaterialLaw> law{};    ///< null: isotropic
  std::optional<double> density{};             ///< [mass / volume], if given in the scene
  std::optional<double> expansion{};           ///< strain of a free body per unit of temperature, if given [1 / temperature]
  std::shared_ptr<const Strength> strength{};  ///< null: none given

  ElasticStiffness stiffness() const { return law ? law->stiffness() : isotropicStiffness({young, poisson}); }
};

/// Out-of-plane quantity that vanishes. Axisymmetric scenes have the law of plane strain, with a hoop strain; their geometry is defined by
/// the mesh (CellBlock::axisymmetric). Unused in 3D, where it is Strain.
enum class PlaneModel { Strain, Stress };

/// Materials of the bodies, the plane model and the loads: the physics of the scene. The same on all ranks.
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
  ExactSolution exact;  ///< fields that are given in the scene

  /// Adds a body, in C++, with elements that do not lock for the plane model and the dimension already set.
  /// \param body  its element group in the mesh \throws InputError  if the law is invalid (MaterialLaw::stiffness), or cannot be used in 2D
  void addBody(const std::string& body, std::shared_ptr<const MaterialLaw> law);

  /// Material of an element of a body: that of its region, or else the body's.
  /// \throws InternalError  if the scene has regions but the mesh has no region numbers (assignRegions).
  const Material& materialOf(const CellBlock& block, int element, int body) const;
  /// True if any material has a strength. The same on all ranks.
  bool hasStrength() const;
  /// True if any material resists volume change much more than shape change: Poisson ratio above 0.45, not in plane stress.
  bool nearlyIncompressible() const;
};

/// True if the scene's `Model` is Axisymmetric. Local.
bool isAxisymmetric(const Parameters& scene);
/// 3 if the scene's `Model` is Solid, else 2. Local.
int sceneDimension(const Parameters& scene);
/// Value of the scene's `Model` for a model. Local.
std::string modelName(const ElasticModel& model);

/// \throws InternalError  if model and block are not both 3D, or not both axisymmetric (makeAxisymmetric() was not called). Local.
void requireGeometry(const CellBlock& block, const ElasticModel& model);
/// The same check when a scene is read and the mesh is the user's. \param source  the mesh, for the message \throws InputError  if `Model`
/// and mesh have different dimensions. Local.
void requireDimension(const CellBlock& mesh, const std::string& source, const ElasticModel& model);

/// Poisson ratio above which 3-node triangles and 4-node tetrahedra lock, except in plane stress.
constexpr double kLockingPoisson = 0.49;

/// Reports elements that do not suit their materials: 3-node triangles and 4-node tetrahedra that lock (unless Displacement is requested
/// explicitly or the material's `Allow Locking` is set) or that are requested as Mixed. Local. \param bodyOf  body of each element \param
/// problems  receives one entry per material and body: the number of elements, what to choose instead, and the path of the material's
/// parameter
void checkElements(const CellBlock& block, const std::function<int(int element)>& bodyOf, const ElasticModel& model, Problems& problems);

/// Schemas of `Model` (added to the scene's top list), one entry of `Bodies`, one of `Materials`.
void addModelParameters(Schema& scene);
Schema bodySchema();
Schema materialSchema();

/// Local, the same on all ranks. \param scene  the whole resolved scene (Model, Bodies, Materials, Boundary Conditions, Constants, Exact
/// Solution).
/// \throws InputError  lists all of: unknown material of a body or region (nearest name), and what readLoads() and readExactSolution() find
ElasticModel makeElasticModel(const Parameters& scene);

/// Compliance of a surface of this material (or its nearest isotropic one) under contact pressure: (1 - nu^2) / E, in plane stress 1 / E.
/// [1 / stress] Local.
double contactCompliance(const Material& material, PlaneModel plane);

/// Stress-strain matrix in Voigt order with engineering shear: 3 x 3 (xx, yy, xy) in 2D; 6 x 6, normals first, in 3D, where `plane` is
/// ignored: its first four rows and columns are the law of axisymmetric bodies (rr, yy, hoop, ry). [stress]
Matrix elasticity(const Material& material, PlaneModel plane, int dimension);

/// Calls `take(element, K)` with the stiffness matrix of every element, in Cartesian components, node-major: dof dimension * node + k. Uses
/// the quadrature of stiffnessElement(), exact for affine cells; any Cell. [force / length, per unit thickness in 2D, of the whole circle
/// in axisymmetric blocks]. Local. Mixed: the Lame constant acts on the projected dilatation (see MixedPressure.hpp) instead of the
/// dilatation. Then the same for the coatings, numbered after the elements (CoatedBlock). K is exactly symmetric and valid during the call
/// only. \throws InputError  for an inverted or folded element.
void elementStiffnesses(const CellBlock& block, const Material& material, PlaneModel plane,
                        const std::function<void(int element, ConstLocalView stiffness)>& take);
/// The same with a material for each element (the whole mesh). A lambda must declare `-> const Material&`; the referenced material must
/// outlive the call.
void elementStiffnesses(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                        const std::function<void(int element, ConstLocalView stiffness)>& take);

/// Nodal forces (nodes x dimension, node-major, Cartesian) of a traction vector or pressure on sides, and of a body force on elements.
/// Consistent: integrals against the shape functions; forces of the whole circle in axisymmetric blocks. Added to `forces`. Local.
void addSideLoad(const CellBlock& block, const std::vector<Side>& sides, const Load& load, Vector& forces);
/// Adds factor x integral of (shape function x outward normal) over a side to the nodal values: the flux of a nodal displacement through
/// it.
void addSideFlux(const CellBlock& block, const Side& side, double factor, Vector& flux);
/// \param density  of an element [mass / volume]: for Gravity and Rotation, which act on mass
void addBodyForce(const CellBlock& block, const std::vector<int>& elements, const Load& load, Vector& forces,
                  const std::function<double(int element)>& density = {});

/// Component of the force of a nodal load (Random or resolved PointForce) on a node of the mesh: a pure function of (load, node,
/// component), and therefore independent of the partition. Cartesian. Local. \throws InternalError  for an unresolved PointForce
double nodeForce(const Load& load, GlobalId node, int component);
/// The same for a Random load: uniform in value[1] + [-value[0], value[0]).
double randomForce(const Load& load, GlobalId node, int component);

/// Stresses at element centroids: 2D: elements x 4 (xx, yy, zz, xy), zz out-of-plane or the hoop stress of axisymmetric blocks; 3D:
/// elements x 6 (xx, yy, zz, xy, yz, xz); tension positive. Mixed elements: with their own pressure. `displacement`: node-major, Cartesian.
/// Initial strains are subtracted, initial stresses added. Local.
Matrix elementStresses(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                       const Vector& displacement, const InitialState& initial = InitialState());

/// The same for a subdomain, with materials and initial states of its model. Local.
Matrix elementStresses(const SubdomainMesh& mesh, const ElasticModel& model, const Vector& displacement);

/// Principal stresses and their directions, row by row of elementStresses(). 2D: in-plane stresses (s1 >= s2, angle of the first axis
/// [rad], in (-pi/2, pi/2] from the x axis, counter-clockwise). 3D: (s1 >= s2 >= s3, unit vector of s1, unit vector of s3), the largest
/// component of each vector positive. Local.
Matrix principalStresses(const Matrix& stresses);

/// von Mises stress of each row of elementStresses(), including the out-of-plane stress. Local.
Vector vonMises(const Matrix& stresses);

}  // namespace suture
