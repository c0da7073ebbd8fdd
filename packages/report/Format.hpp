#pragma once
#include <string>

namespace suture {

/// printf into a string.
__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...);

/// "9,670".
std::string grouped(long long number);

/// "1 rank", "2 ranks".
std::string counted(long long number, const std::string& noun);

}  // namespace suture
