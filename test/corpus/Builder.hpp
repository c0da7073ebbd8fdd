#pragma once
#include <corpus/GridBody.hpp>
#include <corpus/Random.hpp>

#include <string>
#include <vector>

namespace suture::corpus {

/// True if a scene has a solution, as far as its construction determines it.
enum class Expected { Solvable, Unsolvable, Unknown };

/// Collects bodies, conditions and contacts of a scene in lengths of its bodies and stresses of its softest one, then rotates, scales and
/// renumbers it and writes the scene file.
class Builder {
 public:
  Random& random;
  Mesh mesh;
  std::string family;
  Expected expected = Expected::Solvable;
  bool mayTurn = true;  ///< false if a condition or an obstacle is tied to the axes

  explicit Builder(Random& numbers);

  /// Adds a body with a random material, cell and named partition.
  void body(GridBody body);
  /// A box [x0, x1] x [bottom(x), top(x)], sides bottom, right, top, left.
  void box(const std::string& name, double x0, double x1, std::function<double(double)> bottom, std::function<double(double)> top, int nx,
           int ny);

  void condition(const std::string& group, const std::string& type, std::vector<double> value = {}, const std::string& components = "All");
  void fix(const std::string& group) { condition(group, "Displacement", {0, 0}); }
  void roller(const std::string& group) { condition(group, "Bilateral"); }
  /// Displacement of all components [body lengths].
  void move(const std::string& group, Point by) { condition(group, "Displacement", {by[0], by[1]}); }
  /// In units of the load() of the scene.
  void traction(const std::string& group, Point value) { condition(group, "Traction", {value[0], value[1]}); }
  void pressure(const std::string& group, double value) { condition(group, "Pressure", {value}); }
  void bodyForce(const std::string& body, Point value) { condition(body, "Body Force", {value[0], value[1]}); }

  void contact(const std::string& sideA, const std::string& sideB, bool keepGap = false);
  void line(const std::string& side, Point point, Point normal);
  void circle(const std::string& side, Point centre, double radius, bool hollow);
  /// y = level + amplitude cos(wave x + phase); ties the scene to the axes.
  void height(const std::string& side, double level, double amplitude, double wave, double phase);

  /// Ratios of Young moduli: 1, moderate or up to 1e6, drawn once per scene.
  double jumps = 0.0;
  int refinement = 1;  ///< multiplies cells of grids whose numbers are not fixed
  int bodies() const { return static_cast<int>(materials_.size()); }

  /// The scene file; afterwards the mesh is rotated, scaled and renumbered. \param mesh  name of the mesh file in the text
  std::string finish(const std::string& meshFile);

 private:
  struct BodyMaterial {
    std::string name;
    double young, poisson;
    bool mixed;
  };
  struct Condition {
    std::string group, type;
    std::vector<double> value;
    std::string components;
  };
  struct Contact {
    enum class Kind { Sides, Line, Circle, Height } kind = Kind::Sides;
    std::string sideA, sideB;
    bool keepGap = false, hollow = false;
    Point at{0, 0, 0}, normal{0, 0, 0};
    double numbers[4] = {0, 0, 0, 0};
  };
  Point turned(Point p) const { return {cosine_ * p[0] - sine_ * p[1], sine_ * p[0] + cosine_ * p[1], 0}; }
  std::string conditionsText() const;
  std::string contactText() const;
  std::string partitionText();

  std::vector<BodyMaterial> materials_;
  std::vector<Condition> conditions_;
  std::vector<Contact> contacts_;
  bool planeStress_ = false;
  double cosine_ = 1.0, sine_ = 0.0, length_ = 1.0, stress_ = 1.0, load_ = 1.0;
  std::vector<std::string> initialGaps_;
};

}  // namespace suture::corpus
