// Feeds files to a fuzzing harness: the corpora in the default tests, or an input that libFuzzer has found.
//   fuzz_NAME FOLDER_OR_FILE...
#include "Fuzz.hpp"

#include <algorithm>
#include <iostream>
#include <iterator>

int main(int argc, char* argv[]) {
  LLVMFuzzerInitialize(&argc, &argv);
  std::vector<std::filesystem::path> files;
  for (int i = 1; i < argc; ++i)
    if (std::filesystem::is_directory(argv[i]))
      std::copy(std::filesystem::directory_iterator(argv[i]), {}, std::back_inserter(files));
    else
      files.emplace_back(argv[i]);
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& path : files) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    std::cerr << path.filename().string() << ' ' << bytes.size() << " bytes" << std::endl;  // the last one named is the culprit
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  std::cout << files.size() << " inputs" << std::endl;
  return files.empty() ? 1 : 0;
}
