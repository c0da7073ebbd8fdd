#pragma once
#include <suture/answer/verdict/PathWork.hpp>

#include <string>
#include <vector>

namespace suture {

struct Run;

/// One load step of a run: a row of the console's table, of steps.csv and of summary.json.
struct StepRow {
  int step = 0;            ///< starting from 1
  double time = 0.0;       ///< time at the end of the step
  double length = 0.0;     ///< length of the step in time
  int outer = 0, pcg = 0;  ///< outer iterations and operator applications, including rejected trials
  int givenUp = 0;         ///< rejected trials
  int active = 0, sticking = 0, slipping = 0;
  int changed = 0;  ///< pairs that opened, closed, stuck or slipped in the step
  double residual = 0.0, energy = 0.0;
  PathWork work;         ///< on the path up to the end of the step
  double seconds = 0.0;  ///< wall-clock time of the step
  /// Place of a body that moves far: displacement of its centre [length], rotation vector (in 2D the angle with all turns) [radians].
  struct Frame {
    int body = -1;
    Point displacement{0, 0, 0}, rotation{0, 0, 0};
  };
  std::vector<Frame> frames{};  ///< on rank 0, by connected part of the bodies; empty for bodies that do not move far
  /// Motion of a rigid group from the drawn body, and what its condition does to the body: prescribed motions, `Force` and `Moment`.
  struct Group {
    std::string name;
    Point displacement{0, 0, 0}, rotation{0, 0, 0};  ///< motion of its point [length], rotation vector [radians]; in 2D with all turns
    Point force{0, 0, 0}, moment{0, 0, 0};           ///< moment about its point where it is now [force, force x length]
  };
  std::vector<Group> groups{};    ///< on rank 0, by condition
  std::vector<Point> forceOnB{};  ///< on rank 0: sum of the contact forces on side B of each contact line [force]
};

/// steps.csv: a header line, then one row per load step: members of StepRow by their names, and the forces of each contact line.
/// \param contacts  names of the lines. Replaces the file. Local. \throws EnvironmentError
void writeSteps(const std::vector<StepRow>& rows, const std::vector<std::string>& contacts, const std::string& path);

/// frames.csv: one row per load step and moving body. \param bodies  names. Replaces the file. Local. \throws EnvironmentError
void writeFrames(const std::vector<StepRow>& rows, const std::vector<std::string>& bodies, const std::string& path);

/// rigid_groups.csv: one row per load step and rigid group. Replaces the file. Local. \throws EnvironmentError
void writeRigidGroups(const std::vector<StepRow>& rows, const std::string& path);

/// Writes the fields of the last step, replacing those of an earlier run: fields_0000.vtkhdf for the first step, contact_0000.vtkhdf
/// likewise, and the files fields.vtkhdf.series and contact.vtkhdf.series with their times for ParaView. Collective.
/// \throws EnvironmentError
void writeStepFields(const Run& run, const std::vector<StepRow>& rows);

/// Removes field files of steps beyond the first `kept`. Local.
void removeStepFields(const std::string& folder, std::size_t kept);

}  // namespace suture
