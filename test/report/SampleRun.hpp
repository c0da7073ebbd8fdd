#pragma once
// A run whose answer is known: three subdomains in two blocks, displaced by one linear field, with contact pairs made by hand.
#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_Core.hpp>
#include <cmath>
#include <filesystem>
#include <map>
#include <suture/mesh/Generators.hpp>
#include <suture/report/Report.hpp>

namespace sample {

// u = (Uxx x + Uxy y, Uyx x + Uyy y)
constexpr double Uxx = 1e-3, Uxy = 2e-3, Uyx = -5e-4, Uyy = 3e-3;
constexpr double young = 2e6, poisson = 0.25;

inline suture::Point displacementAt(const suture::Point& x) { return {Uxx * x[0] + Uxy * x[1], Uyx * x[0] + Uyy * x[1], 0.0}; }

struct Stress {
  double xx, yy, zz, xy;
};

// Hooke's law of plane strain with Lame's constants, written out.
Stress exactStress();

class SampleRun {
 public:
  /// \param finer  factor for the number of cells in x and in y
  explicit SampleRun(const std::string& folder, int finer = 1);

  static std::vector<suture::OuterRow> rows();

  suture::Run run();

  /// Gives the pairs friction: the first slips, the second and the last stick, the third is open.
  void rub();

  suture::CommPtr comm_;
  suture::SceneFile scene_;
  suture::ElasticModel model_;
  std::vector<suture::ContactPiece> pieces_;
  std::vector<suture::SubdomainMesh> subdomains_;
  suture::ProblemSize size_;
  suture::Solution solution_;
  suture::RunMonitor monitor_;
  suture::Timers timers_;
  std::string folder_;

 private:
  int finer_;

  void makeScene();

  // [0,2]x[0,1] cut in two, under [0,2]x[1,2] in one.
  suture::Mesh makeMesh() const;

  suture::Partition cut(const suture::Mesh& mesh) const;

  void makeSolution();
};

// A folder of this test, "<name>_np<ranks>" next to the program; the python tests look for it there.
inline std::string folderOf(const std::string& name) { return name + "_np" + std::to_string(Tpetra::getDefaultComm()->getSize()); }

}  // namespace sample
