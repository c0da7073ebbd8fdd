#pragma once
#include <suture/base/Errors.hpp>
#include <suture/constraints/ConditionData.hpp>
#include <suture/constraints/SupportDirection.hpp>
#include <suture/mesh/Mesh.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// One boundary condition: an entry of the scene's list `Boundary Conditions`, or made in C++.
struct Condition {
  enum class Type {
    Displacement,
    Bilateral,
    Traction,
    Pressure,
    Force,
    Moment,
    PointForce,
    BodyForce,
    Gravity,
    Rotation,
    Temperature,
    InitialStrain,
    InitialStress,
    MeanDisplacement,
    Preload,
    ElasticSupport,
    RandomLoad,
    RigidGroup
  };
  std::string name;
  std::string path;  ///< "Boundary Conditions/push", for messages
  Type type = Type::Bilateral;
  std::vector<std::string> groups;            ///< side groups; none for body loads, and for conditions at a point
  std::optional<Point> point;                 ///< node that a Displacement holds, instead of groups; reference point of a RigidGroup
  double tolerance = 0.0;                     ///< largest distance of that node [length]; 0: 1e-6 of the bodies' extent
  int node = -1;                              ///< that node, once found by conditionsOn() or readConditions()
  std::vector<int> components;                ///< prescribed by a Displacement
  std::optional<SupportDirection> direction;  ///< the only component that a Displacement prescribes, instead of components
  ConditionData data;                         ///< data of each component, also for loads; none for types without a value
  std::string body;                           ///< body of a body load or of a node at a point; empty: all bodies
  int factor = 0;                             ///< number of its factor in LoadSteps

  double normal = 0.0, tangential = 0.0;  ///< stiffness of an ElasticSupport [stress / length]
  /// Prescribed motions of a RigidGroup: displacements of its point [length], rotations about the axes; in 2D the last one about z
  std::array<std::optional<double>, 6> motions{};
  bool movesFar = false;  ///< masters of a RigidGroup are chosen among its positionNodes

  bool holds() const { return type == Type::Displacement || type == Type::Bilateral; }
  /// True if it acts on side groups; otherwise it acts on whole bodies, or at a point.
  bool onSides() const;
  /// Prescribed displacements of the node at a point. \param values, components  as for displacement()
  static Condition pointSupport(const Point& point, const std::vector<double>& values, const std::vector<int>& components = {0, 1});

  /// Prescribed displacements of a side group. \param values  one per component [length] \param components  prescribed ones, ascending
  static Condition displacement(const std::string& group, const std::vector<double>& values, const std::vector<int>& components = {0, 1});
  /// Prescribed displacement of a side group along a direction only. \param value  [length]
  static Condition along(const std::string& group, const SupportDirection& direction, double value);
  /// Normal displacement zero, free to slide.
  static Condition bilateral(const std::string& group);
};

/// Conditions that act on existing parts of the mesh. Local. \param problems  gets: a group or body that the mesh does not have, an empty
/// group, components and values of different numbers
std::vector<Condition> conditionsOn(const Mesh& mesh, const std::vector<Condition>& conditions, Problems& problems);

/// Reads the list; an entry with a problem is omitted. Local.
/// \param problems  gets: the problems of conditionsOn(), a parameter that the type does not take or lacks, a wrong number of values, an
/// invalid expression
std::vector<Condition> readConditions(const Mesh& mesh, const Parameters& conditions, const Constants& constants, Problems& problems);

}  // namespace suture
