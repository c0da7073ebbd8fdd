#include <corpus/Builder.hpp>

#include <cstdio>

namespace suture::corpus {

namespace {

std::string text(double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.17g", value);
  return buffer;
}
std::string text(const std::vector<double>& values) {
  std::string all = "{";
  for (const double value : values) all += (all.size() > 1 ? ", " : "") + text(value);
  return all + "}";
}
std::string parameter(const std::string& name, const std::string& type, const std::string& value) {
  return "      <Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>\n";
}
std::string list(const std::string& name, const std::string& content) {
  return "    <ParameterList name=\"" + name + "\">\n" + content + "    </ParameterList>\n";
}

bool isQuadratic(Cell cell) { return cellInfo(cell).nodes > 4; }

}  // namespace

Builder::Builder(Random& numbers) : random(numbers) {
  planeStress_ = random.chance(0.15);
  const double kind = random.real(0, 1);
  jumps = kind < 0.4 ? 0.0 : kind < 0.75 ? 2.0 : 6.0;
  const double size = random.real(0, 1);
  refinement = size < 0.25 ? 1 : size < 0.7 ? 2 : 3;
}

void Builder::body(GridBody body) {
  const double kind = random.real(0, 1);
  body.cell = kind < 0.3    ? Cell::Triangle3
              : kind < 0.55 ? Cell::Quadrilateral4
              : kind < 0.7  ? Cell::Triangle6
              : kind < 0.85 ? Cell::Quadrilateral8
                            : Cell::Quadrilateral9;
  if (!body.keepGrid) {
    body.nx *= refinement;
    body.ny *= refinement;
    if (isQuadratic(body.cell)) {
      body.nx = std::max(2, (body.nx + 1) / 2);
      body.ny = std::max(1, (body.ny + 1) / 2);
    }
  }
  body.cutsX = std::min(random.integer(1, 3), body.nx);
  if (!body.present) body.cutsY = std::min(random.integer(1, 3), body.ny);
  BodyMaterial material{body.name, random.power(0.0, jumps), random.real(0.0, 0.45), false};
  if (random.chance(0.25) && body.cell != Cell::Triangle3) {
    material.poisson = 0.5 - random.power(-3.0, -1.3);
    material.mixed = !planeStress_;
  }
  materials_.push_back(material);
  add(body, mesh);
}

void Builder::box(const std::string& name, double x0, double x1, std::function<double(double)> bottom, std::function<double(double)> top,
                  int nx, int ny) {
  GridBody box;
  box.name = name;
  box.nx = nx;
  box.ny = ny;
  box.side = boxSide;
  box.map = [=](double s, double t) {
    const double x = x0 + (x1 - x0) * s;
    return Point{x, (1 - t) * bottom(x) + t * top(x), 0};
  };
  body(box);
}

void Builder::condition(const std::string& group, const std::string& type, std::vector<double> value, const std::string& components) {
  if (components != "All") mayTurn = false;
  conditions_.push_back({group, type, value, components});
}

void Builder::contact(const std::string& sideA, const std::string& sideB, bool keepGap) {
  Contact contact;
  contact.sideA = sideA;
  contact.sideB = sideB;
  contact.keepGap = keepGap;
  if (random.chance(0.3)) std::swap(contact.sideA, contact.sideB);
  contacts_.push_back(contact);
}
void Builder::line(const std::string& side, Point point, Point normal) {
  Contact contact;
  contact.kind = Contact::Kind::Line;
  contact.sideA = side;
  contact.at = point;
  contact.normal = normal;
  contacts_.push_back(contact);
}
void Builder::circle(const std::string& side, Point centre, double radius, bool hollow) {
  Contact contact;
  contact.kind = Contact::Kind::Circle;
  contact.sideA = side;
  contact.at = centre;
  contact.numbers[0] = radius;
  contact.hollow = hollow;
  contacts_.push_back(contact);
}
void Builder::height(const std::string& side, double level, double amplitude, double wave, double phase) {
  mayTurn = false;
  Contact contact;
  contact.kind = Contact::Kind::Height;
  contact.sideA = side;
  contact.numbers[0] = level;
  contact.numbers[1] = amplitude;
  contact.numbers[2] = wave;
  contact.numbers[3] = phase;
  contacts_.push_back(contact);
}

std::string Builder::conditionsText() const {
  std::string all;
  int number = 0;
  for (const Condition& condition : conditions_) {
    const bool force = condition.type == "Body Force", displacement = condition.type == "Displacement";
    const double unit = displacement ? length_ : force ? stress_ * load_ / length_ : stress_ * load_;
    std::string own = parameter(force ? "Body" : "Group", "string", condition.group) + parameter("Type", "string", condition.type);
    std::vector<double> value = condition.value;
    if (value.size() == 2) {
      const Point p = turned({value[0], value[1], 0});
      value = {p[0], p[1]};
    }
    for (double& component : value) component *= unit;
    if (condition.components == "x") value = {value[0]};
    if (condition.components == "y") value = {value[1]};
    if (!value.empty()) own += parameter("Value", "Array(double)", text(value));
    if (displacement) own += parameter("Components", "string", condition.components);
    all += list("condition " + std::to_string(number++), own);
  }
  return list("Boundary Conditions", all);
}

std::string Builder::contactText() const {
  std::string all;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& contact = contacts_[i];
    std::string own = parameter("Side A", "string", contact.sideA);
    const Point at = turned(contact.at), normal = turned(contact.normal);
    const std::vector<double> place{at[0] * length_, at[1] * length_};
    if (contact.kind == Contact::Kind::Sides) {
      own += parameter("Side B", "string", contact.sideB);
      if (!initialGaps_[i].empty()) own += parameter("Initial Gap", "string", initialGaps_[i]);
    } else if (contact.kind == Contact::Kind::Line) {
      own += parameter("Obstacle", "string", "Line") + list("Line", parameter("Point", "Array(double)", text(place)) +
                                                                        parameter("Normal", "Array(double)", text({normal[0], normal[1]})));
    } else if (contact.kind == Contact::Kind::Circle) {
      own +=
          parameter("Obstacle", "string", "Circle") + list("Circle", parameter("Centre", "Array(double)", text(place)) +
                                                                         parameter("Radius", "double", text(contact.numbers[0] * length_)) +
                                                                         parameter("Hollow", "bool", contact.hollow ? "true" : "false"));
    } else {
      const double* n = contact.numbers;
      own += parameter("Obstacle", "string", "Height") +
             list("Height", parameter("Expression", "string",
                                      text(n[0] * length_) + " + " + text(n[1] * length_) + "*cos(" + text(n[2] / length_) + "*x + " +
                                          text(n[3]) + ")"));
    }
    all += list("contact " + std::to_string(i), own);
  }
  return list("Contact", all);
}

