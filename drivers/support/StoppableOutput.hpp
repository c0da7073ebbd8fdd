#pragma once
#include <mutex>
#include <streambuf>
#include <string>

namespace suture {

/// Stream buffer of std::cout during its lifetime. A reader that blocks (a suspended terminal, a pipe that nobody empties, an mpirun about
/// to end its ranks) delays a run only until a stop signal arrives; text that the reader does not take after that is dropped.
class StoppableOutput : public std::streambuf {
 public:
  StoppableOutput();
  ~StoppableOutput() override;
  StoppableOutput(const StoppableOutput&) = delete;
  StoppableOutput& operator=(const StoppableOutput&) = delete;

  bool isTerminal() const { return terminal_; }
  /// Error number of the first failed write (a full disk, a full device); 0 if none. Local.
  int failure();
  /// Prints a line from another thread between two lines of the program: on a terminal until the next text, otherwise permanently on
  /// standard error, to keep standard output clean. No effect while the program is within a line.
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
  std::string text_;      // written, but not sent yet
  bool endsLine_ = true;  // the text sent last ended a line
  int failure_ = 0;       // error number of the first failed write
  bool isWiped_ = true;   // the terminal shows no line of between()
};

}  // namespace suture
