#pragma once
#include <streambuf>
#include <string>

namespace suture {

/// Stands behind std::cout while it lives. A reader that takes nothing (a terminal on hold, a pipe that nobody empties, an mpirun that is
/// about to end its ranks) holds a run up only until a signal asks it to stop: text that the reader then does not take is dropped.
class StoppableOutput : private std::streambuf {
 public:
  StoppableOutput();
  ~StoppableOutput() override;
  StoppableOutput(const StoppableOutput&) = delete;
  StoppableOutput& operator=(const StoppableOutput&) = delete;

 private:
  int_type overflow(int_type letter) override;
  std::streamsize xsputn(const char* text, std::streamsize length) override;
  int sync() override;

  std::streambuf* before_;
  std::string text_;  // written, and not yet sent
};

}  // namespace suture
