#pragma once
#include <functional>
#include <string>

#include "../../drivers/support/Program.hpp"
#include "Bindings.hpp"

namespace suture {
namespace SUTURE_HIDDEN python {

/// Runs `work`, a collective piece of it, and meets the other ranks after it: an exception on any of them, of the library or of Python
/// (sys.exit and Ctrl-C among them), is the same exception on all. A rank that leaves `work` alone, while the others wait for it inside,
/// ends all after two seconds (MeetingPoint). Collective.
void together(const Comm& comm, const MeetingPoint& meeting, const std::function<void()>& work);
/// The same, with a meeting point of its own.
void together(const Comm& comm, const std::function<void()>& work);

/// Calls a function of the user. What it raises is kept for together(), and goes through the library as an Error with the same text. Local.
/// \param kind  what the function is, for messages  \throws InputError
py::object called(const py::object& function, const std::string& kind, const py::tuple& arguments, const py::dict& named);

/// True once the user wants the run to end: by Ctrl-C, or by sys.exit() in one of his functions. Runs Python's handlers of signals. Local.
bool endIsWanted();

/// Errors of the user's functions that a study has told in its table are no errors of the study. Local.
void dropErrorsOfRuns();

/// The interpreter ends: objects that hold vectors of the library are left as they are from now on, since what would free them has ended.
void interpreterEnds();
bool interpreterHasEnded();

/// Standard output goes to sys.stdout while it lives, unless that is closed.
class ToPythonsOutput {
 public:
  ToPythonsOutput();
  ~ToPythonsOutput();
  ToPythonsOutput(const ToPythonsOutput&) = delete;
  ToPythonsOutput& operator=(const ToPythonsOutput&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

void bindTogether(py::module_& module);

}  // namespace python
}  // namespace suture
