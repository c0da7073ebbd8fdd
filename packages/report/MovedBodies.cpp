#include <suture/base/Errors.hpp>
#include <suture/report/MovedBodies.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Components of a row of MovedParts: frame, moment, shift, rotation, about.
constexpr std::size_t kPart = BodyFrame::kNumbers + 12;
// Components of a row of MovedPairs: contact, node, status, direction, bound, friction, slipped, work, force, tangential.
constexpr std::size_t kPair = 14;

struct Names {
  explicit Names(const std::string& group) : parts(group + "/MovedParts"), beside(group + "/MovedNodes"), pairs(group + "/MovedPairs") {}
  std::string parts, beside, pairs;
};

}  // namespace

void writeMovedBodies(Hdf5Writer& file, const Comm& comm, const std::string& group, const MovedBodies& bodies) {
  std::vector<double> parts, beside, pairs;
  if (comm.getRank() == 0) {
    for (const MovedBodies::Part& part : bodies.parts) {
      const auto frame = part.frame.numbers();
      parts.insert(parts.end(), frame.begin(), frame.end());
      for (const Point& one : {part.moment, part.lastMotion.shift, part.lastMotion.rotation, part.lastMotion.about})
        parts.insert(parts.end(), one.begin(), one.end());
    }
    beside = bodies.beside;
    for (const MovedBodies::Pair& pair : bodies.pairs) {
      const ContactState& state = pair.state;
      pairs.insert(pairs.end(), {double(pair.line), double(pair.node), double(state.status), state.direction[0], state.direction[1],
                                 state.direction[2], state.bound, state.friction, pair.slipped ? 1.0 : 0.0, pair.dissipated, pair.force,
                                 pair.tangential[0], pair.tangential[1], pair.tangential[2]});
    }
  }
  const Names names(group);
  file.write(names.parts, parts, static_cast<int>(kPart));
  file.write(names.beside, beside);
  file.write(names.pairs, pairs, static_cast<int>(kPair));
}

MovedBodies readMovedBodies(const Hdf5Reader& file, const std::string& group, const std::string& path) {
  MovedBodies bodies;
  const Names names(group);
  if (!file.has(names.parts)) return bodies;
  const std::vector<double> parts = file.readReals(names.parts), pairs = file.readReals(names.pairs);
  bodies.beside = file.readReals(names.beside);
  const auto isFinite = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  };
  if (parts.size() % kPart != 0 || pairs.size() % kPair != 0 || !isFinite(parts) || !isFinite(pairs) || !isFinite(bodies.beside))
    throw InputError(path, "damaged: incomplete places of bodies that move far");
  for (auto row = parts.begin(); row != parts.end(); row += kPart) {
    std::array<double, BodyFrame::kNumbers> frame;
    std::copy_n(row, BodyFrame::kNumbers, frame.begin());
    const auto pointAt = [&](std::size_t i) {
      const auto at = row + BodyFrame::kNumbers + 3 * i;
      return Point{at[0], at[1], at[2]};
    };
    bodies.parts.push_back({BodyFrame::ofNumbers(frame), pointAt(0), {pointAt(1), pointAt(2), pointAt(3)}});
  }
  for (auto row = pairs.begin(); row != pairs.end(); row += kPair) {
    if (row[2] < 0 || row[2] > static_cast<int>(PairStatus::Stick)) throw InputError(path, "damaged: a pair with an unknown status");
    bodies.pairs.push_back({int(row[0]),
                            int(row[1]),
                            {static_cast<PairStatus>(int(row[2])), {row[3], row[4], row[5]}, row[6], row[7]},
                            row[8] != 0.0,
                            row[9],
                            row[10],
                            {row[11], row[12], row[13]}});
  }
  return bodies;
}

}  // namespace suture
