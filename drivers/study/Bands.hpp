#pragma once
#include <string>
#include <vector>

#include "Table.hpp"

namespace suture::study {

/// Result of a band.
struct Verdict {
  std::string band;
  bool kept = false;
  bool judged = true;    ///< false: none of its rows was run (--only)
  std::string sentence;  ///< "pcg 24 to 28 over 3 runs: at most 28"
};

/// Judges every band. A row that counts but has no value (its run failed) violates the band. Local.
std::vector<Verdict> judgeBands(const Study& study, const std::vector<Row>& rows);

/// The verdicts as a table. Local.
std::string bandsMarkdown(const std::vector<Verdict>& verdicts);

}  // namespace suture::study
