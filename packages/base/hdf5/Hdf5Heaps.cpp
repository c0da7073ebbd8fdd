#include "Hdf5Heaps.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <vector>

#include "Hdf5Object.hpp"

namespace suture::hdf5 {

namespace {

using Length = unsigned long long;

constexpr char kSignature[] = {'G', 'C', 'O', 'L', 1};  // signature with the version
constexpr std::size_t kPiece = 1 << 20;

Length aligned(Length bytes) { return (bytes + 7) / 8 * 8; }

Length number(const char* at, std::size_t bytes) {
  Length value = 0;
  for (std::size_t i = bytes; i-- > 0;) value = value << 8 | static_cast<unsigned char>(at[i]);
  return value;
}

/// Traverses one heap as HDF5 will. "HDF5 File Format Specification", III.E: signature, version, 3 bytes, total size; then objects of index
/// (2 bytes), references (2), 4 bytes, size of the data; index 0 is free space, whose size includes its header. Everything is padded to 8
/// bytes.
void checkHeap(std::ifstream& file, Length begin, Length fileSize, std::size_t lengthBytes) {
  const Length header = aligned(8 + lengthBytes);
  std::vector<char> heap(header);
  const auto damaged = [&](const char* why) {
    return Failed{"the heap of texts at byte " + std::to_string(begin) + " is damaged: " + why};
  };
  const auto read = [&](std::vector<char>& into) {
    file.clear();
    file.seekg(static_cast<std::streamoff>(begin));
    if (!file.read(into.data(), static_cast<std::streamsize>(into.size()))) throw damaged("it extends beyond the end of the file");
  };
  read(heap);
  const Length size = number(&heap[8], lengthBytes);
  if (size < header || size > fileSize - begin) throw damaged("it extends beyond the end of the file");
  heap.resize(size);
  read(heap);
  for (Length at = header; at + header <= size;) {
    const Length index = number(&heap[at], 2), data = number(&heap[at + 8], lengthBytes);
    if (data > size) throw damaged("a text extends beyond its end");
    const Length need = index == 0 ? data : header + aligned(data);
    if (need < header || need > size - at) throw damaged(need < header ? "an object has size zero" : "a text extends beyond its end");
    at += need;
  }
}

}  // namespace

void checkHeaps(const std::string& path, std::size_t lengthBytes) {
  std::ifstream file(path, std::ios::binary), heaps(path, std::ios::binary);
  file.seekg(0, std::ios::end);
  if (!file) throw Failed{"it cannot be read"};
  const auto fileSize = static_cast<Length>(file.tellg());
  // Pieces overlap, because a signature may lie across two of them.
  constexpr std::size_t overlap = sizeof kSignature - 1;
  std::vector<char> piece(kPiece + overlap);
  for (Length begin = 0; begin < fileSize; begin += kPiece) {
    const auto size = static_cast<std::size_t>(std::min<Length>(piece.size(), fileSize - begin));
    file.seekg(static_cast<std::streamoff>(begin));
    if (!file.read(piece.data(), static_cast<std::streamsize>(size))) throw Failed{"it cannot be read"};
    const char* const end = piece.data() + size;
    for (const char* at = piece.data(); at < end; ++at) {
      at = static_cast<const char*>(memmem(at, static_cast<std::size_t>(end - at), kSignature, sizeof kSignature));
      if (!at) break;
      checkHeap(heaps, begin + static_cast<Length>(at - piece.data()), fileSize, lengthBytes);
    }
  }
}

}  // namespace suture::hdf5
