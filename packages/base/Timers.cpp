#include "Timers.hpp"

#include <malloc.h>
#include <sys/resource.h>

#include <Teuchos_Comm.hpp>
#include <algorithm>
#include <chrono>
#include <fstream>
#include <numeric>

#include "Buffer.hpp"
#include "Collective.hpp"
#include "Progress.hpp"

namespace suture {

Timers::Scope::Scope(Timers& timers, const std::string& phase) : timers_(timers), phase_(phase), begin_(now()) {
  timers_.add(phase_, 0.0);
  Progress::phase(phase_);
}

Timers::Scope::~Scope() {
  timers_.add(phase_, now() - begin_);
  Progress::phase("");
}

Timers::Timers() : begin_(now()) {}

void Timers::add(const std::string& phase, double seconds) {
  const auto [entry, isNew] = seconds_.emplace(phase, 0.0);
  if (isNew) order_.push_back(phase);
  entry->second += seconds;
}

double Timers::seconds(const std::string& phase) const {
  const auto found = seconds_.find(phase);
  return found == seconds_.end() ? 0.0 : found->second;
}

double Timers::total() const { return now() - begin_; }

std::vector<Timers::Statistics> Timers::statistics(const Comm& comm) const {
  Packer packer;
  packer.put(order_.size());
  for (const std::string& phase : order_) {
    packer.put(phase);
    packer.put(seconds(phase));
  }
  // Phases in the order of the first rank that has them. Every rank computes the statistics itself: a few dozen numbers per rank.
  std::vector<std::string> phases;
  std::map<std::string, std::vector<double>> byPhase;
  for (const std::string& bytes : allGather(comm, packer.bytes())) {
    Unpacker unpacker(bytes);
    for (std::size_t left = unpacker.get<std::size_t>(); left > 0; --left) {
      const std::string phase = unpacker.get<std::string>();
      if (byPhase.count(phase) == 0) phases.push_back(phase);
      byPhase[phase].push_back(unpacker.get<double>());
    }
  }
  std::vector<Statistics> all;
  for (const std::string& phase : phases) {
    std::vector<double>& values = byPhase[phase];
    values.resize(comm.getSize(), 0.0);  // ranks that never entered the phase
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    all.push_back({phase, *least, std::accumulate(values.begin(), values.end(), 0.0) / comm.getSize(), *most});
  }
  return all;
}

double Timers::now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double peakMemoryMb() {
  // ru_maxrss of getrusage is inherited over exec from mpirun; the kernel's VmHWM is that of this program.
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.compare(0, 6, "VmHWM:") == 0) return std::stod(line.substr(6)) / 1024.0;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void giveBackFreedMemory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

bool resetPeakMemory() {
  giveBackFreedMemory();  // freed memory that malloc retains would count as resident
  std::ofstream request("/proc/self/clear_refs");
  request << "5" << std::flush;  // proc(5): resets the peak resident set size
  return request.good();
}

}  // namespace suture
