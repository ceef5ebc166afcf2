#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "endowire/base/error.hpp"
#include "endowire/vessel/hash.hpp"

namespace endowire::vessel {

static_assert(std::endian::native == std::endian::little, "prepared data are stored little-endian");

/// What a cache file holds, and which version of it.
struct StorageKind {
  std::uint64_t magic;    ///< first eight bytes
  std::uint64_t version;  ///< of the format
  const char* what;       ///< for messages: "prepared field"
  /// For messages, of a file with another key.
  const char* foreign = "it belongs to another mesh or other parameters";
};

/// Five words stand before the payload: magic, version, key, bytes of the payload, its checksum.
inline constexpr std::size_t storage_header_bytes = 40;

[[nodiscard]] inline std::uint64_t storage_checksum(std::span<const std::byte> bytes) {
  ContentHash hash;
  hash.add_bytes(bytes.data(), bytes.size());
  return hash.value();
}

/// Numbers and arrays of them one after the other, under a header that tells damaged or foreign bytes.
class StorageWriter {
 public:
  StorageWriter(const StorageKind& kind, std::uint64_t key, std::size_t expected_bytes) {
    out_.reserve(expected_bytes);
    for (std::uint64_t word : {kind.magic, kind.version, key, std::uint64_t{0}, std::uint64_t{0}})
      value(word);
  }
  template <typename T>
  void value(const T& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* bytes = reinterpret_cast<const std::byte*>(&v);
    out_.insert(out_.end(), bytes, bytes + sizeof(T));
  }
  template <typename T>
  void values(const std::vector<T>& v) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(static_cast<std::uint64_t>(v.size()));
    const auto* bytes = reinterpret_cast<const std::byte*>(v.data());
    out_.insert(out_.end(), bytes, bytes + v.size() * sizeof(T));
  }
  void vector(const Eigen::Vector3d& v) {
    for (int k = 0; k < 3; ++k) value(v[k]);
  }
  /// The bytes, with length and checksum filled in.
  [[nodiscard]] std::vector<std::byte> seal() {
    const std::span<const std::byte> payload = std::span(out_).subspan(storage_header_bytes);
    const std::uint64_t tail[2] = {payload.size(), storage_checksum(payload)};
    std::memcpy(out_.data() + 24, tail, sizeof tail);
    return std::move(out_);
  }

 private:
  std::vector<std::byte> out_;
};

/// Reads what StorageWriter wrote; any other bytes end in InputError, and nothing is allocated by a count that
/// the bytes do not hold.
class StorageReader {
 public:
  StorageReader(std::span<const std::byte> bytes, const StorageKind& kind, std::uint64_t expected_key,
                std::string label)
      : bytes_(bytes.first(std::min(bytes.size(), storage_header_bytes))),
        kind_(kind),
        label_(std::move(label)) {
    if (value<std::uint64_t>() != kind.magic) fail("it does not begin as one");
    if (value<std::uint64_t>() != kind.version) fail("its format is of another version");
    if (value<std::uint64_t>() != expected_key) fail(kind.foreign);
    const auto size = value<std::uint64_t>();
    const auto sum = value<std::uint64_t>();
    bytes_ = bytes.subspan(storage_header_bytes);
    at_ = 0;
    if (size != bytes_.size()) fail("its length is wrong");
    if (sum != storage_checksum(bytes_)) fail("its checksum is wrong");
  }
  template <typename T>
  T value() {
    static_assert(std::is_trivially_copyable_v<T>);
    T v{};
    take(&v, sizeof(T));
    return v;
  }
  template <typename T>
  std::vector<T> values() {
    const std::size_t count = size_of_array(sizeof(T));
    std::vector<T> v(count);
    if (!v.empty()) take(v.data(), v.size() * sizeof(T));
    return v;
  }
  /// The length of an array whose elements take at least `element_bytes` each.
  std::size_t size_of_array(std::size_t element_bytes) {
    const auto count = value<std::uint64_t>();
    if (count > (bytes_.size() - at_) / element_bytes) fail("an array is longer than the file");
    return static_cast<std::size_t>(count);
  }
  Eigen::Vector3d vector() {
    Eigen::Vector3d v;
    for (int k = 0; k < 3; ++k) v[k] = value<double>();
    return v;
  }
  void expect_end() const {
    if (at_ != bytes_.size()) fail("it is too long");
  }
  [[noreturn]] void fail(const std::string& why) const { fail(kind_, label_, why); }
  [[noreturn]] static void fail(const StorageKind& kind, const std::string& label, const std::string& why) {
    throw base::InputError(label + ": " + kind.what + " is unusable: " + why +
                           "; must be written by this version");
  }

 private:
  void take(void* to, std::size_t size) {
    if (size > bytes_.size() - at_) fail("it ends early");
    std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  std::span<const std::byte> bytes_;
  StorageKind kind_;
  std::string label_;
  std::size_t at_ = 0;
};

}  // namespace endowire::vessel
