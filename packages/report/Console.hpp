#pragma once
#include <suture/report/Figures.hpp>

#include <iosfwd>

namespace suture {

/// First line of the console: version, title, ranks, sizes. Local; rank 0's stream.
void printHeader(std::ostream& console, const Comm& comm, const SceneFile& scene, const ProblemSize& size);

/// Last lines of the console: whether and why not converged, contact figures, phases, memory, files. Local; rank 0's stream.
void printFooter(std::ostream& console, const Run& run, const RunFigures& figures);

/// Where to look for advice on a run without a valid solution; the line begins with `indent`.
std::string advice(const std::string& indent);

}  // namespace suture
