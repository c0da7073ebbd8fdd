#pragma once
#include <suture/constraints/Conditions.hpp>

#include <string>
#include <vector>

namespace suture {

/// The form of one type of boundary condition: where it acts, and which parameters it takes. One table for the reader, its messages and
/// the schema.
struct ConditionForm {
  enum class Place { Sides, Body, Point };  ///< a side group, one body or all of them, a node

  std::string name;
  Condition::Type type;
  Place place;
  std::vector<std::string>
      components;                    ///< in the plane: endings of `Expression`, one for each entry of `Value`: " x", or ""; none: no value
  std::vector<std::string> inSpace;  ///< the same in space
  bool varies;                       ///< may be given by expressions
  std::vector<std::string> needs;    ///< further parameters that it must have
  std::vector<std::string> may;      ///< further parameters that it may have
  std::string instead;               ///< words for messages of a type without a value: "it has Amplitude and Seed"

  const std::vector<std::string>& componentsIn(int dimension) const { return dimension == 3 ? inSpace : components; }
  /// Names of its expressions. \param which  components of a Displacement: "All", "x", "xz"
  std::vector<std::string> expressions(int dimension, const std::string& which = "All") const;
  bool takes(const std::string& parameter) const;
  /// May have `Components`: some of its components, the others free.
  bool isPartial() const { return type == Condition::Type::Displacement || type == Condition::Type::MeanDisplacement; }
};

/// All types, in the order in which the schema lists them.
const std::vector<ConditionForm>& conditionForms();
const ConditionForm& formOf(Condition::Type type);
/// \throws InternalError  there is none of this name
const ConditionForm& formNamed(const std::string& name);

/// Parameters that some types take and others do not, but `Group`, `Body`, `Components`, `Value` and expressions.
std::vector<std::string> specialParameters();
/// "a Traction", "an Elastic Support".
std::string withArticle(const std::string& name);
/// "a Random Load or a Rotation": the types that take a special parameter.
std::string takersOf(const std::string& parameter);

}  // namespace suture
