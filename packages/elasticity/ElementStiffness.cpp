#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/ElementMap.hpp>
#include <suture/elasticity/EnhancedModes.hpp>
#include <suture/elasticity/GradientProducts.hpp>
#include <suture/elasticity/HookesLaw.hpp>
#include <suture/elasticity/MixedPressure.hpp>
#include <suture/elasticity/NodeCounts.hpp>

#include <optional>

namespace suture {
namespace {

using TakeStiffness = std::function<void(int element, ConstLocalView stiffness)>;

template <typename ElementMatrix>
void mirror(ElementMatrix& k) {
  const Eigen::Index n = k.rows();
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = j + 1; i < n; ++i) k(i, j) = k(j, i);
}

/// Stiffness matrices of plane and axisymmetric elements.
class PlaneStiffness {
 public:
  using Law = HookesLaw<2>;

  void setLaw(const Law& law) {
    law_ = law.of(Cell::Triangle3);
    enhanced_ = law.of(Cell::Quadrilateral4);
  }

  void operator()(const CellBlock& block, int element, const TakeStiffness& take) {
    const ReferenceElement& reference = stiffnessElement(block, element);
    k_.setZero(2 * reference.nodes, 2 * reference.nodes);
    ElementMap<2> map(block, element, reference);
    const bool isEnhanced = enhanced_.enhanced && mayBeEnhanced(block.cells[element]);
    std::optional<EnhancedModes<2>> modes;
    if (isEnhanced) modes.emplace(block, element, reference, map);
    const auto visit = [&] {
      if (modes) modes->add(map);
    };
    const StressMatrix<2>& law = isEnhanced ? enhanced_.pointwise : law_.pointwise;
    if (block.axisymmetric)
      addPointwise<true>(law, reference, map, visit);
    else
      addPointwise<false>(law, reference, map, visit);
    if (modes) {
      modes->close(law);
      modes->condense(k_);
    } else if (law_.projected != 0.0)
      MixedPressure<2>(block.cells[element], reference, map).addStiffness(law_.projected, k_);
    mirror(k_);
    take(element, k_);
  }

 private:
  static constexpr int most = 2 * mostNodes<2>;

  // K += sum over points of B^T D B; only the blocks a <= b are computed: exactly symmetric. B of node a (xx, yy, zz, xy) is [gx 0; 0 gy; h
  // 0; gy gx], h the hoop strain N / r, in axisymmetric blocks only.
  // visit() is called at every point.
  template <bool hoop, typename Visit>
  void addPointwise(const StressMatrix<2>& law, const ReferenceElement& reference, ElementMap<2>& map, const Visit& visit) {
    for (int q = 0; q < reference.points; ++q) {
      map.at(q);
      visit();
      const Eigen::Matrix4d scaled = map.measure() * law;
      for (int b = 0; b < reference.nodes; ++b) {
        const double gx = map.gradient(b)[0], gy = map.gradient(b)[1];
        Eigen::Vector4d stressX = scaled.col(0) * gx + scaled.col(3) * gy;
        const Eigen::Vector4d stressY = scaled.col(1) * gy + scaled.col(3) * gx;
        if constexpr (hoop) stressX += scaled.col(2) * map.hoop(b);
        for (int a = 0; a <= b; ++a) {
          const double hx = map.gradient(a)[0], hy = map.gradient(a)[1];
          k_(2 * a, 2 * b) += hx * stressX[0] + hy * stressX[3];
          k_(2 * a, 2 * b + 1) += hx * stressY[0] + hy * stressY[3];
          k_(2 * a + 1, 2 * b) += hy * stressX[1] + hx * stressX[3];
          k_(2 * a + 1, 2 * b + 1) += hy * stressY[1] + hx * stressY[3];
          if constexpr (hoop) {
            k_(2 * a, 2 * b) += map.hoop(a) * stressX[2];
            k_(2 * a, 2 * b + 1) += map.hoop(a) * stressY[2];
          }
        }
      }
    }
  }

  Law law_, enhanced_;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most, most> k_;
};

/// Stiffness matrices of 3D elements, from the products of gradients.
class SolidStiffness {
 public:
  using Law = HookesLaw<3>;

  void setLaw(const Law& law) {
    law_ = law.of(Cell::Tetrahedron4);
    weights_ = ProductWeights(law_.pointwise);
    enhanced_ = law.of(Cell::Hexahedron8);
    enhancedWeights_ = ProductWeights(enhanced_.pointwise);
  }

  void operator()(const CellBlock& block, int element, const TakeStiffness& take) {
    const ReferenceElement& reference = stiffnessElement(block, element);
    k_.resize(3 * reference.nodes, 3 * reference.nodes);
    ElementMap<3> map(block, element, reference);
    if (enhanced_.enhanced && mayBeEnhanced(block.cells[element])) {
      EnhancedModes<3> modes(block, element, reference, map);
      addPointwise<EnhancedModes<3>::nodes>(enhancedWeights_, reference, map, [&] { modes.add(map); });
      modes.close(enhanced_.pointwise);
      Eigen::Map<Eigen::Matrix<double, 24, 24>> k(k_.data());
      modes.condense(k);
      mirror(k);
      take(element, k_);
      return;
    }
    forNodes<3>(reference.nodes, [&](auto nodes) { addPointwise<nodes()>(weights_, reference, map, [] {}); });
    if (law_.projected != 0.0) {
      MixedPressure<3>(block.cells[element], reference, map).addStiffness(law_.projected, k_);
      mirror(k_);
    }
    take(element, k_);
  }

 private:
  template <int nodes, typename Visit>
  void addPointwise(const ProductWeights& weights, const ReferenceElement& reference, ElementMap<3>& map, const Visit& visit) {
    using Products = GradientProducts<nodes>;
    products_.resize(Products::rows * Products::n);
    Products products(products_.data());
    for (int q = 0; q < reference.points; ++q) {
      map.at(q);
      visit();
      products.add(map.measure(), map.gradient(0));
    }
    products.contract(weights, k_.data());
  }

  Law law_, enhanced_;
  ProductWeights weights_, enhancedWeights_;
  std::vector<double> products_;
  Matrix k_;
};

template <typename Stiffness>
void forEachElement(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                    const TakeStiffness& take) {
  const Material* last = nullptr;
  Stiffness stiffness;
  for (int e = 0; e < block.elements(); ++e) {
    const Material& material = materialOf(e);
    if (&material != last) stiffness.setLaw({material, plane});
    last = &material;
    stiffness(block, e, take);
  }
}

}  // namespace

void elementStiffnesses(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                        const TakeStiffness& take) {
  if (block.axisymmetric && plane == PlaneModel::Stress) throw InternalError("plane stress in an axisymmetric block");
  if (block.dimension == 2)
    forEachElement<PlaneStiffness>(block, materialOf, plane, take);
  else
    forEachElement<SolidStiffness>(block, materialOf, plane, take);
  coatingStiffnesses(block, take);
}

void elementStiffnesses(const CellBlock& block, const Material& material, PlaneModel plane, const TakeStiffness& take) {
  elementStiffnesses(
      block, [&material](int) -> const Material& { return material; }, plane, take);
}

}  // namespace suture
