#pragma once
#include <string>
#include <vector>

#include "Study.hpp"

namespace suture::study {

/// One combination of a study.
struct Combination {
  int number = 0;                   ///< from 1, over all combinations of the study
  std::vector<std::size_t> choice;  ///< of each sweep the index of its label
  std::string scene;                ///< path of the scene file
  std::vector<std::string> overrides;
  /// Where each override comes from, for messages: "Sweeps/size/scale", "Set", "--set".
  std::vector<std::string> origins;
};

/// All combinations that `only` leaves, the last sweep varying fastest. \param set  assignments of the command line; they take the place of
/// those of the study's Set. What is wrong with them goes to `problems`. Local.
std::vector<Combination> combinations(const Study& study, const std::vector<std::string>& set, const Filter& only, Problems& problems);

/// Checks scene and parameters of every run as suture_solve would before it reads the mesh, so that nothing wrong is found after hours.
/// Reads each scene file once. \throws InputError  with the problems of all runs, each once, named by where the study has them. Collective.
void checkRuns(const Comm& comm, const Study& study, const std::vector<Combination>& runs);

/// "size=h/2  seed=3". Local.
std::string labelsOf(const Study& study, const Combination& run);

/// Argument of --only on the command line: "label" or "sweep=label", several of one sweep add up. Local.
Filter readOnly(const Study& study, const std::vector<std::string>& only, Problems& problems);

}  // namespace suture::study
