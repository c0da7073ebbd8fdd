// Makes an exception of one rank an exception on all ranks.
#include "Together.hpp"

#include <pybind11/iostream.h>
#include <Teuchos_Comm.hpp>
#include <exception>
#include <optional>
#include <suture/base/Collective.hpp>

namespace suture::python {

namespace {

/// The pending Python exception while C++ works. One per process; never freed, since it may outlive the interpreter.
std::optional<py::error_already_set>& kept() {
  static auto* one = new std::optional<py::error_already_set>;
  return *one;
}

std::string nameOf(const py::error_already_set& error) { return py::str(error.type().attr("__name__")); }

std::string textOf(const py::error_already_set& error) {
  const std::string text = py::str(error.value());
  return nameOf(error) + (text.empty() ? "" : ": " + text);
}

/// SystemExit, KeyboardInterrupt: not an error, but a request to end.
bool isWish(const py::error_already_set& error) { return !error.matches(PyExc_Exception); }

bool isBySignal = false;  // refers to the kept exception

void keep(py::error_already_set&& error) {
  if (!kept() || (isWish(error) && !isWish(*kept()))) kept().emplace(std::move(error));
}

/// An exception as bytes; if it cannot be pickled, a RuntimeError with its text.
std::string pickled(const py::error_already_set& error, int rank, bool& isItself) {
  const py::object pickle = py::module_::import("pickle");
  const auto bytes = [&](const py::object& value) { return std::string(py::bytes(pickle.attr("dumps")(value))); };
  try {
    const std::string own = bytes(error.value());
    pickle.attr("loads")(py::bytes(own));
    isItself = true;
    return own;
  } catch (const py::error_already_set&) {
    const py::object plain = py::reinterpret_borrow<py::object>(PyExc_RuntimeError);
    return bytes(plain("on rank " + std::to_string(rank) + ": " + textOf(error)));
  }
}

/// Raises the exception kept by the lowest rank on all ranks, if there is one. Collective.
void raiseKept(const Comm& comm) {
  std::optional<py::error_already_set> own;
  own.swap(kept());
  bool isItself = false;
  const std::vector<std::string> all = allGather(comm, own ? pickled(*own, comm.getRank(), isItself) : std::string());
  for (std::size_t rank = 0; rank < all.size(); ++rank) {
    if (all[rank].empty()) continue;
    if (static_cast<int>(rank) == comm.getRank() && isItself) throw py::error_already_set(*own);  // with its traceback
    const py::object value = py::module_::import("pickle").attr("loads")(py::bytes(all[rank]));
    PyErr_SetObject(py::type::of(value).ptr(), value.ptr());
    throw py::error_already_set();
  }
}

}  // namespace

void together(const Comm& comm, const MeetingPoint& meeting, const std::function<void()>& work) {
  kept().reset();
  isBySignal = false;
  std::exception_ptr thrown;
  Explanation mine{ExitCode::Done, ""};
  try {
    work();
  } catch (py::error_already_set& error) {
    mine = {ExitCode::Internal, textOf(error)};
    keep(std::move(error));
  } catch (const Error& error) {
    thrown = std::current_exception();
    mine = {error.code(), error.what()};
  } catch (const std::bad_alloc&) {
    thrown = std::make_exception_ptr(EnvironmentError("out of memory"));
    mine = {ExitCode::Environment, "out of memory"};
  } catch (const std::exception& error) {
    thrown = std::make_exception_ptr(InternalError(error.what()));
    mine = {ExitCode::Internal, error.what()};
  }
  if (kept() && mine.message.empty()) mine = {ExitCode::Internal, textOf(*kept())};
  if (mine.code != ExitCode::Done && mine.message.empty()) mine.message = "an exception without a text";
  if (meeting.settle(mine).message.empty()) return;
  raiseKept(comm);
  collectively(comm, "", [&] {
    if (thrown) std::rethrow_exception(thrown);
  });
}

void together(const Comm& comm, const std::function<void()>& work) {
  const MeetingPoint meeting(comm);
  together(comm, meeting, work);
}

py::object called(const py::object& function, const std::string& kind, const py::tuple& arguments, const py::dict& named) {
  try {
    return function(*arguments, **named);
  } catch (py::error_already_set& error) {
    const std::string text = textOf(error);
    keep(std::move(error));
    throw InputError(kind, "the Python function raised " + text);
  }
}

bool endIsWanted() {
  if (kept() && (isBySignal || isWish(*kept()))) return true;
  if (PyErr_CheckSignals() == 0) return false;
  keep(py::error_already_set());
  isBySignal = true;
  return true;
}

void dropErrorsOfRuns() {
  if (kept() && !isBySignal && !isWish(*kept())) kept().reset();
}

namespace {
bool hasEnded = false;
}

void interpreterEnds() { hasEnded = true; }
bool interpreterHasEnded() { return hasEnded; }

struct ToPythonsOutput::Impl {
  py::scoped_ostream_redirect redirect;
};

ToPythonsOutput::ToPythonsOutput() {
  if (!py::module_::import("sys").attr("stdout").is_none()) impl_ = std::make_unique<Impl>();
}
ToPythonsOutput::~ToPythonsOutput() = default;

void bindTogether(py::module_& module) {
  module.def(
      "together",
      [](const py::object& comm, const py::object& make) {
        py::object result;
        const CommPtr ranks = commOf(comm);
        together(*ranks, [&] { result = make(); });
        return result;
      },
      "Returns the result of make() on this rank; an exception on any rank is raised on all.");
}

}  // namespace suture::python
