#include <suture/base/Point.hpp>
#include <suture/reader/cad/CadNames.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

namespace suture {

namespace {

constexpr double kSamePlace = 1e-5;  // largest distance of coordinates that count as equal, over the extent
constexpr double kSameAngle = 1e-4;  // [rad]

using Key = std::array<double, 4>;  // x, y, z [length], area

/// Sorts indices by their keys, one after the other; values of a key that differ by less than its tolerance are equal.
void sortByPlace(const std::vector<Key>& keys, const Key& tolerance, std::size_t key, std::vector<int>::iterator begin,
                 std::vector<int>::iterator end) {
  if (key == tolerance.size() || end - begin < 2) return;
  const auto value = [&](int i) { return keys[static_cast<std::size_t>(i)][key]; };
  std::stable_sort(begin, end, [&](int a, int b) { return value(a) < value(b); });
  for (auto from = begin; from != end;) {
    auto to = std::next(from);
    while (to != end && value(*to) - value(*std::prev(to)) <= tolerance[key]) ++to;
    sortByPlace(keys, tolerance, key + 1, from, to);
    from = to;
  }
}

std::vector<int> byPlace(const std::vector<Key>& keys) {
  std::vector<int> order(keys.size());
  Key low{}, high{}, tolerance{};
  for (std::size_t i = 0; i < keys.size(); ++i) {
    order[i] = static_cast<int>(i);
    for (std::size_t k = 0; k < 4; ++k) {
      low[k] = i == 0 ? keys[i][k] : std::min(low[k], keys[i][k]);
      high[k] = i == 0 ? keys[i][k] : std::max(high[k], keys[i][k]);
    }
  }
  const double extent = norm({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  for (std::size_t k = 0; k < 3; ++k) tolerance[k] = kSamePlace * extent;
  tolerance[3] = kSamePlace * high[3];
  sortByPlace(keys, tolerance, 0, order.begin(), order.end());
  return order;
}

/// Appends numbers to names that occur more than once, or to all of `always`.
std::vector<std::string> numbered(const std::vector<std::string>& names, const std::vector<Key>& keys, const std::vector<char>& always) {
  std::map<std::string, int> count, next;
  for (const std::string& name : names) ++count[name];
  std::vector<std::string> result = names;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (count[names[i]] == 1 && !always[i]) taken.insert(names[i]);
  for (const int i : byPlace(keys)) {
    const auto at = static_cast<std::size_t>(i);
    if (count[names[at]] == 1 && !always[at]) continue;
    do result[at] = names[at] + "_" + std::to_string(++next[names[at]]);
    while (!taken.insert(result[at]).second);
  }
  return result;
}

/// A name of letters, digits and underscores; letters beyond ASCII are kept.
std::string legalName(const std::string& label) {
  std::string last = label.substr(label.rfind('/') + 1), name;
  // OpenCASCADE's own words for a part without a name.
  if (last.rfind("Open CASCADE", 0) == 0 || last == "Shapes" || last == "SOLID" || last == "COMPOUND") return "";
  for (const char c : last) {
    const bool keep = std::isalnum(static_cast<unsigned char>(c)) || static_cast<unsigned char>(c) >= 0x80;
    if (keep)
      name += c;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  while (!name.empty() && name.back() == '_') name.pop_back();
  return name;
}

/// "top", ... if a plane lies at an end of its body; otherwise "".
std::string endOf(const CadFace& face, const CadBody& body) {
  static const char* const words[3][2] = {{"left", "right"}, {"front", "back"}, {"bottom", "top"}};
  if (face.shape.kind != SurfaceShape::Kind::Plane) return "";
  const double near = kSamePlace * norm(minus(body.high, body.low));
  for (std::size_t k = 0; k < 3; ++k)
    for (const int upper : {0, 1}) {
      Point outward{0, 0, 0};
      outward[k] = upper ? 1.0 : -1.0;
      const double end = upper ? body.high[k] : body.low[k];
      if (norm(minus(face.shape.axis, outward)) <= kSameAngle && std::abs(face.centre[k] - end) <= near) return words[k][upper];
    }
  return "";
}

}  // namespace

std::vector<std::string> cadBodyNames(const std::vector<CadBody>& bodies) {
  std::vector<std::string> names;
  std::vector<Key> keys;
  std::vector<char> unnamed;
  for (const CadBody& body : bodies) {
    names.push_back(legalName(body.label));
    unnamed.push_back(names.back().empty());
    if (names.back().empty()) names.back() = "body";
    const Point middle = scaled(0.5, plus(body.low, body.high)), size = minus(body.high, body.low);
    keys.push_back({middle[0], middle[1], middle[2], dot(size, size)});
  }
  return numbered(names, keys, unnamed);
}

std::vector<std::string> cadFaceNames(const std::vector<CadFace>& faces, const std::vector<CadBody>& bodies,
                                      const std::vector<std::string>& bodyNames) {
  std::vector<std::string> names;
  std::vector<Key> keys;
  std::vector<char> always;
  for (const CadFace& face : faces) {
    const auto body = static_cast<std::size_t>(face.body);
    const std::string end = endOf(face, bodies[body]);
    names.push_back(bodyNames[body] + "_" + (end.empty() ? kindName(face.shape.kind) : end));
    always.push_back(end.empty());
    keys.push_back({face.centre[0], face.centre[1], face.centre[2], face.area});
  }
  return numbered(names, keys, always);
}

}  // namespace suture
