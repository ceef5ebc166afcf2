#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace endowire::io {

/// Base 64 (RFC 4648), with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

/// The values' own bytes: little-endian on every machine that this builds for.
template <class Value>
[[nodiscard]] std::string base64(const std::vector<Value>& values) {
  return base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)});
}

}  // namespace endowire::io
