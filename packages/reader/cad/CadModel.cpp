#include <suture/base/Point.hpp>
#include <suture/reader/cad/CadModel.hpp>
#include <suture/reader/cad/ShapeWords.hpp>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace suture {

namespace {

using Kind = SurfaceShape::Kind;

constexpr double kPi = 3.14159265358979323846;
constexpr double kSewing = 1e-5;            // gap between faces that sewing closes, over the extent
constexpr double kStraight = 1e-6;          // largest sagitta of a straight curve over its length
constexpr double kCoarse = 0.1;             // size of the coarse surface mesh over the extent of a body
constexpr double kSmallest = 1e-3;          // its smallest size over that
constexpr double kCoarseTurn = 16;          // its elements on a full circle
constexpr double kCrease = 30 * kPi / 180;  // angle between triangles of an .stl file that separates two faces
constexpr double kSame = 1e-5;              // largest distance of two faces of the same cylinder over the extent of the body
constexpr double kTip = 0.1;                // smallest radius of a face that is resolved over its median: a cone ends in a point
constexpr double kNoLimit = 1e22;           // Gmsh's size where nothing limits it
const ShapeTolerance kFacets{0.35, 2e-3};   // for triangulated round faces
const ShapeTolerance kFlat{1e-3, 1e-5};     // for triangulated planes

Point pointAt(const std::vector<double>& xyz, std::size_t i) { return {xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]}; }

/// Entities of a dimension on the boundary of an entity.
std::vector<int> below(int dimension, int tag) {
  std::vector<int> up, down;
  gmsh::model::getAdjacencies(dimension, tag, up, down);
  for (int& one : down) one = std::abs(one);
  return down;
}

/// An entity itself, and the faces, curves and points of its boundary.
std::set<std::pair<int, int>> closure(int highest, int entity) {
  std::set<std::pair<int, int>> all{{highest, entity}};
  std::vector<int> tags{entity};
  for (int dimension = highest; dimension > 0; --dimension) {
    std::set<int> next;
    for (const int tag : tags)
      for (const int one : below(dimension, tag)) next.insert(one);
    tags.assign(next.begin(), next.end());
    for (const int tag : tags) all.insert({dimension - 1, tag});
  }
  return all;
}

std::vector<int> tagsOf(int dimension) {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, dimension);
  std::vector<int> tags;
  for (const auto& entity : entities) tags.push_back(entity.second);
  return tags;
}

double extentOf(int dimension, int tag) {
  Point low, high;
  gmsh::model::getBoundingBox(dimension, tag, low[0], low[1], low[2], high[0], high[1], high[2]);
  return norm(minus(high, low));
}

std::string counted(std::size_t count, const std::string& what) { return std::to_string(count) + " " + what + (count == 1 ? "" : "s"); }

/// Smallest radius of curvature of a face that is equally round everywhere; 0 for other shapes.
double leastRadius(const SurfaceShape& shape) {
  switch (shape.kind) {
    case Kind::Cylinder:
    case Kind::Sphere:
      return shape.radius;
    case Kind::Torus:
      return shape.tube;
    default:
      return 0.0;
  }
}

/// Places on a face in its parameters, without the ends: a cone or a sphere has no normal at its tip.
std::vector<double> samplesOf(int face) {
  constexpr int kSamples = 6;  // in each direction
  std::vector<double> low, high, places;
  gmsh::model::getParametrizationBounds(2, face, low, high);
  for (int i = 0; i < kSamples; ++i)
    for (int k = 0; k < kSamples; ++k) {
      places.push_back(low[0] + (high[0] - low[0]) * (i + 0.5) / kSamples);
      places.push_back(low[1] + (high[1] - low[1]) * (k + 0.5) / kSamples);
    }
  return places;
}

/// Smallest radii of curvature at places of a face; kNoLimit where it is flat.
std::vector<double> radiiAt(int face, const std::vector<double>& places) {
  std::vector<double> most, least, first, second, radii;
  gmsh::model::getPrincipalCurvatures(face, places, most, least, first, second);
  for (std::size_t i = 0; i < most.size(); ++i) radii.push_back(1 / std::max({std::abs(most[i]), std::abs(least[i]), 1 / kNoLimit}));
  return radii;
}

