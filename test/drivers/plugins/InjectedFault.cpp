// Throws exceptions on one rank, anywhere in a run, without test code in the product: this library is preloaded (LD_PRELOAD). It replaces
// the begin of a phase (Timers::Scope) and wraps MPI's functions (the profiling interface PMPI) and collectively(). See injected.py.
//   SUTURE_TEST_FAULT="phase place number rank kind"   place phase: at its begin (number 0); message: before its n-th communication on that
//                                                      rank; work: in the n-th local work that ends collectively
//                                                      kind stop: no exception, but a SIGTERM, and the next phase begins after six seconds
//   SUTURE_TEST_COUNTS=FILE                            lines "rank phase messages works" in FILE.<rank> when MPI ends
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Timers.hpp>

#include <dlfcn.h>
#include <mpi.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <new>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace {

struct Counts {
  int messages = 0, works = 0;
};

struct Fault {
  std::string phase, place, kind, now;
  int number = 0, rank = -1;
  bool thrown = false, late = false;
  std::map<std::string, Counts> counts;

  static Fault& instance() {
    static Fault fault;
    return fault;
  }
  void begin(const std::string& name) {
    if (late) std::this_thread::sleep_for(std::chrono::seconds(6));
    late = false;
    now = name;
    counts.emplace(name, Counts());
    reach("phase", 0);
  }
  void communication() {
    if (!now.empty()) reach("message", ++counts[now].messages);
  }
  void work() {
    if (!now.empty()) reach("work", ++counts[now].works);
  }
  void over() { now.clear(); }

 private:
  Fault() {
    if (const char* wanted = std::getenv("SUTURE_TEST_FAULT")) std::istringstream(wanted) >> phase >> place >> number >> rank >> kind;
    unsetenv("LD_PRELOAD");  // child programs run without the library
  }
  void reach(const char* here, int count) {
    if (thrown || now != phase || here != place || count != number) return;
    int mine = -1;
    PMPI_Comm_rank(MPI_COMM_WORLD, &mine);
    if (mine != rank) return;
    thrown = true;
    if (kind == "stop") {
      late = true;
      std::raise(SIGTERM);
      return;
    }
    const std::string text = "injected fault";
    if (kind == "memory") throw std::bad_alloc();
    if (kind == "input") throw suture::InputError("Some/Parameter", text);
    if (kind == "numerical") throw suture::NumericalError(text);
    if (kind == "environment") throw suture::EnvironmentError(text);
    throw std::runtime_error(text);
  }
};

}  // namespace

namespace suture {

Timers::Scope::Scope(Timers& timers, const std::string& phase) : timers_(timers), phase_(phase), begin_(now()) {
  timers_.add(phase_, 0.0);
  Fault::instance().begin(phase);
}

void collectively(const Comm& comm, const std::string& what, const std::function<void()>& local) {
  using Function = void (*)(const Comm&, const std::string&, const std::function<void()>&);
  static const Function next = [] {
    Dl_info mine{};
    dladdr(reinterpret_cast<void*>(static_cast<Function>(&collectively)), &mine);
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, mine.dli_sname));
  }();
  next(comm, what, [&] {
    Fault::instance().work();
    local();
  });
}

}  // namespace suture

#define SUTURE_BEFORE(function, parameters, arguments) \
  int MPI_##function parameters {                      \
    Fault::instance().communication();                 \
    return PMPI_##function arguments;                  \
  }

extern "C" {
// The ranks agree on the outcome of the run (MeetingPoint): no longer a phase.
int MPI_Iallreduce(const void* in, void* out, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm, MPI_Request* request) {
  Fault::instance().over();
  return PMPI_Iallreduce(in, out, n, type, op, comm, request);
}
SUTURE_BEFORE(Allreduce, (const void* in, void* out, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm), (in, out, n, type, op, comm))
SUTURE_BEFORE(Bcast, (void* data, int n, MPI_Datatype type, int root, MPI_Comm comm), (data, n, type, root, comm))
SUTURE_BEFORE(Barrier, (MPI_Comm comm), (comm))
SUTURE_BEFORE(Allgather, (const void* in, int n, MPI_Datatype type, void* out, int m, MPI_Datatype other, MPI_Comm comm),
              (in, n, type, out, m, other, comm))
SUTURE_BEFORE(Send, (const void* data, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm), (data, n, type, to, tag, comm))
SUTURE_BEFORE(Recv, (void* data, int n, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Status* status),
              (data, n, type, from, tag, comm, status))
SUTURE_BEFORE(Isend, (const void* data, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request* request),
              (data, n, type, to, tag, comm, request))
SUTURE_BEFORE(Irecv, (void* data, int n, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Request* request),
              (data, n, type, from, tag, comm, request))

int MPI_Finalize() {
  int rank = 0;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (const char* path = std::getenv("SUTURE_TEST_COUNTS"); path) {
    std::ofstream file(path + ("." + std::to_string(rank)));
    for (const auto& [phase, count] : Fault::instance().counts)
      file << rank << ' ' << phase << ' ' << count.messages << ' ' << count.works << '\n';
  }
  return PMPI_Finalize();
}
}
