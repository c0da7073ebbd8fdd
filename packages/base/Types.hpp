#pragma once
#include <Eigen/Core>
#include <Teuchos_RCPDecl.hpp>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

// Forward declarations of the two Teuchos classes that appear in most signatures; include <Teuchos_Comm.hpp> or
// <Teuchos_ParameterList.hpp> in the source that uses them.
namespace Teuchos {
template <typename Ordinal>
class Comm;
class ParameterList;
}  // namespace Teuchos

namespace suture {

using Comm = Teuchos::Comm<int>;
using CommPtr = Teuchos::RCP<const Comm>;
using Parameters = Teuchos::ParameterList;  ///< validated and with all defaults filled in; see base/scene/SceneReader.hpp
using GlobalId = long long;

constexpr double unitRoundoff = 0.5 * std::numeric_limits<double>::epsilon();

/// Small dense algebra uses Eigen. The columns of a Matrix are right-hand sides.
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
using LocalView = Eigen::Ref<Matrix>;
using ConstLocalView = Eigen::Ref<const Matrix>;

/// A point or direction; the third component is zero in 2D.
using Point = std::array<double, 3>;

/// A view of contiguous objects owned elsewhere (the needed part of C++20's std::span).
template <typename T>
class Span {
 public:
  Span() = default;
  Span(T* data, std::size_t size) : data_(data), size_(size) {}
  template <typename U>
  Span(const std::vector<U>& v) : data_(v.data()), size_(v.size()) {}
  template <typename U>
  Span(std::vector<U>& v) : data_(v.data()), size_(v.size()) {}
  T* begin() const { return data_; }
  T* end() const { return data_ + size_; }
  T& operator[](std::size_t i) const { return data_[i]; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace suture
