// Energies of stress functions on a triangle, against those of StressElement for the tractions of the same functions.
#include <Eigen/Dense>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <random>
#include <suture/answer/bound/AiryElement.hpp>
#include <suture/answer/bound/StressElement.hpp>

namespace suture {
namespace airy {

class Random {
 public:
  template <class Matrix>
  Matrix matrix(int rows, int columns) {
    return Matrix::NullaryExpr(rows, columns, [this] { return uniform_(engine_); });
  }

 private:
  std::mt19937 engine_{7};
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

template <int K>
typename AiryElement<K>::Sides sidesOf(const Eigen::Matrix<double, 2, 3>& places) {
  typename AiryElement<K>::Sides sides;
  for (int a = 0; a < 3; ++a) {
    const Eigen::Vector2d from = places.col(a == 0 ? 1 : 0), along = places.col(a == 2 ? 1 : 2) - from;
    sides[a].length = along.norm();
    sides[a].normal = Eigen::Vector2d(along[1], -along[0]) / along.norm();
    sides[a].sign = sides[a].normal.dot(from - places.col(a)) > 0 ? 1.0 : -1.0;
  }
  return sides;
}

/// \param squeeze  factor for one axis: a flat triangle
template <int K>
void compare(Random& random, double squeeze, double tolerance, Teuchos::FancyOStream& out, bool& success) {
  using Element = AiryElement<K>;
  const StressElement<2>& stress = StressElement<2>::of(K);
  BoundElement<2> element;
  element.places << 0.1, 1.2, 0.3, 0.2, 0.1, 1.1;
  element.places += 0.2 * random.matrix<Eigen::Matrix<double, 2, 3>>(2, 3);
  if (random.matrix<Eigen::Matrix<double, 1, 1>>(1, 1)(0) > 0) element.places.col(0).swap(element.places.col(1));
  element.places.row(1) *= squeeze;
  const auto root = random.matrix<Eigen::Matrix3d>(3, 3);
  element.compliance = 0.5 * root * root.transpose() + Eigen::Matrix3d::Identity();
  element.stresses = random.matrix<Eigen::Matrix3d>(3, 3);
  const auto sides = sidesOf<K>(element.places);
  typename Element::Frames frames;
  for (Eigen::Matrix2d& frame : frames) frame = Eigen::Rotation2Dd(random.matrix<Eigen::Matrix<double, 1, 1>>(1, 1)(0)).toRotationMatrix();
  // An admissible stress: linear, with the sources -div s.
  const Eigen::Matrix3d given = random.matrix<Eigen::Matrix3d>(3, 3);  // constant, derivatives along x and y
  const auto at = [&](const Eigen::Vector2d& p) {
    const Eigen::Vector3d s = given * Eigen::Vector3d(1, p[0], p[1] / squeeze);
    return (Eigen::Matrix2d() << s[0], s[2], s[2], s[1]).finished();
  };
  element.sources.setZero();
  for (int j = 0; j < (K == 1 ? 1 : 3); ++j)
    element.sources.col(j) << -given(0, 1) - given(2, 2) / squeeze, -given(2, 1) - given(1, 2) / squeeze;
  const typename Element::Local x = random.matrix<typename Element::Local>(Element::dofs, 1);
  Eigen::Matrix<double, Element::sideData, 3> tractions, changed;
  for (int a = 0; a < 3; ++a) {
    const int first = a == 0 ? 1 : 0, second = a == 2 ? 1 : 2;
    for (int j = 0; j <= K; ++j) {
      const double r = j == 2 ? 0.5 : j;
      tractions.col(a).template segment<2>(2 * j) =
          at((1 - r) * element.places.col(first) + r * element.places.col(second)) * sides[a].normal;
    }
    Eigen::Matrix<double, 6 + Element::onSide, 1> own;
    own << x.template segment<3>(3 * first), x.template segment<3>(3 * second),
        x.template segment<Element::onSide>(9 + Element::onSide * a);
    changed.col(a) = tractions.col(a) + Element::tractionsOf(sides[a], frames[first], frames[second]) * own;
  }
  Vector data(stress.data()), computed(stress.data());
  const auto energyOf = [&](const Eigen::Matrix<double, Element::sideData, 3>& all) {
    for (int a = 0; a < 3; ++a) data.template segment<Element::sideData>(Element::sideData * a) = sides[a].sign * all.col(a);
    for (int j = 0; j < stress.sourceNodes(); ++j) data.template segment<2>(3 * Element::sideData + 2 * j) = element.sources.col(j);
    stress.dataOf(element.places, element.stresses, computed);
    Eigen::Matrix2d map;
    map << element.places.col(1) - element.places.col(0), element.places.col(2) - element.places.col(0);
    return stress.energy(map, element.compliance, data - computed);
  };
  const typename Element::Energy energy = Element::reference().energy(element, sides, frames, tractions);
  TEST_FLOATING_EQUALITY(energy.start, energyOf(tractions), tolerance);
  TEST_FLOATING_EQUALITY(energy.start + 2 * x.dot(energy.loads) + x.dot(energy.matrix * x), energyOf(changed), tolerance);
  TEST_COMPARE((energy.matrix - energy.matrix.transpose()).norm(), <=, 1e-10 * energy.matrix.norm());
}

TEUCHOS_UNIT_TEST(AiryElement, HasTheEnergyOfItsTractions) {
  Random random;
  for (int i = 0; i < 20; ++i) {
    compare<1>(random, 1.0, 1e-11, out, success);
    compare<2>(random, 1.0, 1e-10, out, success);
  }
}

TEUCHOS_UNIT_TEST(AiryElement, HasTheEnergyOfItsTractionsOnFlatTriangles) {
  Random random;
  for (int i = 0; i < 10; ++i) {
    compare<1>(random, 0.02, 1e-7, out, success);
    compare<2>(random, 0.02, 1e-7, out, success);
  }
}

}  // namespace airy
}  // namespace suture
