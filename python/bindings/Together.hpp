#pragma once
#include <functional>
#include <string>

#include "../../drivers/support/Program.hpp"
#include "Bindings.hpp"

namespace suture {
namespace SUTURE_HIDDEN python {

/// Runs `work`, which may be collective, and then meets the other ranks: an exception on any rank, from the library or from Python
/// (including sys.exit and Ctrl-C), becomes the same exception on all. A rank that leaves `work` alone, while the others wait inside, ends
/// all ranks after two seconds (MeetingPoint). Collective.
void together(const Comm& comm, const MeetingPoint& meeting, const std::function<void()>& work);
/// The same, with a new meeting point.
void together(const Comm& comm, const std::function<void()>& work);

/// Calls a user function. An exception that it raises is kept for together(), and passes through the library as an Error with the same
/// text. Local. \param kind  of the function, for messages  \throws InputError
py::object called(const py::object& function, const std::string& kind, const py::tuple& arguments, const py::dict& named);

/// True once the user requests the end of the run, by Ctrl-C or by sys.exit() in a user function. Runs Python's signal handlers. Local.
bool endIsWanted();

/// Drops kept exceptions of user functions that a study has already reported in its table. Local.
void dropErrorsOfRuns();

/// Marks the end of the interpreter: from now on, objects that hold vectors of the library do not free them.
void interpreterEnds();
bool interpreterHasEnded();

/// Redirects standard output to sys.stdout during its lifetime, unless that is closed.
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
