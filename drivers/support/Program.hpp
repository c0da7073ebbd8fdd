#pragma once
#include <suture/base/Errors.hpp>
#include <suture/base/Types.hpp>

#include <exception>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>

namespace suture {

/// Runs the work of a driver between the beginning and the end of MPI and returns the exit code of the program, the same on all ranks.
/// Errors of the work are printed once (see explain()). Where the work ended well and its text could not be written to standard output,
/// the code is Environment. When a rank fails alone, while the others wait for it in a collective, the last
/// resort after two seconds is its message and MPI_Abort with its exit code. One thread a rank, unless the environment says otherwise.
/// \param name     of the program, for messages;  \param subject  the file it works on
int runProgram(const std::string& name, const std::string& subject, const std::function<ExitCode(const CommPtr& comm)>& work);

/// Opens /dev/null in the place of standard input, output and error where the caller has closed them: the next file that is opened, a
/// socket of MPI or a file of results, would be taken for them. Before anything is opened. Local.
void openStandardFiles();

/// The message of a program whose standard output failed with an error number: what it should have printed is lost. Local.
std::string outputFailure(const std::string& name, int error);

/// The exit code of an exception, and the message for the user in the form of doc/style.md: "suture_solve: 3 errors in scene.xml", then a
/// line "  path: message" each. Local.
struct Explanation {
  ExitCode code;
  std::string message;
};
Explanation explain(const std::string& name, const std::string& subject, const std::exception& error);

/// Where all ranks meet after a piece of work that may have thrown: on a communicator of its own, so that no message of work that was left
/// behind can meet one of these. That communicator is kept by the given one and freed with it: Python destroys objects in another order on
/// each rank. Construction is collective, destruction is local.
class MeetingPoint {
 public:
  explicit MeetingPoint(const Comm& comm);
  ~MeetingPoint();
  MeetingPoint(const MeetingPoint&) = delete;
  MeetingPoint& operator=(const MeetingPoint&) = delete;

  /// The worst exit code of all ranks, and on all ranks the message of the first one that has one. A rank with a message waits two seconds
  /// for the others, then prints it and aborts: they wait for it in the work. Collective.
  Explanation settle(const Explanation& mine) const;

  /// Holds every rank until all are here: none ends the program before another has spoken. Collective.
  void wait() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// True if this process is the first of its mpirun, also before MPI begins: a help text is printed once.
bool isFirstProcess();

/// True if standard output is a terminal whose user has nothing against colours (NO_COLOR). False below mpirun: Open MPI gives each rank a
/// terminal, wherever its own output goes.
bool isTerminal();

/// Standard output on rank 0, null on the others and when quiet.
std::ostream* consoleOf(const Comm& comm, bool quiet);

}  // namespace suture
