#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "endowire/base/bits.hpp"

namespace endowire::vessel {

/// FNV-1a over 64-bit words with a final shift per word: guards caches against accident, not against attack.
class ContentHash {
 public:
  void add(std::uint64_t word) {
    state_ = (state_ ^ word) * 1099511628211ULL;
    state_ ^= state_ >> 29;
  }
  void add(double value) { add(base::bits_as<std::uint64_t>(value)); }
  void add_bytes(const std::byte* data, std::size_t size) {
    add(static_cast<std::uint64_t>(size));
    std::size_t i = 0;
    for (; i + 8 <= size; i += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, data + i, 8);
      add(word);
    }
    if (i < size) {
      std::uint64_t word = 0;
      std::memcpy(&word, data + i, size - i);
      add(word);
    }
  }
  [[nodiscard]] std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 14695981039346656037ULL;
};

}  // namespace endowire::vessel
