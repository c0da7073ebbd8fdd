#pragma once
#include <suture/quality/PathWork.hpp>

#include <string>
#include <vector>

namespace suture {

struct Run;

/// One load step of a run: a row of the console's table, of steps.csv and of summary.json.
struct StepRow {
  int step = 0;            ///< from 1 on
  double time = 0.0;       ///< its end
  double length = 0.0;     ///< length of the step in time
  int outer = 0, pcg = 0;  ///< outer iterations and operator applications, those of given up trials included
  int givenUp = 0;         ///< trials that were too long
  int active = 0, sticking = 0, slipping = 0;
  int changed = 0;  ///< pairs that opened, closed, stuck or slipped in it
  double residual = 0.0, energy = 0.0;
  PathWork work;                  ///< on the path up to its end
  double seconds = 0.0;           ///< that it took
  std::vector<Point> forceOnB{};  ///< on rank 0: sum of the contact forces on side B of each contact line [force]
};

/// steps.csv: a header line, then a row a load step: members of StepRow by their names, and the forces of each contact line.
/// \param contacts  names of the lines. Written whole. Local. \throws EnvironmentError
void writeSteps(const std::vector<StepRow>& rows, const std::vector<std::string>& contacts, const std::string& path);

/// Fields of the last of the steps, in the place of those of an earlier run: fields_0000.vtkhdf for the first step, contact_0000.vtkhdf
/// likewise, and the files fields.vtkhdf.series and contact.vtkhdf.series that tell ParaView their times. Collective.
/// \throws EnvironmentError
void writeStepFields(const Run& run, const std::vector<StepRow>& rows);

/// Removes such files of steps beyond the first `kept`. Local.
void removeStepFields(const std::string& folder, std::size_t kept);

}  // namespace suture
