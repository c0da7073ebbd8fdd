#pragma once
#include <pairs/PairsTesting.hpp>
#include <support/CheckSays.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/BuildConstraints.hpp>

#include <Teuchos_ParameterList.hpp>

#include <cmath>
#include <string>

namespace constraintstesting {

using namespace pairstesting;

/// A list of parameters `name`: entries as "name=value" with the type inferred from the value.
std::string entry(const std::string& name, const std::vector<std::pair<std::string, std::string>>& parameters);
std::string displacement(const std::string& name, const std::string& group, const std::string& value,
                         const std::string& components = "All");
std::string bilateral(const std::string& name, const std::string& group);
std::string contact(const std::string& name, const std::string& a, const std::string& b);

/// The same, node to node or not at all.
std::string matching(const std::string& name, const std::string& a, const std::string& b);

Constraints build(const Mesh& mesh, const std::string& conditions, const std::string& contacts = "", const ContactScales& scales = {});

/// Problems of the scene, one per line, or "no error".
std::string said(const Mesh& mesh, const std::string& conditions, const std::string& contacts = "");

/// Blocks [0,4] x [k, k+1], k = 0, 1, ..., of nx x 2 cells, named b0, b1, ...
Mesh stack(int count, int nx = 8, Cell cell = Cell::Triangle3);

/// The node of a body nearest to a point.
int nodeAt(const Mesh& mesh, int body, double x, double y);
const NodeRule* ruleAt(const Constraints& constraints, int node);

}  // namespace constraintstesting
