#pragma once
#include <suture/report/Checkpoint.hpp>
#include <suture/simulation/SceneParts.hpp>
#include <suture/solver/Method.hpp>

#include <string>

namespace suture {

/// State of the load path of a scene at the end of a step: histories, what remains of removed and placed parts, and the reference of
/// `Displacements Since`. Local. \param pairs  of the solution
PathState pathStateOf(const SceneParts& parts, const std::vector<PairResult>& pairs);

/// Restores what remains of removed and placed parts in a phase, and the reference of `Displacements Since`; after the mesh is cut. Local.
void restore(SceneParts& parts, const PathState& state);

/// \throws InputError  a path beyond the time of `Displacements Since` whose state lacks displacements of that time
void requireReference(const SceneParts& parts, const PathState& state);

/// Solution at the end of the last step of a path, as far as the next step or phase needs it: displacements, pairs, energy. Sets loads and
/// pairs to that time. Collective. \throws InputError  the state has no displacements of the time of `Displacements Since`
Solution lastSolution(SceneParts& parts, const Start& start, const PathState& state);

/// Note that a path continues after its last step.
std::string continuesText(const SceneParts& parts);

/// \throws InputError  a checkpoint after other removals and placements than those of a scene \param path  of the checkpoint
/// \param phases  null: nothing is removed or placed
void requireSameChanges(const PathState& state, const Phases* phases, const std::string& path);

/// \throws InputError  a checkpoint of bodies that move far for a scene whose bodies do not, or the reverse \param path  of the checkpoint
void requireSameMotion(const PathState& state, bool movesFar, const std::string& path);

}  // namespace suture
