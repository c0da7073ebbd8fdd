#include "Memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

#include "Errors.hpp"

namespace suture {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double megabyte = 1 << 20;

double numberIn(const std::string& path) {
  std::ifstream file(path);
  double number = 0.0;
  return file >> number ? number : infinite;
}

}  // namespace

double availableMegabytes() {
  double available = infinite;
  std::ifstream file("/proc/meminfo");
  for (std::string line; std::getline(file, line);)
    if (line.compare(0, 13, "MemAvailable:") == 0) available = std::stod(line.substr(13)) / 1024;
  // Control groups of versions 2 and 1, as seen from inside a container.
  const double limits[] = {
      numberIn("/sys/fs/cgroup/memory.max") - numberIn("/sys/fs/cgroup/memory.current"),
      numberIn("/sys/fs/cgroup/memory/memory.limit_in_bytes") - numberIn("/sys/fs/cgroup/memory/memory.usage_in_bytes")};
  for (const double left : limits)
    if (std::isfinite(left)) available = std::min(available, std::max(0.0, left) / megabyte);
  return available;
}

double addressSpaceLeft() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return infinite;
  double pages = numberIn("/proc/self/statm");  // the first number: total address space
  if (!std::isfinite(pages)) pages = 0.0;
  const double taken = pages * static_cast<double>(sysconf(_SC_PAGESIZE));
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - taken) / megabyte;
}

void mustFit(double megabytes, const std::string& what) {
  const double have = std::min(availableMegabytes(), addressSpaceLeft());
  if (!(megabytes <= have))
    throw EnvironmentError(what + " needs about " + gigabytes(megabytes) + " of memory; only " + gigabytes(have) + " is available");
}

std::string gigabytes(double megabytes) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(megabytes < 10240 ? 2 : 1) << megabytes / 1024 << " GB";
  return text.str();
}

}  // namespace suture
