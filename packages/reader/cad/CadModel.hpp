#pragma once
#include <suture/reader/cad/CadFile.hpp>
#include <suture/reader/cad/CadNames.hpp>
#include <suture/reader/cad/CadSizes.hpp>

#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace suture {

/// A CAD file that cannot be meshed; the text is for the user.
struct CadError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// CAD file in Gmsh's current model: solids that share no points, curves or faces, lengths of STEP and IGES files in mm. Part of
/// suture_mesher; needs gmsh::initialize().
class CadModel {
 public:
  /// Reads the file. Surfaces without a solid are sewn into solids.
  /// \throws CadError  no solid; an .stl file that is not one closed surface. Gmsh's own errors
  explicit CadModel(const std::string& path);

  /// Meshes the surfaces coarsely to find their orientation, and makes a physical group of each body and each face, named by
  /// cadBodyNames() and cadFaceNames(). Faces of the same cylinder, cone, sphere or torus that meet at a seam are one group.
  /// \param scale  length unit of the mesh over that of the model, for descriptions
  /// \return  a description of each side group: "cylinder, radius 6, along z, hole"
  std::map<std::string, std::string> name(double scale);

  /// Sets Gmsh's options for the mesh: sizes from curvature and CadSizes, order.
  /// \param most  largest element [length of the model]; none: from the geometry
  void setMeshing(int order, std::optional<double> most);

 private:
  struct Face {
    int tag = 0;
    std::vector<int> curves;
    CadFace cad;
  };
  void importShapes();
  void sew();
  void separateSolids();
  void importTriangles();
  void findEntities();
  void meshSkins();
  CadFace describe(int tag, int body) const;
  CadFace describeFacets(const std::vector<int>& tags, int body) const;
  CadFace joined(const std::vector<std::size_t>& members) const;
  SurfaceShape shapeOf(int tag, const Point& outward, const Point& at) const;
  std::vector<std::vector<std::size_t>> groupedFaces() const;
  std::vector<std::vector<std::size_t>> smoothPatches() const;
  bool isSeam(int curve, SurfaceShape::Kind kind) const;
  void findRadii();
  double sizeOnRound(const CadSizes& sizes, int dimension, int tag) const;

  std::string path_;
  CadFormat format_;
  std::vector<int> volumes_;                           // tags
  std::map<int, std::string> labels_;                  // by tag of the volume
  std::map<std::pair<int, int>, std::size_t> bodyOf_;  // by dimension and tag
  std::vector<Skin> skins_;                            // by body
  std::vector<Face> faces_;
  CadSizes::Radii radii_;
};

}  // namespace suture
