#pragma once
#include <suture/constraints/Conditions.hpp>

#include <string>
#include <vector>

namespace suture {

/// Form of one type of boundary condition: where it acts, and which parameters it takes. One table serves the reader, its messages and
/// the schema.
struct ConditionForm {
  enum class Place { Sides, Body, Point };  ///< a side group, one body or all of them, a node

  std::string name;
  Condition::Type type;
  Place place;
  std::vector<std::string> components;  ///< in 2D: endings of `Expression`, one per entry of `Value`: " x", or ""; empty: no value
  std::vector<std::string> inSpace;     ///< endings in 3D
  bool varies;                          ///< may be given by expressions
  std::vector<std::string> needs;       ///< further parameters that it must have
  std::vector<std::string> may;         ///< further parameters that it may have
  std::string instead;                  ///< text for messages about a type without a value: "it has Amplitude and Seed"

  const std::vector<std::string>& componentsIn(int dimension) const { return dimension == 3 ? inSpace : components; }
  /// Names of its expressions. \param which  components of a Displacement: "All", "x", "xz"
  std::vector<std::string> expressions(int dimension, const std::string& which = "All") const;
  bool takes(const std::string& parameter) const;
  /// True if it may have `Components`: it prescribes some components, the others are free.
  bool isPartial() const { return type == Condition::Type::Displacement || type == Condition::Type::MeanDisplacement; }
};

/// All types, in the order of the schema.
const std::vector<ConditionForm>& conditionForms();
const ConditionForm& formOf(Condition::Type type);
/// \throws InternalError  if no type has this name
const ConditionForm& formNamed(const std::string& name);

/// Prescribed motions of a Rigid Group: displacements of its point along x, y, z, and rotations about these axes.
const std::vector<std::string>& motionNames();

/// Parameters that only some types take, except `Group`, `Body`, `Components`, `Value` and expressions.
std::vector<std::string> specialParameters();
/// Name with its article: "a Traction", "an Elastic Support".
std::string withArticle(const std::string& name);
/// Types that take a special parameter: "a Random Load or a Rotation".
std::string takersOf(const std::string& parameter);

}  // namespace suture
