#pragma once
#include <suture/mesh/Generators.hpp>
#include <suture/mesh/Mesh.hpp>

#include <functional>

namespace pairstesting {

using namespace suture;

constexpr double pi = 3.14159265358979323846;

/// Moves every node of a body.
void move(Mesh& mesh, int body, const std::function<Point(Point)>& to);
void moveAll(Mesh& mesh, const std::function<Point(Point)>& to);

}  // namespace pairstesting
