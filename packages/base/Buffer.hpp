#pragma once
#include <suture/base/Errors.hpp>

#include <cstring>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace suture {

/// True if T has a static forEachField(object, each) that calls each(member) for its members in order. Structs with members that are not
/// plain bytes are packed and unpacked this way.
template <typename T, typename = void>
struct HasFields : std::false_type {};
struct AnyField {
  template <typename Field>
  void operator()(Field&&) const {}
};
template <typename T>
struct HasFields<T, std::void_t<decltype(T::forEachField(std::declval<T&>(), AnyField{}))>> : std::true_type {};

/// True for values that are copied bytewise. A struct with padding between its members needs forEachField, because files must not contain
/// uninitialised bytes.
template <typename T>
constexpr bool isPlain = std::is_trivially_copyable_v<T> && !HasFields<T>::value;

/// Packs plain values, strings, vectors, maps and structs of them into the bytes of a message; Unpacker reads them in the same order.
class Packer {
 public:
  template <typename T>
  std::enable_if_t<isPlain<T>> put(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  template <typename T>
  std::enable_if_t<HasFields<T>::value> put(const T& object) {
    T::forEachField(object, [&](const auto& field) { put(field); });
  }
  void put(const std::string& text) {
    put(text.size());
    bytes_.append(text);
  }
  template <typename T>
  void put(const std::vector<T>& values) {
    put(values.size());
    if constexpr (isPlain<T>) {
      bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    } else {
      for (const T& value : values) put(value);
    }
  }
  template <typename K, typename V>
  void put(const std::map<K, V>& values) {
    put(values.size());
    for (const auto& [key, value] : values) {
      put(key);
      put(value);
    }
  }
  /// Reserves room for `bytes` bytes in total, if they are many and their number is known.
  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }
  const std::string& bytes() const& { return bytes_; }
  std::string bytes() && { return std::move(bytes_); }  ///< without a copy: std::move(packer).bytes()

 private:
  std::string bytes_;
};

/// Reads the bytes of a Packer. \throws InternalError  when fewer bytes are left than requested.
class Unpacker {
 public:
  explicit Unpacker(std::string bytes) : bytes_(std::move(bytes)) {}

  template <typename T>
  std::enable_if_t<isPlain<T>> get(T& value) {
    std::memcpy(static_cast<void*>(&value), take(sizeof(T)), sizeof(T));
  }
  template <typename T>
  std::enable_if_t<HasFields<T>::value> get(T& object) {
    T::forEachField(object, [&](auto& field) { get(field); });
  }
  void get(std::string& text) {
    const std::size_t n = takeCount(1);
    text.assign(take(n), n);
  }
  template <typename T>
  void get(std::vector<T>& values) {
    const std::size_t n = takeCount(isPlain<T> ? sizeof(T) : 1);
    values.resize(n);
    if constexpr (isPlain<T>) {
      const char* from = take(n * sizeof(T));
      if (n > 0) std::memcpy(static_cast<void*>(values.data()), from, n * sizeof(T));
    } else {
      for (T& value : values) get(value);
    }
  }
  template <typename K, typename V>
  void get(std::map<K, V>& values) {
    const std::size_t n = takeCount(1);
    values.clear();
    for (std::size_t i = 0; i < n; ++i) {
      K key;
      get(key);
      get(values[key]);
    }
  }
  template <typename T>
  T get() {
    T value;
    get(value);
    return value;
  }
  bool done() const { return at_ == bytes_.size(); }

 private:
  /// The next `n` bytes. Defined in its own source: inlined, gcc 12 reports the bytes of a short string as uninitialised.
  const char* take(std::size_t n);
  /// Reads a number of objects of at least `size` bytes each; checked against the remaining bytes before memory is allocated.
  std::size_t takeCount(std::size_t size);

  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace suture
