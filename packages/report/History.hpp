#pragma once
#include <suture/base/Monitor.hpp>

#include <fstream>
#include <string>
#include <vector>

namespace suture {

/// history.csv: a header line, then one row per outer iteration (none for a linear scene). Columns are the members of OuterRow;
/// load_step only in a scene with load steps.
/// Numbers are written with enough digits to recover the same double. Local.
/// \throws EnvironmentError
void writeHistory(const std::vector<OuterRow>& rows, const std::string& path);

/// The same file while its run is in progress, for `suture_solve --watch`: each row is in the file as soon as it is known, and the complete
/// file equals the later history.csv byte by byte (but is empty as long as there is no row). A file that cannot be written does not end the
/// run: writeHistory() reports it.
class LiveHistory {
 public:
  static constexpr const char* kName = "history.running.csv";

  /// Replaces an earlier file. Local.
  explicit LiveHistory(const std::string& path) : file_(path, std::ios::binary | std::ios::trunc) {}
  /// Appends a row. Local.
  void add(const OuterRow& row);

 private:
  std::ofstream file_;
  bool hasRows_ = false;
};

}  // namespace suture
