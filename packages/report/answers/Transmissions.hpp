#pragma once
#include <suture/base/scene/Schema.hpp>
#include <suture/report/Steps.hpp>

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace suture {

/// A transmission of the scene (`Output/Transmissions/<name>`): how the motion of one rigid group follows that of another over the load
/// steps, as of two gears, a screw and its nut, a rack and its pinion.
struct Transmission {
  /// One component of the motion of a rigid group, and the component of force or moment that does work on it.
  struct Side {
    std::string group;  ///< name of the condition
    bool rotates = true;
    std::size_t axis = 2;
  };
  std::string name, path;  ///< path: "Output/Transmissions/<name>", for messages
  Side driving, driven;
  double ratio = 0.0;  ///< motion of the driven group over that of the driving one, if bodies were rigid

  std::string fileName() const;  ///< "transmission_<name>.csv"; see tableName()
};

/// Schema of one entry of `Output/Transmissions`.
Schema transmissionSchema();

/// Reads the list `Output/Transmissions`. Local. \throws InputError  lists all of: a group that is no Rigid Group of the scene, a motion
/// that a 2D scene does not have, a scene without load steps, two transmissions with the same file
std::vector<Transmission> readTransmissions(const Parameters& scene);

/// Motions and loads of a transmission at the end of a load step.
struct TransmissionRow {
  int step = 0;
  double time = 0.0;
  double driving = 0.0, driven = 0.0;          ///< motions from the drawn bodies [length or radians]
  double error = 0.0;                          ///< transmission error: driven - ratio * driving
  double drivingLoad = 0.0, drivenLoad = 0.0;  ///< force or moment of each condition on its body, along the motion
};

/// One row per load step. Local. \param steps  of rank 0: StepRow::groups
std::vector<TransmissionRow> transmissionRows(const std::vector<StepRow>& steps, const Transmission& transmission);

/// Work that the driven body delivers over that put into the driving one, from the end of the first row to the last; loads vary linearly
/// between rows. Not a number if the driving group does no work.
double transmissionEfficiency(const std::vector<TransmissionRow>& rows);

/// Writes one table per transmission into a folder. Local. \throws EnvironmentError
void writeTransmissions(const std::vector<StepRow>& steps, const std::vector<Transmission>& transmissions, const std::string& folder);

/// {name: figures} for summary.json. Local.
nlohmann::ordered_json transmissionsJson(const std::vector<StepRow>& steps, const std::vector<Transmission>& transmissions);

}  // namespace suture
