#pragma once
#include <string>
#include <vector>

namespace suture {

/// printf into a string.
__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...);

/// "9,670".
std::string grouped(long long number);

/// "1 rank", "2 ranks".
std::string counted(long long number, const std::string& noun);

/// The words of a command line, quoted where necessary such that it can be pasted into a shell. Local.
std::string shellCommand(const std::vector<std::string>& words);

}  // namespace suture
