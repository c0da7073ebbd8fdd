#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <cmath>
#include <suture/elasticity/ElasticModel.hpp>

using namespace suture;

namespace {

Load randomLoad(int seed, double amplitude) {
  Load load;
  load.kind = Load::Kind::Random;
  load.value[0] = amplitude;
  load.seed = seed;
  return load;
}

}  // namespace

TEUCHOS_UNIT_TEST(RandomLoad, IsSplitmix64OnEveryMachine) {
  // Integers of any length and fractions, from three lines of Python; its generator gives the published e220a8397b1dcdaf for 0.
  TEST_EQUALITY(randomForce(randomLoad(0, 1.0), 0, 0), -0.7225811797088915);
  TEST_EQUALITY(randomForce(randomLoad(0, 1.0), 0, 1), -0.48346910616254135);
  TEST_EQUALITY(randomForce(randomLoad(7, 1.0), 123456, 1), 0.07461334114355833);
  TEST_EQUALITY(randomForce(randomLoad(-3, 1.0), 5, 0), 0.49571219507530273);
}

TEUCHOS_UNIT_TEST(RandomLoad, IsMovedByItsMean) {
  Load load = randomLoad(7, 1.0);
  load.value[1] = 0.5;
  TEST_EQUALITY(randomForce(load, 123456, 1), 0.5 + 0.07461334114355833);
}

TEUCHOS_UNIT_TEST(RandomLoad, IsUniformAndUncorrelated) {
  const int nodes = 20000;
  const double amplitude = 3.0;
  const Load one = randomLoad(1, amplitude), other = randomLoad(2, amplitude);
  double largest = 0, mean[2] = {0, 0}, square[2] = {0, 0}, components = 0, neighbours = 0, seeds = 0;
  for (int node = 0; node < nodes; ++node) {
    const double f[2] = {randomForce(one, node, 0), randomForce(one, node, 1)};
    for (int k = 0; k < 2; ++k) {
      largest = std::max(largest, std::abs(f[k]));
      mean[k] += f[k] / nodes;
      square[k] += f[k] * f[k] / nodes;
    }
    components += f[0] * f[1] / nodes;
    neighbours += f[0] * randomForce(one, node + 1, 0) / nodes;
    seeds += f[0] * randomForce(other, node, 0) / nodes;
  }
  TEST_COMPARE(largest, <=, amplitude);
  // Uniform in [-A, A]: variance A^2 / 3; products of independent ones scatter by A^2 / (3 sqrt(n)). Five times that never happens.
  const double scatter = amplitude * amplitude / 3 / std::sqrt(nodes);
  for (int k = 0; k < 2; ++k) {
    TEST_COMPARE(std::abs(mean[k]), <, 5 * amplitude / std::sqrt(3.0 * nodes));
    TEST_COMPARE(std::abs(square[k] - amplitude * amplitude / 3), <, 5 * scatter);
  }
  for (const double product : {components, neighbours, seeds}) TEST_COMPARE(std::abs(product), <, 5 * scatter);
}
