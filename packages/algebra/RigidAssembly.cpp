#include <suture/algebra/RigidAssembly.hpp>
#include <suture/algebra/dense/Decompositions.hpp>

#include <unordered_map>

namespace suture {

Matrix commonRigidMotions(const std::vector<RigidMember>& parts) {
  std::vector<Eigen::Index> first{0};
  for (const RigidMember& part : parts) first.push_back(first.back() + part.modes.cols());
  const Eigen::Index columns = first.back();

  struct Holder {
    std::size_t part;
    Eigen::Index row;
  };
  std::unordered_map<GlobalId, Holder> holders;
  std::vector<Vector> rows;
  const auto newRow = [&](std::size_t part, const auto& values) -> Vector& {
    rows.emplace_back(Vector::Zero(columns));
    rows.back().segment(first[part], parts[part].modes.cols()) = values.transpose();
    return rows.back();
  };
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (Eigen::Index i = 0; i < parts[p].held.rows(); ++i) newRow(p, parts[p].held.row(i));
    for (std::size_t i = 0; i < parts[p].dofs.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const auto [found, isNew] = holders.emplace(parts[p].dofs[i], Holder{p, row});
      if (isNew) continue;
      const Holder& other = found->second;
      newRow(p, parts[p].modes.row(row)).segment(first[other.part], parts[other.part].modes.cols()) -=
          parts[other.part].modes.row(other.row).transpose();
    }
  }
  Matrix constraints(static_cast<Eigen::Index>(rows.size()), columns);
  for (std::size_t i = 0; i < rows.size(); ++i) constraints.row(static_cast<Eigen::Index>(i)) = rows[i];
  return nullSpace(constraints);
}

}  // namespace suture
