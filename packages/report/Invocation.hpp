#pragma once
#include <string>
#include <vector>

namespace suture {

/// A file that a run used beside its scene.
struct UsedFile {
  std::string path;  ///< absolute; empty: none
  std::string hash;  ///< hexadecimal, of its bytes
};

/// How a run was started, beside its scene file and the assignments in it.
struct Invocation {
  std::vector<std::string> commandLine{};
  std::vector<UsedFile> plugins{};
  UsedFile restart{};  ///< checkpoint that it went on from
  bool strict = false;
};

/// Hexadecimal hash of bytes (FNV-1a, 64 bits): tells whether a file has changed, and withstands no forger. Local.
std::string hashOf(const std::string& bytes);

/// Bytes of a file. Local. \param expected  for the message of what is no file  \throws InputError  it cannot be read
std::string bytesOfFile(const std::string& path, const std::string& expected);

/// A path that means the same in any folder. Local.
std::string absolutePath(const std::string& path);

/// A file with the hash of its bytes. Local. \throws InputError  it cannot be read
UsedFile usedFile(const std::string& path);

}  // namespace suture
