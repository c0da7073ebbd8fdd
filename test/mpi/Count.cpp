// Counts the MPI messages and collectives of each rank by calling place (LD_PRELOAD, profiling interface PMPI). MPI_Finalize writes one
// JSON file per rank, $SUTURE_TEST_COUNT.<rank>.json; see README.md.
#include <mpi.h>

#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <link.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace {

constexpr int kDeep = 64, kNamed = 12;

struct Count {
  long calls = 0;
  double bytes = 0.0, most = 0.0;
  std::set<int> peers;  // receivers of messages
};

using Key = std::pair<const char*, std::vector<const void*>>;
std::map<Key, Count> counts;
int depth = 0;  // MPI functions that call others are counted once

// Exported name of a function that belongs to the program or to Suture; "" for the system's libraries, this one, and functions without a
// name (the preceding exported name would be wrong).
std::string nameOf(const void* address) {
  static const void* own = [] {
    Dl_info info{};
    dladdr(reinterpret_cast<void*>(&nameOf), &info);
    return info.dli_fbase;
  }();
  Dl_info info{};
  ElfW(Sym)* symbol = nullptr;
  if (!dladdr1(address, &info, reinterpret_cast<void**>(&symbol), RTLD_DL_SYMENT) || !info.dli_fname || info.dli_fbase == own) return "";
  const auto begins = [&](const char* with) { return std::strncmp(info.dli_fname, with, std::strlen(with)) == 0; };
  if (begins("/usr/") || begins("/lib")) return "";
  if (!info.dli_sname || !symbol || static_cast<const char*>(address) >= static_cast<const char*>(info.dli_saddr) + symbol->st_size)
    return "";
  int status = 0;
  char* plain = abi::__cxa_demangle(info.dli_sname, nullptr, nullptr, &status);
  std::string name = status == 0 ? plain : info.dli_sname;
  std::free(plain);
  // Without arguments, and without the text of lambdas and templates that make names long.
  if (const auto bracket = name.find('('); bracket != std::string::npos && bracket > 0) name.resize(bracket);
  for (char& c : name)
    if (c == '"' || c == '\\') c = '\'';
  return name;
}

const std::string& knownName(const void* address) {
  static auto& known = *new std::unordered_map<const void*, std::string>;
  const auto [found, isNew] = known.emplace(address, std::string());
  if (isNew) found->second = nameOf(address);
  return found->second;
}

void note(const char* function, double bytes, int peer = -1) {
  void* stack[kDeep];
  const int frames = backtrace(stack, kDeep);
  Key key{function, {}};
  for (int k = 0; k < frames && static_cast<int>(key.second.size()) < kNamed; ++k)
    if (!knownName(stack[k]).empty()) key.second.push_back(stack[k]);
  Count& count = counts[key];
  ++count.calls;
  count.bytes += bytes;
  count.most = std::max(count.most, bytes);
  if (peer >= 0) count.peers.insert(peer);
}

double bytesOf(double number, MPI_Datatype type) {
  int size = 0;
  if (type != MPI_DATATYPE_NULL) PMPI_Type_size(type, &size);
  return number * size;
}
int sizeOf(MPI_Comm comm) {
  int size = 1;
  PMPI_Comm_size(comm, &size);
  return size;
}
int rankIn(MPI_Comm comm) {
  int rank = 0;
  PMPI_Comm_rank(comm, &rank);
  return rank;
}
double sum(const int* numbers, MPI_Comm comm) {
  double all = 0.0;
  for (int i = 0; i < sizeOf(comm); ++i) all += numbers[i];
  return all;
}
int inWorld(int rank, MPI_Comm comm) {
  MPI_Group own, world;
  PMPI_Comm_group(comm, &own);
  PMPI_Comm_group(MPI_COMM_WORLD, &world);
  int number = -1;
  PMPI_Group_translate_ranks(own, 1, &rank, world, &number);
  PMPI_Group_free(&own);
  PMPI_Group_free(&world);
  return number == MPI_UNDEFINED ? -1 : number;
}

