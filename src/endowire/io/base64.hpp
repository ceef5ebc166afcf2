#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace endowire::io {

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

/// The values' own bytes, little-endian on every machine this builds for.
template <class Value>
[[nodiscard]] std::string base64(const std::vector<Value>& values) {
  return base64(std::as_bytes(std::span(values)));
}

}  // namespace endowire::io
