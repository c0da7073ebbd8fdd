// main of suture_study, which is implemented in ../suture_study.cpp.
#include "../support/Program.hpp"
#include "Loop.hpp"

int main(int argc, char* argv[]) {
  suture::study::Options options;
  if (const auto end = options.parse(argc, argv)) return *end;
  return suture::runProgram("suture_study", options.study, [&](const suture::CommPtr& comm) { return suture::study::run(comm, options); });
}
