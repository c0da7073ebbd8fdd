#include "Place.hpp"

#include "Board.hpp"

#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <link.h>
#include <unwind.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <unordered_map>

namespace mpiorder {

namespace {

constexpr int kDeep = 64, kNamed = 6;

struct Frame {
  bool own = false;
  std::uint64_t hash = 0;
  std::string name;
};

std::uint64_t mixed(std::uint64_t a, std::uint64_t b) { return (a ^ b) * 0x9e3779b97f4a7c15u + (a >> 29); }

const void* thisLibrary() {
  static const void* base = [] {
    Dl_info info{};
    dladdr(reinterpret_cast<void*>(&placeOfCall), &info);
    return info.dli_fbase;
  }();
  return base;
}

std::uint64_t offsetIn(const Dl_info& info, const void* address) {
  return static_cast<std::uint64_t>(static_cast<const char*>(address) - static_cast<const char*>(info.dli_fbase));
}

std::string nameOf(const Dl_info& info, const ElfW(Sym) * symbol, const void* address) {
  const char* file = std::strrchr(info.dli_fname, '/');
  char offset[32];
  std::snprintf(offset, sizeof(offset), "+0x%lx", static_cast<unsigned long>(offsetIn(info, address)));
  const std::string place = (file ? file + 1 : info.dli_fname) + std::string(offset);
  // A function that is not exported has no name here: the name of the preceding exported one would be wrong.
  if (!info.dli_sname || !symbol || static_cast<const char*>(address) >= static_cast<const char*>(info.dli_saddr) + symbol->st_size)
    return place;
  int status = 0;
  char* plain = abi::__cxa_demangle(info.dli_sname, nullptr, nullptr, &status);
  std::string name = status == 0 ? plain : info.dli_sname;
  std::free(plain);
  if (name.size() > 120) name = name.substr(0, 117) + "...";
  return name + " " + place;
}

const Frame& frameOf(void* address) {
  static auto& known = *new std::unordered_map<void*, Frame>;
  const auto [found, isNew] = known.emplace(address, Frame());
  Frame& frame = found->second;
  Dl_info info{};
  ElfW(Sym)* symbol = nullptr;
  if (!isNew || !dladdr1(address, &info, reinterpret_cast<void**>(&symbol), RTLD_DL_SYMENT) || !info.dli_fname) return frame;
  const auto begins = [&](const char* with) { return std::strncmp(info.dli_fname, with, std::strlen(with)) == 0; };
  frame.own = !begins("/usr/") && !begins("/lib") && info.dli_fbase != thisLibrary();
  if (!frame.own) return frame;
  // Functions, not lines: the compiler may turn one call into several.
  const void* function = _Unwind_FindEnclosingFunction(address);
  frame.hash = mixed(std::strlen(info.dli_fname), offsetIn(info, function ? function : address));
  frame.name = nameOf(info, symbol, address);
  return frame;
}

}  // namespace

Place placeOfCall() {
  void* stack[kDeep];
  const int depth = backtrace(stack, kDeep);
  Place place;
  for (int k = 0; k < depth; ++k)
    if (const Frame& frame = frameOf(stack[k]); frame.own) place.hash = mixed(place.hash, frame.hash);
  static auto& texts = *new std::unordered_map<std::uint64_t, std::uint32_t>;
  const auto [text, isNew] = texts.emplace(place.hash, 0);
  if (isNew) {
    std::string names;
    int count = 0;
    for (int k = 0; k < depth && count < kNamed; ++k)
      if (const Frame& frame = frameOf(stack[k]); frame.own) names += (count++ == 0 ? "" : "\n      < ") + frame.name;
    text->second = board().keep(names);
  }
  place.text = text->second;
  return place;
}

}  // namespace mpiorder
