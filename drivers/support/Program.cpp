#include "Program.hpp"

#include <fcntl.h>
#include <mpi.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_Core.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <new>
#include <optional>
#include <suture/base/Collective.hpp>
#include <suture/base/Memory.hpp>
#include <suture/base/hdf5/Hdf5Library.hpp>
#include <suture/report/Console.hpp>
#include <suture/report/Format.hpp>
#include <thread>
#include <vector>

#include "MpiStart.hpp"
#include "StoppableOutput.hpp"

// OpenBLAS and OpenMP read their environment when they are loaded, before main; the symbol of a library that is not linked is null.
extern "C" {
void openblas_set_num_threads(int) __attribute__((weak));
void omp_set_num_threads(int) __attribute__((weak));
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*, const int*, const double*,
            const int*, const double*, double*, const int*) __attribute__((weak));
}

namespace suture {
namespace {

constexpr double secondsForOthers = 2.0;  // time for the other ranks to arrive after one has failed

void oneThreadARank() {
  if (omp_set_num_threads && !std::getenv("OMP_NUM_THREADS")) omp_set_num_threads(1);
  if (openblas_set_num_threads && !std::getenv("OPENBLAS_NUM_THREADS")) openblas_set_num_threads(1);
}

// By default glibc maps every large block anew and returns it when it is freed: each work matrix then costs one page fault per 4 kB.
// Tunnel of 937,439 unknowns, 512 subdomains, two ranks: 369,000 page faults by default, 256,000 with this setting; same peak.
void keepFreedMemory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_TOP_PAD, 1 << 24);
#endif
}

// OpenBLAS allocates its work space at its first product, and retries for ever if that fails. Allocate it now or end the run.
void giveBlasItsMemory() {
  constexpr double buffer = 256.0;  // megabytes; OpenBLAS 0.3.21 maps 32 to 128, depending on the processor
  if (const double left = addressSpaceLeft(); left < buffer)
    throw EnvironmentError("the address space limit (ulimit -v) leaves " + gigabytes(left) + " to this process, but at least " +
                           gigabytes(buffer) + " are needed to start; raise the limit");
  if (!dgemm_) return;
  constexpr int n = 64;
  const double one = 1.0;
  const std::vector<double> a(n * n, 1.0);
  std::vector<double> b(n * n, 0.0);
  dgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, a.data(), &n, &one, b.data(), &n);
}

void print(const std::string& message) {
  std::cout.flush();
  std::fputs(message.c_str(), stderr);
  std::fflush(stderr);
}

[[noreturn]] void abortAll(const std::string& message, ExitCode code = ExitCode::Internal) {
  print(message);
  MPI_Abort(MPI_COMM_WORLD, int(code));
  std::_Exit(int(code));
}

// Indents all lines after the first.
std::string indented(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    result += text[i];
    if (text[i] != '\n') continue;
    while (i + 1 < text.size() && text[i + 1] == ' ') ++i;
    if (i + 1 < text.size()) result += "    ";
  }
  return result;
}

std::string inputErrors(const std::string& name, const std::string& subject, const std::vector<Problem>& problems) {
  std::string text =
      name + ": " + counted(static_cast<long long>(problems.size()), "error") + (subject.empty() ? "" : " in " + subject) + "\n";
  constexpr std::size_t most = 100;
  for (std::size_t i = 0; i < std::min(most, problems.size()); ++i) {
    const Problem& problem = problems[i];
    text += "  " + (problem.path.empty() ? "" : problem.path + ": ") + indented(problem.message) + "\n";
  }
  if (problems.size() > most) text += "  ... and " + std::to_string(problems.size() - most) + " more\n";
  return text;
}

}  // namespace

void openStandardFiles() {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    // open() returns the lowest free number, which is this one.
    if (fcntl(file, F_GETFD) == -1 && open("/dev/null", file == STDIN_FILENO ? O_RDONLY : O_WRONLY) != file) std::_Exit(5);
}

std::string outputFailure(const std::string& name, int error) {
  return name + ": standard output cannot be written: " + std::strerror(error) + "\n";
}

Explanation explain(const std::string& name, const std::string& subject, const std::exception& error) {
  const std::string begin = name + ": ", of = subject.empty() ? "" : " " + subject;
  if (const auto* input = dynamic_cast<const InputError*>(&error)) return {input->code(), inputErrors(name, subject, input->problems())};
  if (dynamic_cast<const std::bad_alloc*>(&error))
    return {ExitCode::Environment, begin + "out of memory" + (subject.empty() ? "" : " in " + subject) + "\n"};
  const std::string what = indented(error.what()) + "\n";
  if (const auto* ours = dynamic_cast<const Error*>(&error); ours && ours->code() != ExitCode::Internal) {
    if (ours->code() == ExitCode::CommandLine) return {ours->code(), begin + what + "  '" + name + " --help' lists the options\n"};
    if (ours->code() == ExitCode::Numerical) return {ours->code(), begin + "no solution of" + of + "\n  " + what + advice("  ")};
    return {ours->code(), begin + what};
  }
  return {ExitCode::Internal, begin + "internal error" + (subject.empty() ? "" : " in " + subject) + "\n  " + what +
                                  "  This is a bug in Suture: please report it together with the scene.\n"};
}

