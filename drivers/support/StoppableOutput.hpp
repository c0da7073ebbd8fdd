#pragma once
#include <mutex>
#include <streambuf>
#include <string>

namespace suture {

/// Stands behind std::cout while it lives. A reader that takes nothing (a terminal on hold, a pipe that nobody empties, an mpirun that is
/// about to end its ranks) holds a run up only until a signal asks it to stop: text that the reader then does not take is dropped.
class StoppableOutput : public std::streambuf {
 public:
  StoppableOutput();
  ~StoppableOutput() override;
  StoppableOutput(const StoppableOutput&) = delete;
  StoppableOutput& operator=(const StoppableOutput&) = delete;

  bool isTerminal() const { return terminal_; }
  /// Error number of the first text that could not be written (a full disk, a device without room); 0: none. Local.
  int failure();
  /// A line of another thread, between two lines of the program: on a terminal until the next text, else for good on standard error, where
  /// it is in nobody's way who reads the output. Nothing happens while the program is within a line of its own.
  void between(const std::string& line);

 private:
  int_type overflow(int_type letter) override;
  std::streamsize xsputn(const char* text, std::streamsize length) override;
  int sync() override;
  int send();
  void wipe();

  std::streambuf* before_;
  const bool terminal_;
  std::mutex mutex_;
  std::string text_;      // written, and not yet sent
  bool endsLine_ = true;  // the text sent before did
  int failure_ = 0;       // of the first write that failed
  bool isWiped_ = true;   // no line of between() stands on the terminal
};

}  // namespace suture
