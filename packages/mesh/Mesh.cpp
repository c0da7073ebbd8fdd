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

// FNV-1a, 64 bits (Fowler, Noll, Vo): not for secrets, but any single change shows.
class Fnv1a {
 public:
  void bytes(const void* data, std::size_t count) {
    const unsigned char* byte = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < count; ++i) state_ = (state_ ^ byte[i]) * 1099511628211ull;
  }
  void number(std::int64_t value) { bytes(&value, sizeof value); }
  void number(double value) {
    if (value == 0) value = 0;  // -0.0 is the same place
    bytes(&value, sizeof value);
  }
  void text(const std::string& text) {
    number(std::int64_t(text.size()));
    bytes(text.data(), text.size());
  }
  std::string hexadecimal() const {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(state_));
    return text;
  }

 private:
  std::uint64_t state_ = 14695981039346656037ull;
};

}  // namespace

std::vector<std::string> Mesh::elementGroupNames() const { return keys(elementGroups); }
std::vector<std::string> Mesh::sideGroupNames() const { return keys(sideGroups); }

std::string Mesh::hash() const {
  Fnv1a hash;
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