double medianRadius(int face) {
  std::string type;
  gmsh::model::getType(2, face, type);
  if (type == "Plane") return kNoLimit;
  std::vector<double> radii = radiiAt(face, samplesOf(face));
  std::sort(radii.begin(), radii.end());
  return radii.empty() ? kNoLimit : radii[radii.size() / 2];
}

/// Sets of items that belong together.
class Groups {
 public:
  explicit Groups(std::size_t count) : first_(count) { std::iota(first_.begin(), first_.end(), std::size_t(0)); }
  void join(std::size_t a, std::size_t b) { first_[std::max(lowest(a), lowest(b))] = std::min(lowest(a), lowest(b)); }
  /// The items of each set, ascending, in the order of their lowest items.
  std::vector<std::vector<std::size_t>> members() const {
    std::map<std::size_t, std::vector<std::size_t>> sets;
    for (std::size_t i = 0; i < first_.size(); ++i) sets[lowest(i)].push_back(i);
    std::vector<std::vector<std::size_t>> result;
    for (auto& entry : sets) result.push_back(std::move(entry.second));
    return result;
  }

 private:
  std::size_t lowest(std::size_t i) const {
    while (first_[i] != i) i = first_[i];
    return i;
  }
  std::vector<std::size_t> first_;
};

/// Triangles of the mesh of a surface.
std::vector<Skin::Triangle> trianglesOf(int face) {
  std::vector<std::size_t> elements, nodes, tags;
  gmsh::model::mesh::getElementsByType(2, elements, nodes, face);
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, 2, face, true, false);
  std::map<std::size_t, Point> places;
  for (std::size_t i = 0; i < tags.size(); ++i) places[tags[i]] = pointAt(coordinates, i);
  std::vector<Skin::Triangle> triangles;
  for (std::size_t e = 0; e + 2 < nodes.size(); e += 3)
    triangles.push_back(
        Skin::triangle({places[nodes[e]], places[nodes[e + 1]], places[nodes[e + 2]]}, {nodes[e], nodes[e + 1], nodes[e + 2]}, face));
  return triangles;
}

/// Checks that the triangles of an .stl file are one closed surface. \throws CadError
void checkClosed(const std::vector<std::size_t>& nodes) {
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  std::map<std::size_t, std::size_t> part;
  const auto root = [&](std::size_t node) {
    while (part.at(node) != node) node = part[node] = part.at(part.at(node));
    return node;
  };
  for (std::size_t i = 0; i < nodes.size(); ++i) part.emplace(nodes[i], nodes[i]);
  for (std::size_t e = 0; e + 2 < nodes.size(); e += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = nodes[e + k], b = nodes[e + (k + 1) % 3];
      ++edges[std::minmax(a, b)];
      part[root(a)] = root(b);
    }
  const auto open = std::count_if(edges.begin(), edges.end(), [](const auto& edge) { return edge.second % 2 != 0; });
  if (open > 0)
    throw CadError(counted(static_cast<std::size_t>(open), "edge") + " of " + std::to_string(nodes.size() / 3) +
                   " triangles without a neighbour: the surface is not closed; expected the closed surface of one body");
  const auto crossed = std::count_if(edges.begin(), edges.end(), [](const auto& edge) { return edge.second > 2; });
  if (crossed > 0)
    throw CadError(counted(static_cast<std::size_t>(crossed), "edge") +
                   " at which more than two triangles meet; expected the closed surface of one body");
  std::set<std::size_t> parts;
  for (const auto& entry : part) parts.insert(root(entry.first));
  if (parts.size() > 1)
    throw CadError("contains " + std::to_string(parts.size()) +
                   " separate surfaces; expected one, the closed surface of one body. Save each body in its own file, or use a STEP file");
}

}  // namespace

CadModel::CadModel(const std::string& path) : path_(path), format_(cadFormat(path)) {
  if (format_ == CadFormat::Stl)
    importTriangles();
  else
    importShapes();
  findEntities();
}

