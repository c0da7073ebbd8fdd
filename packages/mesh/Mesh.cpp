#include <suture/base/Errors.hpp>
#include <suture/mesh/Mesh.hpp>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>

namespace suture {

namespace {

template <typename Map>
std::vector<std::string> keys(const Map& map) {
  std::vector<std::string> names;
  for (const auto& entry : map) names.push_back(entry.first);
  return names;
}

// Similar to FNV-1a (Fowler, Noll, Vo), with words of 64 bits instead of bytes: not cryptographic, but any single change is detected. A
// product carries upwards only: the shift brings high bits back down.
class Hash {
 public:
  void number(std::int64_t value) { state_ = mixed(state_, wordOf(value)); }
  /// Hashes all values and their number. Four independent chains, since each step waits for the product of the one before in its chain.
  template <typename Number>
  void numbers(const std::vector<Number>& values) {
    constexpr std::size_t ways = 4;
    std::array<std::uint64_t, ways> states{1, 2, 3, 4};
    const std::size_t whole = values.size() / ways * ways;
    for (std::size_t i = 0; i < whole; i += ways)
      for (std::size_t k = 0; k < ways; ++k) states[k] = mixed(states[k], wordOf(values[i + k]));
    for (std::size_t i = whole; i < values.size(); ++i) states[i - whole] = mixed(states[i - whole], wordOf(values[i]));
    number(std::int64_t(values.size()));
    for (const std::uint64_t state : states) state_ = mixed(state_, state);
  }
  void text(const std::string& text) {
    number(std::int64_t(text.size()));
    for (const char letter : text) number(std::int64_t(letter));
  }
  std::string hexadecimal() const {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(state_));
    return text;
  }

 private:
  static std::uint64_t wordOf(std::int64_t value) { return static_cast<std::uint64_t>(value); }
  static std::uint64_t wordOf(int value) { return wordOf(std::int64_t(value)); }
  static std::uint64_t wordOf(Cell cell) { return wordOf(static_cast<int>(cell)); }
  static std::uint64_t wordOf(double value) {
    if (value == 0) value = 0;  // -0.0 is the same coordinate as 0.0
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
  }
  static std::uint64_t mixed(std::uint64_t state, std::uint64_t word) {
    state = (state ^ word) * 1099511628211ull;
    return state ^ state >> 32;
  }

  std::uint64_t state_ = 14695981039346656037ull;
};

}  // namespace

std::vector<std::string> Mesh::elementGroupNames() const { return keys(elementGroups); }
std::vector<std::string> Mesh::sideGroupNames() const { return keys(sideGroups); }

std::string sideGroupProblem(const Mesh& mesh, const std::string& group) {
  const auto found = mesh.sideGroups.find(group);
  if (found == mesh.sideGroups.end())
    return "in the mesh " + mesh.source + ": " + unknownName(mesh.sideGroupKind(), group, mesh.sideGroupNames());
  if (found->second.empty()) return "the " + mesh.sideGroupKind() + " '" + group + "' of the mesh " + mesh.source + " is empty";
  return "";
}

std::string Mesh::hash() const {
  Hash hash;
  hash.number(std::int64_t(dimension));
  hash.numbers(coordinates);
  hash.numbers(cells);  // determine the number of nodes of each element
  hash.numbers(connectivity);
  for (const auto& [name, members] : elementGroups) {
    hash.text(name);
    hash.numbers(members);
  }
  for (const auto& [name, sides] : sideGroups) {
    hash.text(name);
    hash.number(std::int64_t(sides.size()));
    for (const Side& side : sides) {
      hash.number(std::int64_t(side.element));
      hash.number(std::int64_t(side.side));
    }
  }
  return hash.hexadecimal();
}

}  // namespace suture
