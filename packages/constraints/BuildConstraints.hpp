#pragma once
#include <suture/base/Expression.hpp>
#include <suture/base/scene/Schema.hpp>
#include <suture/constraints/Conditions.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/constraints/LoadSteps.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/pairs/ContactSurface.hpp>

#include <functional>
#include <string>

namespace suture {

/// Schemas of one entry of the scene's lists `Boundary Conditions` (all types, loads included) and `Contact`.
Schema boundaryConditionSchema();
Schema contactSchema();

/// Properties of the bodies, in addition to their mesh, that contact needs.
struct ContactScales {
  /// Compliance of an element's material under contact pressure: (1 - nu^2) / E, in plane stress 1 / E [1 / stress]. If the function is
  /// empty, all bodies count as equally compliant, and pressure errors are not estimated.
  std::function<double(const Mesh& mesh, int element)> compliance;
  std::string lengthUnit;  ///< for notes, as "mm"
};

/// Changes a condition before it is applied; empty: none changes.
using ConditionChange = std::function<void(Condition& condition)>;

/// Turns boundary conditions and contacts into nodal rules, pairs and pieces. Local (rank 0).
///
/// Nodal rules: each condition gives rows (direction, value) at its nodes: Displacement one row per prescribed component, Bilateral the row
/// (averaged outward normal, 0). At a node where several conditions meet, equal directions need equal values, a second independent
/// direction (in 3D a third) fixes the node, and contradictions are errors. A contact node without prescribed component gets the axes
/// (normal, tangent) of its pair, with mortar the mean of several, if it is in exactly one contact; with a prescribed component its rule is
/// unchanged (the contact row is then scaled, not rotated).
///
/// If the mesh is a later shape of bodies that move far (Mesh::drawn), the two sides of a contact may face each other nowhere: it then has
/// no pairs.
///
/// \param scales  material data: stiffer bodies keep more of their shape when pressed together
/// \param steps  gives conditions their factors
/// \param choices  of mortars on an earlier shape, which are kept where possible and replaced; null: none
/// \throws InputError  all of: unknown group (nearest, known); a group in contradictory roles (a contact side that a displacement holds as
///                     a whole, both sides of one contact the same group or the same body, a side in two contacts); sides that do not
///                     match (nodes on each, nodes without partner, distance); a side that is not on the boundary; contradictory
///                     prescribed values (place, the two conditions); an expression that cannot be read, or has no finite value
///                     (place).
Constraints buildConstraints(const Mesh& mesh, const std::vector<Condition>& conditions, const std::vector<Contact>& contacts,
                             const ContactScales& scales = {}, const LoadSteps& steps = {}, const ConditionChange& change = {},
                             KeptChoices* choices = nullptr);

/// Reads conditions and contacts from a scene. \param conditions  its list `Boundary Conditions` \param contact  its list `Contact`
/// \param constants  for their expressions
Constraints buildConstraints(const Mesh& mesh, const Parameters& conditions, const Parameters& contact, const Constants& constants = {},
                             const ContactScales& scales = {}, const LoadSteps& steps = {}, const ConditionChange& change = {},
                             KeptChoices* choices = nullptr);

}  // namespace suture