std::string Builder::partitionText() {
  std::string own = parameter("Type", "string", "Named Groups");
  if (random.chance(0.7)) {
    const int count = std::max(bodies(), std::min(random.integer(1, 5) + bodies() - 1, mesh.elements() / 8));
    own = parameter("Type", "string", "METIS") + list("METIS", parameter("Subdomains", "string", std::to_string(count)) +
                                                                   parameter("Seed", "int", std::to_string(random.integer(1, 1000))));
  }
  return list("Partition", own);
}

std::string Builder::finish(const std::string& meshFile) {
  if (mayTurn && random.chance(0.5)) {
    const double angle = random.real(0, 6.283185307179586);
    cosine_ = std::cos(angle);
    sine_ = std::sin(angle);
  }
  length_ = random.power(-3, 3);
  stress_ = random.power(-6, 6) / length_ / length_;
  load_ = random.power(random.chance(0.5) ? -9.0 : -4.0, -2.0);
  for (const Contact& contact : contacts_) {
    const bool own = contact.kind == Contact::Kind::Sides && !contact.keepGap && random.chance(0.15);
    initialGaps_.push_back(own ? text(length_ * random.sign() * random.power(-6, -2)) : "");
  }
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Point p = turned(mesh.point(node));
    for (int k = 0; k < 2; ++k) mesh.coordinates[2 * node + k] = p[k] * length_;
  }
  if (random.chance(0.5)) renumber(mesh, random.permutation(mesh.nodes()), random.permutation(mesh.elements()));

  std::string bodies, materials;
  for (const BodyMaterial& material : materials_) {
    bodies += list(material.name, parameter("Material", "string", material.name));
    materials += list(material.name, parameter("Young Modulus", "double", text(material.young * stress_)) +
                                         parameter("Poisson Ratio", "double", text(material.poisson)) +
                                         (material.mixed ? parameter("Element", "string", "Mixed") : ""));
  }
  return "<ParameterList name=\"Suture\">\n" + parameter("Title", "string", family) +
         parameter("Model", "string", planeStress_ ? "Plane Stress" : "Plane Strain") +
         list("Mesh", parameter("File", "string", meshFile)) + list("Bodies", bodies) + list("Materials", materials) + conditionsText() +
         contactText() + partitionText() + "</ParameterList>\n";
}

}  // namespace suture::corpus