void CadModel::importShapes() {
  static const std::map<CadFormat, std::string> names{{CadFormat::Step, "step"}, {CadFormat::Iges, "iges"}, {CadFormat::Brep, "brep"}};
  gmsh::vectorpair imported;
  gmsh::model::occ::importShapes(path_, imported, true, names.at(format_));
  gmsh::model::occ::synchronize();
  const std::size_t defined = solidsDefinedIn(path_), read = tagsOf(3).size();
  if (read < defined)
    throw CadError("defines " + counted(defined, "solid") + ", of which OpenCASCADE could read " + std::to_string(read) +
                   "; check and repair the parts in the CAD program");
  if (read == 0) sew();
  separateSolids();
}

void CadModel::sew() {
  gmsh::vectorpair faces, healed;
  gmsh::model::getEntities(faces, 2);
  if (faces.empty()) throw CadError("contains no solid and no surface; is it a complete CAD file?");
  const std::string found = "contains " + counted(faces.size(), "surface") + " but no solid";
  const std::string expected = "; expected closed solids: export the parts as solids, or join the surfaces in the CAD program";
  gmsh::model::occ::healShapes(healed, faces, kSewing * extentOf(-1, -1), false, false, false, true, true);
  gmsh::model::occ::synchronize();
  if (tagsOf(3).empty()) throw CadError(found + ", and they do not form a closed shell" + expected);
  for (const int face : tagsOf(2)) {
    std::vector<int> up, down;
    gmsh::model::getAdjacencies(2, face, up, down);
    if (up.size() > 1) throw CadError(found + ", and two shells meet in a face" + expected);
    if (up.empty()) gmsh::model::occ::remove({{2, face}}, true);
  }
  gmsh::model::occ::synchronize();
}

// Bodies must share no nodes: a solid that shares a face, a curve or a point with another one is replaced by a copy.
void CadModel::separateSolids() {
  std::set<std::pair<int, int>> taken;
  bool changed = false;
  for (const int volume : tagsOf(3)) {
    std::string label;
    gmsh::model::getEntityName(3, volume, label);
    const std::set<std::pair<int, int>> own = closure(3, volume);
    const bool shares = std::any_of(own.begin(), own.end(), [&](const auto& entity) { return taken.count(entity) > 0; });
    taken.insert(own.begin(), own.end());
    labels_[volume] = label;
    if (!shares) continue;
    gmsh::vectorpair copies;
    gmsh::model::occ::copy({{3, volume}}, copies);
    gmsh::model::occ::remove({{3, volume}}, true);
    labels_.erase(volume);
    for (const auto& copy : copies)
      if (copy.first == 3) labels_[copy.second] = label;
    changed = true;
  }
  if (changed) gmsh::model::occ::synchronize();
}

void CadModel::importTriangles() {
  gmsh::merge(path_);
  std::vector<std::size_t> elements, nodes;
  gmsh::model::mesh::getElementsByType(2, elements, nodes);
  if (elements.empty()) throw CadError("contains no triangles");
  checkClosed(nodes);
  gmsh::model::mesh::classifySurfaces(kCrease, true, true, kPi);
  gmsh::model::mesh::createGeometry();
  const int loop = gmsh::model::geo::addSurfaceLoop(tagsOf(2));
  gmsh::model::geo::addVolume({loop});
  gmsh::model::geo::synchronize();
}

void CadModel::findEntities() {
  volumes_ = tagsOf(3);
  for (std::size_t b = 0; b < volumes_.size(); ++b)
    for (const auto& entity : closure(3, volumes_[b])) bodyOf_[entity] = b;
}

