// The extension module of the Python package, wrapped by suture/__init__.py.
#include <mpi4py/mpi4py.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_Core.hpp>
#include <cstdlib>
#include <suture/base/Version.hpp>
#include <suture/base/hdf5/Hdf5Library.hpp>

#include "../../drivers/support/MpiStart.hpp"
#include "Together.hpp"

// Null if the library is not loaded.
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

/// Initialises as a program does: one thread per rank, and Kokkos. MPI is initialised by mpi4py.
void begin() {
  if (omp_set_num_threads && !std::getenv("OMP_NUM_THREADS")) omp_set_num_threads(1);
  if (openblas_set_num_threads && !std::getenv("OPENBLAS_NUM_THREADS")) openblas_set_num_threads(1);
  hdf5::withoutExitHandler();
  int argc = 1;
  char name[] = "python", *arguments[] = {name, nullptr}, **argv = arguments;
  Tpetra::initialize(&argc, &argv);
  // Registered to run before mpi4py finalises MPI.
  py::module_::import("atexit").attr("register")(py::cpp_function([] {
    interpreterEnds();
    Tpetra::finalize();
  }));
}

}  // namespace

PYBIND11_MODULE(_suture, module) {
  {
    // The import initialises MPI, unless the user's program has already done so; then the settings have no effect.
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
