#include "Buffer.hpp"

namespace suture {

const char* Unpacker::take(std::size_t n) {
  if (n > bytes_.size() - at_) throw InternalError("a message ended before its last field");
  const char* from = bytes_.data() + at_;
  at_ += n;
  return from;
}

std::size_t Unpacker::takeCount(std::size_t size) {
  const std::size_t n = get<std::size_t>();
  if (n > (bytes_.size() - at_) / size) throw InternalError("a message ended before its last field");
  return n;
}

}  // namespace suture
