#pragma once

namespace suture {

/// While one lives, OpenMP regions that this thread enters run on it alone. CHOLMOD asks for four threads in each supernode of some size,
/// whatever OMP_NUM_THREADS says; ranks have their cores for themselves only if no rank does. Local.
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
