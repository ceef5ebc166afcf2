#pragma once

#include <cstring>
#include <type_traits>

namespace endowire::base {

/// The bits of one type read as another of equal size: std::bit_cast, which the library of Emscripten 3.1.6
/// lacks.
template <class To, class From>
[[nodiscard]] To bits_as(const From& from) {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> &&
                std::is_trivially_copyable_v<From>);
  To to;
  std::memcpy(&to, &from, sizeof(To));
  return to;
}

}  // namespace endowire::base
