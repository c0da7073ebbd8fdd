#pragma once
#include <suture/base/Errors.hpp>
#include <suture/base/Types.hpp>

#include <exception>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>

namespace suture {

/// Runs the work of a driver between the start and the end of MPI and returns the exit code of the program, the same on all ranks.
/// Errors are printed once (see explain()). If the work succeeds but standard output cannot be written, the code is Environment. If one
/// rank fails while the others wait for it in a collective, it prints its message after two seconds and calls MPI_Abort with its exit
/// code. Uses one thread per rank, unless the environment specifies otherwise.
/// \param name     of the program, for messages;  \param subject  the input file
int runProgram(const std::string& name, const std::string& subject, const std::function<ExitCode(const CommPtr& comm)>& work);

/// Opens /dev/null for each of standard input, output and error that the caller has closed; otherwise the next file opened (a socket of
/// MPI, a result file) would get its descriptor. Call before anything is opened. Local.
void openStandardFiles();

/// The message for a failed standard output with an error number. Local.
std::string outputFailure(const std::string& name, int error);

/// The exit code of an exception, and the message for the user in the form of doc/style.md: "suture_solve: 3 errors in scene.xml", then one
/// line "  path: message" per error. Local.
struct Explanation {
  ExitCode code;
  std::string message;
};
Explanation explain(const std::string& name, const std::string& subject, const std::exception& error);

/// Meeting point of all ranks after work that may have thrown. It uses its own communicator, so that its messages cannot match messages
/// left over from the work. The given communicator keeps and frees that communicator, because Python destroys objects in a different order
/// on each rank. Construction is collective, destruction is local.
class MeetingPoint {
 public:
  explicit MeetingPoint(const Comm& comm);
  ~MeetingPoint();
  MeetingPoint(const MeetingPoint&) = delete;
  MeetingPoint& operator=(const MeetingPoint&) = delete;

  /// Returns the worst exit code of all ranks, and the message of the first rank that has one, on all ranks. A rank with a message waits
  /// two seconds for the others, then prints the message and aborts, because the others still wait for it in the work. Collective.
  Explanation settle(const Explanation& mine) const;

  /// Barrier, so that no rank ends the program before another has printed. Collective.
  void wait() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// True if this process is the first of its mpirun; works before MPI starts, e.g. to print a help text once.
bool isFirstProcess();

/// True if standard output is a terminal and colours are not disabled (NO_COLOR). False below mpirun, because Open MPI gives each rank a
/// terminal, regardless of where its own output goes.
bool isTerminal();

/// Standard output on rank 0; null on other ranks and if quiet.
std::ostream* consoleOf(const Comm& comm, bool quiet);

}  // namespace suture
