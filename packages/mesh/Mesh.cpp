#include <suture/mesh/Mesh.hpp>

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

// As FNV-1a (Fowler, Noll, Vo), by words of 64 bits instead of bytes: not for secrets, but any single change shows. A product carries
// upwards only: the shift brings high bits back down.
class Hash {
 public:
  void number(std::int64_t value) { word(static_cast<std::uint64_t>(value)); }
  void number(double value) {
    if (value == 0) value = 0;  // -0.0 is the same place
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    word(bits);
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
  void word(std::uint64_t word) {
    state_ = (state_ ^ word) * 1099511628211ull;
    state_ ^= state_ >> 32;
  }

  std::uint64_t state_ = 14695981039346656037ull;
};

}  // namespace

std::vector<std::string> Mesh::elementGroupNames() const { return keys(elementGroups); }
std::vector<std::string> Mesh::sideGroupNames() const { return keys(sideGroups); }

std::string Mesh::hash() const {
  Hash hash;
  hash.number(std::int64_t(dimension));
  hash.number(std::int64_t(coordinates.size()));
  for (const double x : coordinates) hash.number(x);
  hash.number(std::int64_t(elements()));
  for (int e = 0; e < elements(); ++e) {
    hash.number(std::int64_t(cells[e]));
    for (const int node : nodesOf(e)) hash.number(std::int64_t(node));
  }
  for (const auto& [name, members] : elementGroups) {
    hash.text(name);
    hash.number(std::int64_t(members.size()));
    for (const int e : members) hash.number(std::int64_t(e));
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
