#include <suture/report/Units.hpp>
#include <suture/simulation/OverlapNotes.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <set>

namespace suture {

namespace {

constexpr double kDeepened = 1.5;  // ratio of depths below which an overlap is the drawn one

std::set<int> linesOfGivenGaps(const Scene& scene) {
  std::set<int> lines;
  const Parameters& contacts = scene.settings().sublist("Contact");
  for (std::size_t line = 0; line < scene.contacts.size(); ++line)
    if (contacts.sublist(scene.contacts[line]).isParameter("Initial Gap")) lines.insert(static_cast<int>(line));
  return lines;
}

std::string noteOn(const Overlap& overlap, const Scene& scene, bool isDrawn) {
  return inWords(overlap, scene.model.bodies, scene.contacts, isDrawn, unitsOf(scene.settings()).length);
}

}  // namespace

OverlapNotes::OverlapNotes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Scene& scene)
    : search_(meshes, static_cast<int>(scene.model.bodies.size()), linesOfGivenGaps(scene)), drawn_(search_.find(comm)) {}

std::vector<std::string> OverlapNotes::drawn(const Scene& scene) const {
  std::vector<std::string> notes;
  for (const Overlap& overlap : drawn_)
    if (overlap.contact < 0) notes.push_back(noteOn(overlap, scene, true));
  return notes;
}

std::vector<std::string> OverlapNotes::added(const Comm& comm, const Scene& scene, const std::vector<Vector>& displacement) const {
  std::vector<std::string> notes;
  for (const Overlap& overlap : search_.find(comm, displacement)) {
    const auto isSame = [&](const Overlap& drawn) {
      return std::minmax(drawn.body, drawn.into) == std::minmax(overlap.body, overlap.into) && drawn.contact == overlap.contact &&
             overlap.depth < kDeepened * drawn.depth;
    };
    if (std::none_of(drawn_.begin(), drawn_.end(), isSame)) notes.push_back(noteOn(overlap, scene, false));
  }
  return notes;
}

}  // namespace suture
