// The extension module of the Python package: what suture/__init__.py is made of.
#include <mpi4py/mpi4py.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_Core.hpp>
#include <cstdlib>
#include <suture/base/Version.hpp>
#include <suture/base/hdf5/Hdf5File.hpp>

#include "../../drivers/support/MpiStart.hpp"
#include "Together.hpp"

// The symbol of a library that is not in the process is absent.
extern "C" {
void openblas_set_num_threads(int) __attribute__((weak));
void omp_set_num_threads(int) __attribute__((weak));
}

namespace suture::python {

CommPtr commOf(const py::object& comm) {
  MPI_Comm* raw = PyMPIComm_Get(comm.ptr());
  if (!raw) throw py::error_already_set();
  return Teuchos::rcp(new Teuchos::MpiComm<int>(Teuchos::opaqueWrapper(*raw)));
}

namespace {

/// As a program begins: the ranks are the parallelism, and Kokkos runs. MPI is mpi4py's.
void begin() {
  if (omp_set_num_threads && !std::getenv("OMP_NUM_THREADS")) omp_set_num_threads(1);
  if (openblas_set_num_threads && !std::getenv("OPENBLAS_NUM_THREADS")) openblas_set_num_threads(1);
  Hdf5File::withoutExitHandler();
  int argc = 1;
  char name[] = "python", *arguments[] = {name, nullptr}, **argv = arguments;
  Tpetra::initialize(&argc, &argv);
  // Before mpi4py ends MPI.
  py::module_::import("atexit").attr("register")(py::cpp_function([] {
    interpreterEnds();
    Tpetra::finalize();
  }));
}

}  // namespace

PYBIND11_MODULE(_suture, module) {
  {
    // The import begins MPI, unless the user's program has done so before: then the settings come too late and change nothing.
    const MpiStart start;
    if (import_mpi4py() < 0) throw py::error_already_set();
    begin();
  }
  module.attr("version") = version();
  module.attr("commit") = commit();
  bindErrors(module);
  bindRuns(module);
  bindStrategies(module);
  bindStudies(module);
  bindTogether(module);
}

}  // namespace suture::python