namespace {

int freeMeeting(MPI_Comm parent, int, void* kept, void*) {
  auto* meeting = static_cast<MPI_Comm*>(kept);
  if (parent != MPI_COMM_WORLD && parent != MPI_COMM_SELF) MPI_Comm_free(meeting);  // those end in MPI_Finalize, together with `meeting`
  delete meeting;
  return MPI_SUCCESS;
}

/// The communicator that `parent` keeps for its meetings; created on first use. Collective.
MPI_Comm meetingOf(MPI_Comm parent) {
  static const int key = [] {
    int made = MPI_KEYVAL_INVALID;
    MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, freeMeeting, &made, nullptr);
    return made;
  }();
  void* kept = nullptr;
  int isKept = 0;
  MPI_Comm_get_attr(parent, key, &kept, &isKept);
  if (!isKept) {
    auto made = std::make_unique<MPI_Comm>();
    MPI_Comm_dup(parent, made.get());
    MPI_Comm_set_attr(parent, key, made.get());
    kept = made.release();
  }
  return *static_cast<MPI_Comm*>(kept);
}

}  // namespace

struct MeetingPoint::Impl {
  MPI_Comm comm;
};

MeetingPoint::MeetingPoint(const Comm& comm) : impl_(std::make_unique<Impl>()) {
  const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(&comm);
  impl_->comm = meetingOf(mpi ? (*mpi->getRawMpiComm())() : MPI_COMM_SELF);
}

MeetingPoint::~MeetingPoint() = default;

Explanation MeetingPoint::settle(const Explanation& mine) const {
  const int code = int(mine.code);
  int worst = 0, done = 0;
  MPI_Request request;
  MPI_Iallreduce(&code, &worst, 1, MPI_INT, MPI_MAX, impl_->comm, &request);
  const double begin = MPI_Wtime();
  // A rank that has succeeded waits without limit: the rank that it waits for either arrives or aborts.
  for (MPI_Test(&request, &done, MPI_STATUS_IGNORE); !done; MPI_Test(&request, &done, MPI_STATUS_IGNORE)) {
    if (!mine.message.empty() && MPI_Wtime() - begin > secondsForOthers)
      abortAll(mine.message + "  Only this rank failed and the others still wait for it: aborting.\n", mine.code);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  int rank, ranks, first;
  MPI_Comm_rank(impl_->comm, &rank);
  MPI_Comm_size(impl_->comm, &ranks);
  const int speaks = mine.message.empty() ? ranks : rank;
  MPI_Allreduce(&speaks, &first, 1, MPI_INT, MPI_MIN, impl_->comm);
  std::string message = rank == first ? mine.message : "";
  if (first < ranks) {
    int length = int(message.size());
    MPI_Bcast(&length, 1, MPI_INT, first, impl_->comm);
    message.resize(std::size_t(length));
    MPI_Bcast(message.data(), length, MPI_CHAR, first, impl_->comm);
  }
  return {ExitCode(worst), message};
}

void MeetingPoint::wait() const { MPI_Barrier(impl_->comm); }

int runProgram(const std::string& name, const std::string& subject, const std::function<ExitCode(const CommPtr& comm)>& work) {
  oneThreadARank();
  keepFreedMemory();
  setenv("HWLOC_HIDE_ERRORS", "2", 0);  // MPI uses hwloc, which prints errors on machines without /sys
  StoppableOutput output;
  hdf5::withoutExitHandler();
  // An empty command line, since Kokkos would look for its own options.
  int argc = 1;
  std::string program = name;
  char* arguments[] = {program.data(), nullptr};
  char** argv = arguments;
  std::optional<MpiStart> start(std::in_place);
  const Tpetra::ScopeGuard scope(&argc, &argv);
  start.reset();
  const MeetingPoint meeting(*Tpetra::getDefaultComm());
  std::set_terminate([] { abortAll("suture: terminated by an uncaught exception\n"); });

  Explanation end{ExitCode::Done, ""};
  try {
    collectively(*Tpetra::getDefaultComm(), "preparing BLAS", giveBlasItsMemory);
    end.code = work(Tpetra::getDefaultComm());
  } catch (const std::exception& error) {
    end = explain(name, subject, error);
  } catch (...) {
    end = {ExitCode::Internal, name + ": internal error: an exception of unknown type\n"};
  }
  std::cout.flush();
  if (const int error = output.failure(); error != 0) {
    if (end.code == ExitCode::Done) end.code = ExitCode::Environment;
    end.message += outputFailure(name, error);
  }
  end = meeting.settle(end);
  if (!end.message.empty() && Tpetra::getDefaultComm()->getRank() == 0) print(end.message);
  meeting.wait();
  return int(end.code);
}

bool isFirstProcess() {
  const char* rank = launchedRank();
  return !rank || std::string(rank) == "0";
}

bool isTerminal() { return isatty(STDOUT_FILENO) != 0 && !launchedRank() && !std::getenv("NO_COLOR"); }

std::ostream* consoleOf(const Comm& comm, bool quiet) { return quiet || comm.getRank() != 0 ? nullptr : &std::cout; }

}  // namespace suture
