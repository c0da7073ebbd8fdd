#include <suture/elasticity/LockingNotes.hpp>

#include <algorithm>
#include <sstream>

namespace suture {

std::vector<std::string> lockingNotes(const ElasticModel& model) {
  std::vector<std::string> notes;
  if (model.plane == PlaneModel::Stress) return notes;
  std::vector<Material> all = model.materialOfBody;
  all.insert(all.end(), model.materialOfRegion.begin(), model.materialOfRegion.end());
  for (const Material& material : all) {
    if (material.poisson <= kLockingPoisson || material.element == ElementForm::Mixed) continue;
    std::ostringstream text;
    text << "warning: Materials/" << material.name << ": Poisson ratio " << material.poisson
         << " with Element = Displacement: linear elements lock (displacements much too small), and the pressures of quadratic ones are "
            "inaccurate; Element = Automatic or Mixed avoids both";
    if (std::find(notes.begin(), notes.end(), text.str()) == notes.end()) notes.push_back(text.str());
  }
  return notes;
}

}  // namespace suture
