#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Generators.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

/// Small scenes made by hand, so that tests of the solvers depend on no reader and no search for pairs.
namespace suture::scenes {

struct Scene {
  Mesh mesh;
  ElasticModel model;
  Constraints constraints;
  std::string sideA = "lower_top", sideB = "upper_bottom";
  double gap = 0.0;

  std::vector<int> nodesOf(const std::string& group) const;

  NodeRule& ruleOf(int node);

  void holdNode(int node, int component, double value);
  void hold(const std::string& group, int component, double value);
  void fixLower();
  void pressure(const std::string& group, double value) { model.loads.push_back(Load::pressure(group, value)); }
  void traction(const std::string& group, Point value) { model.loads.push_back(Load::traction(group, value)); }

  /// Sets another Young modulus, with the body's Poisson ratio, in an element group.
  void region(const std::string& group, double young);

  /// Pairs the nodes of the two sides by their position along the line, normal from A to B; sorted along the line.
  void pairUp(Point normal = {0, 1, 0});
};

Scene fromBoxes(const std::vector<Box>& all, double young = 2e6, double poisson = 0.0);

/// [-1,1] x [-1,0] below [-1,1] x [0,1], in contact along y = 0: nx cells along it.
Scene twoBlocks(int nx, int nyLower, int nyUpper, double young = 2e6, double poisson = 0.0);

/// As twoBlocks, but the lower block ends at x = 0: half of the upper one overhangs. The lower one is fixed.
Scene overhang();

}  // namespace suture::scenes
