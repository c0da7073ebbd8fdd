#include <suture/base/Errors.hpp>
#include <suture/reader/gmsh/GmshMesh.hpp>
#include <suture/reader/gmsh/MshCursor.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <type_traits>

namespace suture {

MshCursor::MshCursor(const std::string& path) : path_(path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? static_cast<std::streamoff>(in.tellg()) : -1;
  if (size < 0) fail("cannot be read");
  data_.reset(new char[static_cast<std::size_t>(size) + 1]);  // unlike a vector, without writing zeros first
  in.seekg(0);
  in.read(data_.get(), size);
  if (in.gcount() != size) fail("cannot be read to its end");
  data_[static_cast<std::size_t>(size)] = '\0';
  at_ = data_.get();
  end_ = at_ + size;
}

void MshCursor::fail(const std::string& what) const {
  std::string place;
  if (!section_.empty()) {
    const std::ptrdiff_t before = at_ - data_.get();
    place = ": $" + section_ + ", " +
            (binary ? "byte " + std::to_string(before) : "line " + std::to_string(1 + std::count(data_.get(), data_.get() + before, '\n')));
  }
  throw InputError(kMeshFile, path_ + place + ": " + what);
}

std::string MshCursor::word() const {
  const char* behind = at_;
  while (!endsWord(*behind)) ++behind;
  return {at_, behind};
}

std::string MshCursor::enterSection() {
  skipBlanks();
  if (at_ == end_) return "";
  const std::string head = word();
  if (head.size() < 2 || head[0] != '$') fail("expected a section such as $Nodes, found '" + head + "'");
  section_ = head.substr(1);
  endLine();  // binary numbers begin right after the newline
  return section_;
}

void MshCursor::leaveSection() {
  skipBlanks();
  if (at_ == end_) fail("the file ends where $End" + section_ + " is expected");
  const std::string found = word();
  if (found != "$End" + section_) fail("expected $End" + section_ + ", found '" + found + "'");
  at_ += found.size();
  section_.clear();
}

void MshCursor::skipSection() {
  const std::string mark = "$End" + section_;
  const std::string_view rest(at_, left());
  std::size_t found = rest.find(mark);
  while (found != std::string_view::npos && (found == 0 || rest[found - 1] != '\n' || !endsWord(at_[found + mark.size()])))
    found = rest.find(mark, found + 1);
  if (found == std::string_view::npos) fail("the section does not end: there is no line " + mark);
  at_ += found;
  leaveSection();
}

std::string MshCursor::quoted(const char* what) {
  skipBlanks();
  const std::string_view rest(at_, left());
  const std::string_view line = rest.substr(0, rest.find('\n'));
  const std::size_t last = line.rfind('"');
  if (line.empty() || line[0] != '"' || last == 0) fail(std::string("expected ") + what + " in double quotes, found '" + word() + "'");
  at_ += last + 1;
  return std::string(line.substr(1, last - 1));
}

void MshCursor::endLine() {
  const void* newline = std::memchr(at_, '\n', left());
  at_ = newline ? static_cast<const char*>(newline) + 1 : end_;
}

// Handles a number that from_chars() refuses: a real too small for a double becomes zero, one too large infinite; the caller checks it.
template <typename Number>
Number MshCursor::unusual(const char* what, bool outOfRange) {
  if (at_ == end_) fail(std::string("the file ends where ") + what + " is expected");
  const std::string found = word();
  if (outOfRange && std::is_same_v<Number, double>) {
    char* behind = nullptr;
    const double value = std::strtod(found.c_str(), &behind);
    if (*behind == '\0') {
      at_ += found.size();
      return static_cast<Number>(value);
    }
  }
  fail(std::string("expected ") + what + ", found '" + found + "'" + (outOfRange ? ", which is out of range" : ""));
}

template int MshCursor::unusual(const char*, bool);
template std::size_t MshCursor::unusual(const char*, bool);
template double MshCursor::unusual(const char*, bool);

}  // namespace suture
