#pragma once
#include <string>
#include <vector>

#include "Study.hpp"

namespace suture::study {

/// One combination of a study.
struct Combination {
  int number = 0;                   ///< from 1, over all combinations of the study
  std::vector<std::size_t> choice;  ///< index of the label, for each sweep
  std::string scene;                ///< path of the scene file
  std::vector<std::string> overrides;
  /// Origin of each override, for messages: "Sweeps/size/scale", "Set", "--set".
  std::vector<std::string> origins;
};

/// All combinations that pass `only`, the last sweep varying fastest. \param set  overrides of the command line, which replace those of the
/// study's Set. Errors in them are added to `problems`. Local.
std::vector<Combination> combinations(const Study& study, const std::vector<std::string>& set, const Filter& only, Problems& problems);

/// Checks scene and parameters of every run as suture_solve would before it reads the mesh, so that no error appears after hours.
/// Reads each scene file once. \throws InputError  the problems of all runs, without duplicates, with their place in the study. Collective.
void checkRuns(const Comm& comm, const Study& study, const std::vector<Combination>& runs);

/// "size=h/2  seed=3". Local.
std::string labelsOf(const Study& study, const Combination& run);

/// Reads --only of the command line: "label" or "sweep=label"; several labels of one sweep add up. Local.
Filter readOnly(const Study& study, const std::vector<std::string>& only, Problems& problems);

}  // namespace suture::study