struct Inside {
  Inside() { ++depth; }
  ~Inside() { --depth; }
};

std::string inQuotes(const std::string& text) { return "\"" + text + "\""; }

void write(const std::string& path) {
  std::map<std::pair<std::string, std::string>, Count> named;
  for (const auto& [key, count] : counts) {
    std::string place;
    for (const void* address : key.second) place += (place.empty() ? "" : ", ") + inQuotes(knownName(address));
    Count& all = named[{key.first, place}];
    all.calls += count.calls;
    all.bytes += count.bytes;
    all.most = std::max(all.most, count.most);
    all.peers.insert(count.peers.begin(), count.peers.end());
  }
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (!file) return;
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  std::fprintf(file, "{\"peak_kb\": %ld, \"counts\": [", used.ru_maxrss);
  bool isFirst = true;
  for (const auto& [key, count] : named) {
    std::fprintf(file, "%s\n{\"function\": \"%s\", \"place\": [%s], \"calls\": %ld, \"bytes\": %.0f, \"most\": %.0f, \"peers\": %zu}",
                 isFirst ? "" : ",", key.first.c_str(), key.second.c_str(), count.calls, count.bytes, count.most, count.peers.size());
    isFirst = false;
  }
  std::fprintf(file, "]}\n");
  std::fclose(file);
}

}  // namespace

// The remaining arguments are passed to note(): bytes, and the receiver of a message.
#define COUNTED_MPI(name, parameters, arguments, ...) \
  int MPI_##name parameters {                         \
    if (depth == 0) note(#name, __VA_ARGS__);         \
    const Inside inside;                              \
    return PMPI_##name arguments;                     \
  }