// With its own sizes from curvature, and with a smallest size larger than a face, Gmsh may run in an endless loop: each face has one size
// here. Sharp cones (radius 3, height 40) loop with any sizes, up to Mesh/Time Limit.
void CadModel::meshSkins() {
  if (format_ != CadFormat::Stl) {
    std::map<std::pair<int, int>, double> sizes;
    double least = kNoLimit;
    for (const auto& [entity, body] : bodyOf_) sizes[entity] = kCoarse * extentOf(3, volumes_[body]);
    for (const auto& [entity, body] : bodyOf_) {
      least = std::min(least, kSmallest * sizes.at(entity));
      if (entity.first != 2) continue;
      const double onFace = std::max(2 * kPi * medianRadius(entity.second) / kCoarseTurn, kSmallest * sizes.at(entity));
      for (const auto& part : closure(2, entity.second)) sizes.at(part) = std::min(sizes.at(part), onFace);
    }
    gmsh::option::setNumber("Mesh.MeshSizeMin", least);
    gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    gmsh::option::setNumber("Mesh.ElementOrder", 1);
    gmsh::model::mesh::setSizeCallback([sizes](int dimension, int tag, double, double, double) {
      const auto at = sizes.find({dimension, tag});
      return at == sizes.end() ? kNoLimit : at->second;
    });
    gmsh::model::mesh::generate(2);
    gmsh::model::mesh::removeSizeCallback();
  }
  for (const int volume : volumes_) {
    std::vector<Skin::Triangle> triangles;
    for (const int face : below(3, volume))
      for (const Skin::Triangle& triangle : trianglesOf(face)) triangles.push_back(triangle);
    skins_.emplace_back(std::move(triangles));
  }
}

SurfaceShape CadModel::shapeOf(int tag, const Point& outward, const Point& at) const {
  const std::vector<double> places = samplesOf(tag);
  std::vector<double> values, normals, here;
  gmsh::model::getValue(2, tag, places, values);
  gmsh::model::getNormal(tag, places, normals);
  std::vector<double> nearby;
  gmsh::model::getParametrization(2, tag, {at[0], at[1], at[2]}, nearby);
  gmsh::model::getNormal(tag, nearby, here);
  const double sign = dot(pointAt(here, 0), outward) < 0 ? -1.0 : 1.0;
  std::vector<Point> points, directions;
  for (std::size_t i = 0; i < values.size() / 3; ++i) {
    points.push_back(pointAt(values, i));
    directions.push_back(scaled(sign, pointAt(normals, i)));
  }
  SurfaceShape shape = surfaceShape(points, directions);
  std::string type;
  gmsh::model::getType(2, tag, type);
  if (shape.kind != Kind::Other || type != "Torus") return shape;
  std::vector<double> most, least, first, second;
  gmsh::model::getPrincipalCurvatures(tag, places, most, least, first, second);
  for (const double curvature : {most[0], least[0]})
    if (shape.kind == Kind::Other && curvature != 0.0) shape = surfaceShape(points, directions, {}, 1 / std::abs(curvature));
  return shape;
}

CadFace CadModel::describe(int tag, int body) const {
  CadFace face;
  face.body = body;
  const Skin::Triangle* largest = nullptr;
  std::vector<Point> points, normals;
  for (const Skin::Triangle& triangle : skins_[static_cast<std::size_t>(body)].triangles()) {
    if (triangle.face != tag) continue;
    if (!largest || triangle.area > largest->area) largest = &triangle;
    face.area += triangle.area;
    face.centre = plus(face.centre, scaled(triangle.area, triangle.centre));
    for (const Point& corner : triangle.corners) {
      points.push_back(corner);
      normals.push_back(triangle.normal);
    }
  }
  if (!largest || !(face.area > 0)) return face;
  face.centre = scaled(1.0 / face.area, face.centre);
  face.shape = shapeOf(tag, largest->normal, largest->centre);
  if (face.shape.kind == Kind::Cone) {
    face.shape.radius = 0.0;
    for (const Point& p : points)
      face.shape.radius = std::max(face.shape.radius, norm(cross(minus(p, face.shape.centre), face.shape.axis)));
  }
  gmsh::model::occ::getMass(2, tag, face.area);
  gmsh::model::occ::getCenterOfMass(2, tag, face.centre[0], face.centre[1], face.centre[2]);
  return face;
}

// Gmsh cuts the faces of an .stl file into patches; here patches belong together unless there is a crease between them.
std::vector<std::vector<std::size_t>> CadModel::smoothPatches() const {
  std::map<int, std::size_t> numbers;
  for (std::size_t i = 0; i < faces_.size(); ++i) numbers[faces_[i].tag] = i;
  Groups groups(faces_.size());
  std::map<std::pair<std::size_t, std::size_t>, const Skin::Triangle*> edges;
  for (const Skin& skin : skins_)
    for (const Skin::Triangle& triangle : skin.triangles())
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [at, fresh] = edges.try_emplace(std::minmax(triangle.nodes[k], triangle.nodes[(k + 1) % 3]), &triangle);
        if (!fresh && dot(at->second->normal, triangle.normal) > std::cos(kCrease))
          groups.join(numbers.at(at->second->face), numbers.at(triangle.face));
      }
  return groups.members();
}

