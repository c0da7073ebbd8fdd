#pragma once
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

/// A substitute for preCICE 3 with the functions of Participant that a solid adapter calls, combined with the other program: in each of
/// two windows it presses a mesh on -1 <= x <= 1 with 17 nodes down, with half the load in the first iteration and the full load in the
/// others. It refuses calls in an order that preCICE refuses, and prints the displacements of the last iteration.
namespace precice {

using VertexID = int;

class Participant {
 public:
  Participant(const std::string& name, const std::string& configuration, int rank, int size) {
    expect(name == "Suture" && configuration == "precice-config.xml" && rank >= 0 && rank < size, "wrong names or ranks");
  }

  void setMeshVertices(const std::string& mesh, const std::vector<double>& coordinates, std::vector<VertexID>& ids) {
    expect(!isInitialised_ && mesh == "Solid-Mesh" && coordinates.size() == 2 * ids.size(), "a mesh too late or of another size");
    coordinates_ = coordinates;
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<VertexID>(i);
  }

  bool requiresInitialData() {
    expect(!isInitialised_, "initial data too late");
    return asked_ = true;
  }

  void initialize() {
    expect(asked_ && written_ == coordinates_.size(), "no initial data");
    isInitialised_ = true;
  }

  bool isCouplingOngoing() const { return window_ < 2; }
  double getMaxTimeStepSize() const { return 0.5; }
  bool requiresWritingCheckpoint() {
    const bool is = iteration_ == 0;
    asked_ = true;
    return is;
  }
  bool requiresReadingCheckpoint() {
    asked_ = true;
    return iteration_ > 0;
  }

  void readData(const std::string& mesh, const std::string& data, const std::vector<VertexID>& ids, double time,
                std::vector<double>& values) const {
    expect(isInitialised_ && mesh == "Solid-Mesh" && data == "Force" && time <= 0.5, "data read that are not there");
    const double pressure = (window_ + 1) * 1e4 * (iteration_ == 0 ? 0.5 : 1.0);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      values.at(2 * i) = 0.0;
      values.at(2 * i + 1) = -pressure * (std::abs(coordinates_[2 * i]) == 1.0 ? 0.5 : 1.0) * 2.0 / 16;
    }
  }

  void writeData(const std::string& mesh, const std::string& data, const std::vector<VertexID>& ids, const std::vector<double>& values) {
    expect(mesh == "Solid-Mesh" && data == "Displacement" && values.size() == 2 * ids.size(), "other data written than there are");
    written_ = values.size();
    displacements_ = values;
  }

  void advance(double time) {
    expect(asked_ && written_ == coordinates_.size() && time == 0.5, "advance() without data or checkpoints");
    asked_ = false;
    if (++iteration_ == 3) {
      iteration_ = 0;
      ++window_;
    }
  }

  void finalize() {
    double low = 1.0, high = -1.0;
    for (std::size_t i = 1; i < displacements_.size(); i += 2) {
      low = std::min(low, displacements_[i]);
      high = std::max(high, displacements_[i]);
    }
    if (!displacements_.empty()) std::printf("displacements from %.8f to %.8f\n", low, high);
  }

 private:
  static void expect(bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  }

  std::vector<double> coordinates_, displacements_;
  std::size_t written_ = 0;
  bool isInitialised_ = false, asked_ = false;
  int window_ = 0, iteration_ = 0;
};

}  // namespace precice
