#pragma once
#include <suture/base/Errors.hpp>
#include <suture/constraints/ConditionData.hpp>
#include <suture/mesh/Mesh.hpp>

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
    RandomLoad
  };
  std::string name;
  std::string path;  ///< "Boundary Conditions/push", for messages
  Type type = Type::Bilateral;
  std::vector<std::string> groups;  ///< side groups; none for loads on bodies and at points
  std::vector<int> components;      ///< prescribed by a Displacement
  ConditionData data;               ///< data of each component, of loads as well; none for types without a value
  std::string body;                 ///< body of a load on bodies or at a point; empty: all bodies
  int factor = 0;                   ///< number of its factor among those of LoadSteps

  double normal = 0.0, tangential = 0.0;  ///< stiffness of an ElasticSupport [stress / length]

  bool holds() const { return type == Type::Displacement || type == Type::Bilateral; }
  /// Acts on side groups; else on bodies as a whole, or at a point.
  bool onSides() const;

  /// Displacements given on a side group. \param values  one a component [length] \param components  the prescribed ones, ascending
  static Condition displacement(const std::string& group, const std::vector<double>& values, const std::vector<int>& components = {0, 1});
  /// Normal displacement zero, free to slide.
  static Condition bilateral(const std::string& group);
};

/// Those that the mesh has a place for. Local. \param problems  gets: a group or body that the mesh does not have, an empty group,
/// components and values of different numbers
std::vector<Condition> conditionsOn(const Mesh& mesh, const std::vector<Condition>& conditions, Problems& problems);

/// Reads the list; an entry with a problem is left out. Local.
/// \param problems  gets: what conditionsOn() finds, a parameter that the type does not take or lacks, a wrong number of values, a bad
/// expression
std::vector<Condition> readConditions(const Mesh& mesh, const Parameters& conditions, const Constants& constants, Problems& problems);

}  // namespace suture
