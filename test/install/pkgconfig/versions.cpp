// Prints the versions of headers and library. Built only with the flags from pkg-config.
#include <suture/Version.hpp>
#include <suture/base/Version.hpp>

#include <cstdio>

#if !SUTURE_VERSION_AT_LEAST(SUTURE_VERSION_MAJOR, SUTURE_VERSION_MINOR, SUTURE_VERSION_PATCH) ||    \
    SUTURE_VERSION_AT_LEAST(SUTURE_VERSION_MAJOR, SUTURE_VERSION_MINOR, SUTURE_VERSION_PATCH + 1) || \
    SUTURE_VERSION_AT_LEAST(SUTURE_VERSION_MAJOR, SUTURE_VERSION_MINOR + 1, 0) || SUTURE_VERSION_AT_LEAST(SUTURE_VERSION_MAJOR + 1, 0, 0)
#error "SUTURE_VERSION_AT_LEAST does not order versions"
#endif

int main() {
  std::printf("%d.%d.%d %s %s\n", SUTURE_VERSION_MAJOR, SUTURE_VERSION_MINOR, SUTURE_VERSION_PATCH, SUTURE_VERSION,
              suture::version().c_str());
  return 0;
}
