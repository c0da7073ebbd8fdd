#include <cstdint>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElasticModel.hpp>

namespace suture {

namespace {

// The finaliser of splitmix64 (Steele, Lea, Flood 2014): every bit of the result depends on every bit of the number.
std::uint64_t scrambled(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

}  // namespace

double randomForce(const Load& load, GlobalId node, int component) {
  const std::uint64_t seed = scrambled(static_cast<std::uint64_t>(load.seed));
  const std::uint64_t bits = scrambled(scrambled(seed ^ static_cast<std::uint64_t>(node)) + static_cast<std::uint64_t>(component));
  const double unit = static_cast<double>(bits >> 11) * 0x1p-53;  // [0, 1), all 53 bits of a double
  return load.factor * (load.value[1] + load.value[0] * (2.0 * unit - 1.0));
}

double nodeForce(const Load& load, GlobalId node, int component) {
  if (load.kind == Load::Kind::Random) return randomForce(load, node, component);
  if (load.node < 0) throw InternalError("a Point Force without a node (call resolveLoads() first)");
  return node == load.node ? load.factor * load.value[component] : 0.0;
}

}  // namespace suture
