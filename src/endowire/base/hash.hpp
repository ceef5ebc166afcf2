#pragma once

#include <cstdint>

#include "endowire/base/bits.hpp"

namespace endowire::base {

/// 64-bit FNV-1a over the bits of numbers: says whether two states are the same, to the last bit.
class Hash {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) {
      value_ ^= (word >> (8 * byte)) & 0xffU;
      value_ *= 0x100000001b3ULL;
    }
  }
  void add(double number) { add(base::bits_as<std::uint64_t>(number)); }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace endowire::base
