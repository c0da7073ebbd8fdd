#include <suture/algebra/dense/AlignedVector.hpp>

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <algorithm>
#include <cstdint>
#include <map>
#include <mutex>

namespace suture {

namespace {

constexpr std::size_t kCacheLine = 64, kPage = 4096, kHugePage = std::size_t(1) << 21;
constexpr std::size_t kSmall = std::size_t(1) << 15;  // up to this size, ordinary memory is as fast
constexpr std::size_t kChunk = std::size_t(1) << 25;

std::size_t roundedUp(std::size_t size, std::size_t unit) { return (size + unit - 1) / unit * unit; }

#if defined(__linux__)

/// Chunks of system memory, filled from one end to the other. Freed memory is returned to the system immediately, by pages; a chunk is
/// returned as a whole with its last piece.
class HugePages {
 public:
  void* allocate(std::size_t bytes) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::size_t size = roundedUp(bytes, kCacheLine);
    if (size > kChunk / 2) return open(roundedUp(size, kHugePage)).take(size);
    if (current_ == nullptr || current_->size - current_->used < size) current_ = &open(kChunk);
    return current_->take(size);
  }

  void free(void* at, std::size_t bytes) noexcept {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = std::prev(chunks_.upper_bound(static_cast<char*>(at)));
    Chunk& chunk = found->second;
    if (--chunk.pieces == 0) {
      if (current_ == &chunk) current_ = nullptr;
      munmap(chunk.begin, chunk.size);
      chunks_.erase(found);
      return;
    }
    const auto begin = reinterpret_cast<std::uintptr_t>(at), first = roundedUp(begin, kPage), last = (begin + bytes) / kPage * kPage;
    if (last > first) madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);
  }

 private:
  struct Chunk {
    char* begin;
    std::size_t size, used = 0;
    int pieces = 0;

    void* take(std::size_t bytes) {
      void* at = begin + used;
      used += bytes;
      ++pieces;
      return at;
    }
  };

  /// Starts at a huge page: memory mapped before and after the chunk is returned.
  Chunk& open(std::size_t size) {
    void* mapped = mmap(nullptr, size + kHugePage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (mapped == MAP_FAILED) throw std::bad_alloc();
    const auto from = reinterpret_cast<std::uintptr_t>(mapped), begin = roundedUp(from, kHugePage);
    if (begin > from) munmap(mapped, begin - from);
    munmap(reinterpret_cast<void*>(begin + size), from + kHugePage - begin);
    auto* const at = reinterpret_cast<char*>(begin);
    madvise(at, size, MADV_HUGEPAGE);  // pages stay small if the system refuses
    return chunks_.emplace(at, Chunk{at, size}).first->second;
  }

  std::mutex mutex_;
  std::map<char*, Chunk> chunks_;  // by their start
  Chunk* current_ = nullptr;       // the chunk being filled
};

/// Never destroyed: objects of static duration may free their memory late.
HugePages& hugePages() {
  static auto* const one = new HugePages;
  return *one;
}

#endif

}  // namespace

void* allocateLines(std::size_t bytes) {
#if defined(__linux__)
  if (bytes > kSmall) return hugePages().allocate(bytes);
#endif
  return ::operator new(std::max(bytes, kCacheLine), std::align_val_t(kCacheLine));
}

void freeLines(void* at, std::size_t bytes) noexcept {
#if defined(__linux__)
  if (bytes > kSmall) {
    hugePages().free(at, bytes);
    return;
  }
#endif
  ::operator delete(at, std::align_val_t(kCacheLine));
}

}  // namespace suture
