// Runs studies as suture_study does.
#include <pybind11/stl.h>
#include <Teuchos_Comm.hpp>

#include "../../drivers/study/Loop.hpp"
#include "../../drivers/study/Options.hpp"
#include "../../drivers/support/Plugins.hpp"
#include "../../drivers/support/StopSignals.hpp"
#include "Together.hpp"

namespace suture::python {

void bindStudies(py::module_& module) {
  module.def("run_study", [](const py::object& comm, const std::string& file, const std::string& output,
                             const std::vector<std::string>& overrides, const std::vector<std::string>& only, bool quiet) {
    const ToPythonsOutput toPython;
    study::Options options;
    options.study = file;
    options.output = output;
    options.overrides = overrides;
    options.only = only;
    options.quiet = quiet;
    options.commandLine = {"suture.study", file};
    const CommPtr ranks = commOf(comm);
    const StopsByHost stops(endIsWanted);
    ExitCode end = ExitCode::Done;
    together(*ranks, [&] {
      end = study::run(ranks, options);
      dropErrorsOfRuns();
    });
    return std::make_pair(static_cast<int>(end), options.folder());
  });
  module.def("load_plugins", &loadPlugins);
}

}  // namespace suture::python