extern "C" {

int MPI_Init(int* argc, char*** argv) {
  const int code = PMPI_Init(argc, argv);
  unsetenv("LD_PRELOAD");  // child programs of the run do not load the library
  return code;
}
int MPI_Init_thread(int* argc, char*** argv, int required, int* provided) {
  const int code = PMPI_Init_thread(argc, argv, required, provided);
  unsetenv("LD_PRELOAD");
  return code;
}

// Collectives: the bytes that the rank holds before or after, whichever are more.
COUNTED_MPI(Allreduce, (const void* a, void* b, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c), (a, b, n, t, o, c), bytesOf(n, t))
COUNTED_MPI(Reduce, (const void* a, void* b, int n, MPI_Datatype t, MPI_Op o, int r, MPI_Comm c), (a, b, n, t, o, r, c), bytesOf(n, t))
COUNTED_MPI(Bcast, (void* b, int n, MPI_Datatype t, int r, MPI_Comm c), (b, n, t, r, c), bytesOf(n, t))
COUNTED_MPI(Allgather, (const void* a, int n, MPI_Datatype t, void* b, int m, MPI_Datatype u, MPI_Comm c), (a, n, t, b, m, u, c),
            bytesOf(double(m) * sizeOf(c), u))
COUNTED_MPI(Allgatherv, (const void* a, int n, MPI_Datatype t, void* b, const int* m, const int* d, MPI_Datatype u, MPI_Comm c),
            (a, n, t, b, m, d, u, c), bytesOf(sum(m, c), u))
COUNTED_MPI(Gather, (const void* a, int n, MPI_Datatype t, void* b, int m, MPI_Datatype u, int r, MPI_Comm c), (a, n, t, b, m, u, r, c),
            rankIn(c) == r ? bytesOf(double(m) * sizeOf(c), u) : bytesOf(n, t))
COUNTED_MPI(Gatherv, (const void* a, int n, MPI_Datatype t, void* b, const int* m, const int* d, MPI_Datatype u, int r, MPI_Comm c),
            (a, n, t, b, m, d, u, r, c), rankIn(c) == r ? bytesOf(sum(m, c), u) : bytesOf(n, t))
COUNTED_MPI(Scatter, (const void* a, int n, MPI_Datatype t, void* b, int m, MPI_Datatype u, int r, MPI_Comm c), (a, n, t, b, m, u, r, c),
            rankIn(c) == r ? bytesOf(double(n) * sizeOf(c), t) : bytesOf(m, u))
COUNTED_MPI(Scatterv, (const void* a, const int* n, const int* d, MPI_Datatype t, void* b, int m, MPI_Datatype u, int r, MPI_Comm c),
            (a, n, d, t, b, m, u, r, c), rankIn(c) == r ? bytesOf(sum(n, c), t) : bytesOf(m, u))
COUNTED_MPI(Alltoall, (const void* a, int n, MPI_Datatype t, void* b, int m, MPI_Datatype u, MPI_Comm c), (a, n, t, b, m, u, c),
            bytesOf(double(m) * sizeOf(c), u))
COUNTED_MPI(Alltoallv,
            (const void* a, const int* n, const int* d, MPI_Datatype t, void* b, const int* m, const int* e, MPI_Datatype u, MPI_Comm c),
            (a, n, d, t, b, m, e, u, c), std::max(bytesOf(sum(n, c), t), bytesOf(sum(m, c), u)))
COUNTED_MPI(Reduce_scatter, (const void* a, void* b, const int* n, MPI_Datatype t, MPI_Op o, MPI_Comm c), (a, b, n, t, o, c),
            bytesOf(sum(n, c), t))
COUNTED_MPI(Reduce_scatter_block, (const void* a, void* b, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c), (a, b, n, t, o, c),
            bytesOf(double(n) * sizeOf(c), t))
COUNTED_MPI(Scan, (const void* a, void* b, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c), (a, b, n, t, o, c), bytesOf(n, t))
COUNTED_MPI(Exscan, (const void* a, void* b, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c), (a, b, n, t, o, c), bytesOf(n, t))
COUNTED_MPI(Iallreduce, (const void* a, void* b, int n, MPI_Datatype t, MPI_Op o, MPI_Comm c, MPI_Request* q), (a, b, n, t, o, c, q),
            bytesOf(n, t))

// Messages.
COUNTED_MPI(Send, (const void* a, int n, MPI_Datatype t, int to, int g, MPI_Comm c), (a, n, t, to, g, c), bytesOf(n, t), inWorld(to, c))
COUNTED_MPI(Ssend, (const void* a, int n, MPI_Datatype t, int to, int g, MPI_Comm c), (a, n, t, to, g, c), bytesOf(n, t), inWorld(to, c))
COUNTED_MPI(Rsend, (const void* a, int n, MPI_Datatype t, int to, int g, MPI_Comm c), (a, n, t, to, g, c), bytesOf(n, t), inWorld(to, c))
COUNTED_MPI(Isend, (const void* a, int n, MPI_Datatype t, int to, int g, MPI_Comm c, MPI_Request* q), (a, n, t, to, g, c, q), bytesOf(n, t),
            inWorld(to, c))
COUNTED_MPI(Issend, (const void* a, int n, MPI_Datatype t, int to, int g, MPI_Comm c, MPI_Request* q), (a, n, t, to, g, c, q),
            bytesOf(n, t), inWorld(to, c))
COUNTED_MPI(Irsend, (const void* a, int n, MPI_Datatype t, int to, int g, MPI_Comm c, MPI_Request* q), (a, n, t, to, g, c, q),
            bytesOf(n, t), inWorld(to, c))

int MPI_Finalize() {
  int rank = 0;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (const char* path = std::getenv("SUTURE_TEST_COUNT")) write(std::string(path) + "." + std::to_string(rank) + ".json");
  depth = 1;  // nothing is counted any more
  return PMPI_Finalize();
}

}  // extern "C"
