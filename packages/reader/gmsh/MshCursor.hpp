#pragma once
#include <charconv>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string>

namespace suture {

/// Bytes of a .msh file, read into memory at once, and the position that is read next. Local.
///
/// Every error is an InputError with the file, the section and the position: the line of a text file, the byte of a binary file.
class MshCursor {
 public:
  /// \throws InputError  if the file cannot be read
  explicit MshCursor(const std::string& path);

  bool binary = false;  ///< sections hold binary numbers: errors name the byte instead of the line

  /// Enters the next section, past "$Name". \return its name, or "" at the end of the file
  std::string enterSection();
  /// Expects "$EndName" and leaves the section.
  void leaveSection();
  /// Leaves the section from any place inside it.
  void skipSection();

  /// Reads a number in text, surrounded by blanks. \param what  its meaning, as in "expected <what>"
  template <typename Number>
  Number text(const char* what) {
    skipBlanks();
    const char* from = *at_ == '+' ? at_ + 1 : at_;
    Number value{};
    const auto [behind, error] = std::from_chars(from, end_, value);
    if (error != std::errc() || !endsWord(*behind)) return unusual<Number>(what, error == std::errc::result_out_of_range);
    at_ = behind;
    return value;
  }
  /// Reads a number in this machine's byte order.
  template <typename Number>
  Number bytes(const char* what) {
    Number value{};
    if (left() < sizeof value) fail(std::string("the file ends where ") + what + " is expected");
    std::memcpy(&value, at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  /// Reads a text in double quotes, up to the last quote of its line.
  std::string quoted(const char* what);
  /// Skips the rest of the line.
  void endLine();
  const char* rest() const { return at_; }  ///< bytes not read yet, followed by a zero
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

  [[noreturn]] void fail(const std::string& what) const;

 private:
  static bool isBlank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  static bool endsWord(char c) { return isBlank(c) || c == '\0'; }
  void skipBlanks() {
    while (isBlank(*at_)) ++at_;  // a zero follows the last byte
  }
  std::string word() const;
  template <typename Number>
  Number unusual(const char* what, bool outOfRange);

  std::string path_, section_;
  std::unique_ptr<char[]> data_;
  const char *at_ = nullptr, *end_ = nullptr;
};

/// Numbers of a .msh file, text or binary. Tags and counts are sizes in version 4, and integers in version 2.
template <bool isBinary>
struct MshNumbers {
  MshCursor& in;
  int integer(const char* what) { return number<int>(what); }
  std::size_t size(const char* what) { return number<std::size_t>(what); }
  double real(const char* what) { return number<double>(what); }

  /// Checks an announced count against the bytes left: each item takes at least `leastBytes` in a binary file, and two in a text file.
  std::size_t count(std::size_t announced, std::size_t leastBytes, const char* what) {
    if (announced > in.left() / (isBinary ? leastBytes : 2))
      in.fail(std::to_string(announced) + " " + what + " are announced, but the file ends earlier; is it complete?");
    return announced;
  }

 private:
  template <typename Number>
  Number number(const char* what) {
    return isBinary ? in.bytes<Number>(what) : in.text<Number>(what);
  }
};

}  // namespace suture
