#pragma once
#include <suture/elasticity/ElasticModel.hpp>

namespace suture {

/// Reads the loads and elastic supports among the scene's `Boundary Conditions` into the model, whose bodies and materials must be set.
/// Local, the same on all ranks. \param problems  receives: an unknown body, wrong numbers of values, a load that the model does not allow
/// (a moment on a body of revolution), a material without a property that a load needs
void readLoads(const Parameters& scene, const Constants& constants, ElasticModel& model, Problems& problems);

/// Checks loads made in C++: numbers of expressions, and everything that is checked for a scene file. Local.
void checkLoads(const ElasticModel& model, Problems& problems);

/// Notes for the user: singular stresses under point forces, one note for all of them. Local.
std::vector<std::string> loadNotes(const ElasticModel& model);

}  // namespace suture
