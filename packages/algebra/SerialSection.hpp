#pragma once

namespace suture {

/// While an object exists, OpenMP regions entered by this thread run serially. CHOLMOD requests four threads for each larger supernode even
/// if OMP_NUM_THREADS is smaller, which takes cores from other ranks. Local.
class SerialSection {
 public:
  SerialSection();
  ~SerialSection();
  SerialSection(const SerialSection&) = delete;
  SerialSection& operator=(const SerialSection&) = delete;

 private:
  int levels_;
};

}  // namespace suture