CadFace CadModel::describeFacets(const std::vector<int>& tags, int body) const {
  CadFace face;
  face.body = body;
  std::vector<Point> points, normals;
  for (const Skin::Triangle& triangle : skins_[static_cast<std::size_t>(body)].triangles()) {
    if (std::find(tags.begin(), tags.end(), triangle.face) == tags.end()) continue;
    face.area += triangle.area;
    face.centre = plus(face.centre, scaled(triangle.area, triangle.centre));
    for (const Point& corner : triangle.corners) {
      points.push_back(corner);
      normals.push_back(triangle.normal);
    }
  }
  if (face.area > 0) face.centre = scaled(1.0 / face.area, face.centre);
  face.shape = surfaceShape(points, normals, kFlat);
  if (face.shape.kind != Kind::Other) return face;
  const SurfaceShape round = surfaceShape(points, normals, kFacets);
  if (round.kind == Kind::Cylinder || round.kind == Kind::Sphere) face.shape = round;
  return face;
}

// A closed cylinder is cut along straight lines; a circle around it was drawn on purpose.
bool CadModel::isSeam(int curve, Kind kind) const {
  if (kind == Kind::Sphere || kind == Kind::Torus) return true;
  constexpr int kSamples = 5;
  std::vector<double> low, high, places, values;
  gmsh::model::getParametrizationBounds(1, curve, low, high);
  for (int i = 0; i < kSamples; ++i) places.push_back(low[0] + (high[0] - low[0]) * i / (kSamples - 1));
  gmsh::model::getValue(1, curve, places, values);
  const Point first = pointAt(values, 0), way = minus(pointAt(values, kSamples - 1), first);
  for (std::size_t i = 1; i + 1 < kSamples; ++i)
    if (norm(cross(minus(pointAt(values, i), first), way)) > kStraight * dot(way, way)) return false;
  return true;
}

std::vector<std::vector<std::size_t>> CadModel::groupedFaces() const {
  Groups all(faces_.size());
  std::map<int, std::vector<std::size_t>> byCurve;
  for (std::size_t i = 0; i < faces_.size(); ++i)
    for (const int curve : std::set<int>(faces_[i].curves.begin(), faces_[i].curves.end())) byCurve[curve].push_back(i);
  for (const auto& [curve, sharing] : byCurve)
    for (std::size_t k = 1; k < sharing.size(); ++k) {
      const CadFace &a = faces_[sharing[0]].cad, &b = faces_[sharing[k]].cad;
      if (a.body == b.body && isSameShape(a.shape, b.shape, skins_[static_cast<std::size_t>(a.body)].extent(), kSame) &&
          isSeam(curve, a.shape.kind))
        all.join(sharing[0], sharing[k]);
    }
  return all.members();
}

CadFace CadModel::joined(const std::vector<std::size_t>& members) const {
  CadFace whole = faces_[members[0]].cad;
  whole.area = 0.0;
  whole.centre = {0, 0, 0};
  for (const std::size_t i : members) {
    whole.area += faces_[i].cad.area;
    whole.centre = plus(whole.centre, scaled(faces_[i].cad.area, faces_[i].cad.centre));
  }
  if (whole.area > 0) whole.centre = scaled(1.0 / whole.area, whole.centre);
  return whole;
}

