#include "PythonRun.hpp"

#include <pybind11/iostream.h>
#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <iostream>
#include <suture/report/SceneSchema.hpp>

namespace suture::python {

namespace {

SceneFile parsed(const std::string& text, const std::string& name, const std::string& folder, const std::vector<std::string>& overrides) {
  SceneFile file = parseScene(text, name, sceneSchema(), overrides);
  file.folder = folder;
  return file;
}

}  // namespace

PythonRun::PythonRun(const py::object& comm, const std::string& text, const std::string& name, const std::string& folder,
                     const std::vector<std::string>& overrides, bool shows)
    : held_(comm),
      comm_(commOf(comm)),
      monitor_(shows && comm_->getRank() == 0 ? &std::cout : nullptr, false),
      simulation_(comm_, sceneOf(parsed(text, name, folder, overrides)), monitor_, timers_) {}

int PythonRun::rank() const { return comm_->getRank(); }

std::string PythonRun::failure() const {
  const Solution& solution = simulation_.solution();
  if (isDone()) return "";
  if (!solution.failure.empty()) return solution.failure;
  if (!solution.undetermined.empty()) return solution.undetermined;
  return solution.stopped ? "stopped on request" : "the verdict does not hold";
}

template <typename Way>
void PythonRun::go(const Way& way) {
  const py::scoped_ostream_redirect toPython;  // sys.stdout, wherever that goes
  bool interrupted = false;
  monitor_.stopWhen([&] { return interrupted = interrupted || PyErr_CheckSignals() != 0; });
  try {
    way();
  } catch (...) {
    monitor_.stopWhen(nullptr);
    throw;
  }
  monitor_.stopWhen(nullptr);
  if (PyErr_Occurred()) throw py::error_already_set();
}

void PythonRun::solve(const std::optional<std::string>& output, const std::string& restart) {
  go([&] {
    if (output) simulation_.writeInto(*output);
    simulation_.read();
    simulation_.cut();
    simulation_.check();
    simulation_.prepare();
    simulation_.remark();
    simulation_.start(restart);
    simulation_.iterate();
    simulation_.judge();
    Invocation invocation;
    if (!restart.empty()) invocation.restart = usedFile(restart);
    summary_ = output ? simulation_.report(invocation).summary : simulation_.summary(invocation);
  });
}

void PythonRun::solveAgain(bool verified) {
  go([&] { simulation_.solveAgain(verified); });
}

}  // namespace suture::python
