#pragma once
#include <suture/answer/bound/ContactNodes.hpp>
#include <suture/answer/bound/ContactTractions.hpp>
#include <suture/answer/bound/FrictionTractions.hpp>
#include <suture/answer/bound/PressedSides.hpp>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace suture {

struct Pressures;

/// Traction on a side, as sent from rank 0.
struct SideTraction {
  int rank = -1, number = -1;
  int isUnknown = 0;
  LinearTraction replaced{};  // for replaceLinearTraction [stress]
  std::array<Point, 6> values{};

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.rank), each(self.number), each(self.isUnknown), each(self.replaced), each(self.values);
  }
};

/// Statically admissible tractions on the sides of one contact, with the lifts and works of ContactTractions: pressures and friction
/// stresses in balance with the forces of its pairs. Local (rank 0).
class AdmissibleContact {
 public:
  /// All must outlive it. \param degree  of the tractions
  AdmissibleContact(const TouchingSides& contact, int dimension, int degree, const ContactLaw& law)
      : contact_(contact), dimension_(dimension), degree_(degree), law_(law) {}

  void add(const TouchingSide& side) { (side.onA ? a_ : b_).push_back(&side); }
  void add(const ContactNodes::Pair& own);
  /// Adds its results to `all` and the tractions of its sides: unknown ones, and a reason, if there are no admissible ones.
  void find(ContactTractions& all, std::vector<SideTraction>& tractions, std::set<std::string>& reasons);

 private:
  using Sides = ContactNodes::Sides;
  int sideNodes() const { return degree_ == 1 ? dimension_ : dimension_ * (dimension_ + 1) / 2; }
  /// Returns the reason if there are none.
  std::string findTractions(ContactTractions& all, std::vector<SideTraction>& tractions);
  /// Vector with these components along the tangents of a normal.
  Point along(const Point& normal, const std::array<double, 2>& components) const;
  std::array<double, 2> tangentialPart(const ContactNode& node, const Point& vector) const;
  /// Stresses of friction, or of any size where the sides are tied.
  FrictionTractions tangentialStresses(const ContactNodes& nodes, const PressedSides& sides) const;
  /// The bound of Tresca friction if it is the same everywhere and all nodes touch, so that it acts on all sides.
  std::optional<double> constantBound(const ContactNodes& nodes, const PressedSides& sides) const;
  std::string collect(const ContactNodes& nodes, PressedSides& sides, Sides& pressed, Sides& others) const;
  /// The pressure of sides with four vertices whose nodes are all closed, for each of `pressed`: its mean, with degree 2 also its
  /// derivatives. Forces of the nodes become those of the triangles under it.
  std::vector<std::array<double, 4>> linearPressures(ContactNodes& nodes, const Sides& pressed) const;
  void addTractions(const ContactNodes& nodes, const Sides& pressed, const Sides& others, const Matrix& pressures,
                    const std::array<Matrix, 2>& friction, const std::vector<std::array<double, 4>>& linear,
                    std::vector<SideTraction>& tractions) const;
  /// Lifts the sides out of each other: first their nodes, then the middles of their edges until the polynomial gap is nowhere negative.
  void addGap(const ContactNodes& nodes, const PressedSides& sides, const Pressures& pressures, ContactTractions& all) const;
  static void move(Point& place, double by, const Point& direction);
  std::map<GlobalId, double> nodalStiffness() const;
  /// Springs of a softened contact: lifts shorten them, and do not move the body.
  void addLayer(const ContactNodes& nodes, const PressedSides& sides, const Pressures& pressures, const std::vector<double>& heights,
                ContactTractions& all) const;
  void addFriction(const ContactNodes& nodes, const PressedSides& sides, const FrictionTractions& friction, ContactTractions& all) const;
  /// Moves side A so that sides that do not separate touch exactly.
  void close(const ContactNodes& nodes, ContactTractions& all) const;
  void addRests(const ContactNodes& nodes, const std::vector<std::vector<int>>& clusters, const std::vector<Point>& rests,
                ContactTractions& all) const;

  const TouchingSides& contact_;
  int dimension_, degree_;
  const ContactLaw& law_;
  double stiffness_ = 0.0;  // stiffness of springs [stress / length]
  bool separates_ = true, restrictsSliding_ = false, isSimple_ = true;
  Sides a_, b_;
  std::vector<ContactNodes::Pair> pairs_;
};

}  // namespace suture