std::map<std::string, std::string> CadModel::name(double scale) {
  meshSkins();
  std::vector<CadBody> bodies;
  for (std::size_t b = 0; b < volumes_.size(); ++b) {
    bodies.push_back({labels_[volumes_[b]], skins_[b].low(), skins_[b].high()});
    for (const int tag : below(3, volumes_[b])) {
      faces_.push_back({tag, below(2, tag), {}});
      faces_.back().cad.body = static_cast<int>(b);
      if (format_ != CadFormat::Stl) faces_.back().cad = describe(tag, static_cast<int>(b));
    }
  }
  const std::vector<std::string> bodyNames = cadBodyNames(bodies);
  for (std::size_t b = 0; b < volumes_.size(); ++b)
    gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {volumes_[b]}), bodyNames[b]);

  std::vector<CadFace> groups;
  std::vector<std::vector<int>> tags;
  for (const std::vector<std::size_t>& members : format_ == CadFormat::Stl ? smoothPatches() : groupedFaces()) {
    tags.emplace_back();
    for (const std::size_t i : members) tags.back().push_back(faces_[i].tag);
    const CadFace& first = faces_[members[0]].cad;
    groups.push_back(format_ == CadFormat::Stl ? describeFacets(tags.back(), first.body) : joined(members));
    if (const double radius = leastRadius(groups.back().shape); radius > 0)
      for (const int tag : tags.back()) radii_.ofFace[tag] = radius;
  }
  if (format_ != CadFormat::Stl) findRadii();
  const std::vector<std::string> names = cadFaceNames(groups, bodies, bodyNames);
  std::map<std::string, std::string> descriptions;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, tags[i]), names[i]);
    descriptions[names[i]] = inWords(groups[i].shape, scale);
  }
  return descriptions;
}

// Radii of faces whose curvature changes, at the nodes of the coarse mesh.
void CadModel::findRadii() {
  for (const Face& face : faces_) {
    if (face.cad.shape.kind == Kind::Plane || radii_.ofFace.count(face.tag) > 0) continue;
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, 2, face.tag, true, true);
    const std::vector<double> radii = radiiAt(face.tag, parameters);
    const double smallest = kTip * medianRadius(face.tag);
    for (std::size_t i = 0; i < radii.size(); ++i)
      radii_.at.push_back({static_cast<std::size_t>(face.cad.body), pointAt(coordinates, i), std::max(radii[i], smallest)});
  }
}

/// Size on a face that is equally round everywhere, or on a curve or a point of one; no limit elsewhere.
double CadModel::sizeOnRound(const CadSizes& sizes, int dimension, int tag) const {
  if (dimension == 3) return kNoLimit;
  std::vector<int> faces{tag};
  for (int d = dimension; d < 2; ++d) {
    std::set<int> next;
    for (const int one : faces) {
      std::vector<int> up, down;
      gmsh::model::getAdjacencies(d, one, up, down);
      next.insert(up.begin(), up.end());
    }
    faces.assign(next.begin(), next.end());
  }
  double size = kNoLimit;
  for (const int face : faces)
    if (const auto round = radii_.ofFace.find(face); round != radii_.ofFace.end())
      size = std::min(size, sizes.ofRadius(bodyOf_.at({dimension, tag}), round->second));
  return size;
}

void CadModel::setMeshing(int order, std::optional<double> most) {
  if (format_ != CadFormat::Stl) gmsh::model::mesh::clear();
  const bool triangles = format_ == CadFormat::Stl;
  const CadSizes sizes(skins_, order, radii_);
  std::map<std::pair<int, int>, double> onRound;
  for (const auto& entry : bodyOf_) onRound[entry.first] = sizeOnRound(sizes, entry.first.first, entry.first.second);
  gmsh::option::setNumber("Mesh.MeshSizeMin", most ? std::min(sizes.least(), *most) : sizes.least());
  if (most) gmsh::option::setNumber("Mesh.MeshSizeMax", *most);
  gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 0);
  gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
  gmsh::option::setNumber("Mesh.ElementOrder", order);
  // The triangles of an .stl file are flat: curved elements between them may be turned inside out.
  if (triangles) gmsh::option::setNumber("Mesh.SecondOrderLinear", 1);
  gmsh::model::mesh::setSizeCallback([this, sizes, onRound](int dimension, int tag, double x, double y, double z) {
    const auto at = bodyOf_.find({dimension, tag});
    return at == bodyOf_.end() ? kNoLimit : std::min(sizes.at(at->second, {x, y, z}), onRound.at(at->first));
  });
}

}  // namespace suture
