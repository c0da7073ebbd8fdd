#pragma once
#include <suture/elasticity/ElasticModel.hpp>

namespace suture {

/// Reads the loads and elastic supports among the scene's `Boundary Conditions` into the model, whose bodies and materials are known.
/// Local, the same on all ranks. \param problems  gets: an unknown body, wrong numbers of values, a load that the model cannot have (a
/// moment on a body of revolution), a material without the property that a load asks for
void readLoads(const Parameters& scene, const Constants& constants, ElasticModel& model, Problems& problems);

/// Checks loads made in C++: numbers of expressions, and all that is checked in a scene file. Local.
void checkLoads(const ElasticModel& model, Problems& problems);

/// Notes for the user: singular stresses under point forces. Local.
std::vector<std::string> loadNotes(const ElasticModel& model);

}  // namespace suture
