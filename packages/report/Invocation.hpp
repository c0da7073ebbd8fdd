#pragma once
#include <string>
#include <vector>

namespace suture {

/// A file used by a run in addition to its scene.
struct UsedFile {
  std::string path;  ///< absolute; empty: none
  std::string hash;  ///< hash of its bytes, hexadecimal
};

/// How a run was started, in addition to its scene file and overrides.
struct Invocation {
  std::vector<std::string> commandLine{};
  std::vector<UsedFile> plugins{};
  UsedFile restart{};  ///< checkpoint from which the run continued
  bool strict = false;
};

/// Hexadecimal hash of bytes (FNV-1a, 64 bits), to detect changes of a file; not cryptographic. Local.
std::string hashOf(const std::string& bytes);

/// Bytes of a file. Local. \param expected  for the message if it is not a file  \throws InputError  it cannot be read
std::string bytesOfFile(const std::string& path, const std::string& expected);

/// The absolute path, valid in any working folder. Local.
std::string absolutePath(const std::string& path);

/// A file with the hash of its bytes. Local. \throws InputError  it cannot be read
UsedFile usedFile(const std::string& path);

}  // namespace suture
