#pragma once
#include <cmath>
#include <random>
#include <suture/search/RigidBodyModel.hpp>

namespace suture {

/// A random contact problem in its dual form. Some rows are duplicates, some compliances are singular, some gaps and loads are zero.
struct RandomContact {
  Matrix compliance;
  Vector open;
  RigidBodyModel::Pairs pairs;

  explicit RandomContact(unsigned seed);
};

}  // namespace suture
