#pragma once
#include <suture/base/Errors.hpp>
#include <suture/constraints/ConditionData.hpp>
#include <suture/mesh/Mesh.hpp>

#include <string>
#include <vector>

namespace suture {

/// One entry of the scene's list `Boundary Conditions`, its form checked.
struct Condition {
  enum class Type { Displacement, Bilateral, Traction, Pressure, BodyForce, RandomLoad };
  std::string name;
  std::string path;  ///< "Boundary Conditions/push", for messages
  Type type = Type::Bilateral;
  std::vector<std::string> groups;  ///< curve groups; none for a body force or random load
  std::vector<int> components;      ///< prescribed by a Displacement
  ConditionData data;               ///< data of each component, of loads as well; none for Bilateral and RandomLoad

  bool holds() const { return type == Type::Displacement || type == Type::Bilateral; }
};

/// Reads the list; an entry with a problem is left out. Local.
/// \param problems  gets: a group or body that the mesh does not have, a parameter that the type does not take or lacks, a wrong number of
/// values, a bad
/// expression
std::vector<Condition> readConditions(const Mesh& mesh, const Parameters& conditions, const Constants& constants, Problems& problems);

/// "in the mesh m.geo: no such curve group 'x'. ...": the sentence for a group that is not there.
std::string unknownCurve(const Mesh& mesh, const std::string& group);

}  // namespace suture
