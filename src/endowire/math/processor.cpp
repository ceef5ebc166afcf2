#include "endowire/math/processor.hpp"

#include <cstdlib>
#include <string_view>

#include "endowire/math/four.hpp"

namespace endowire::math {

bool runs_avx2() {
#if ENDOWIRE_WIDE_KERNELS
  static const bool chosen = [] {
    const char* wanted = std::getenv("ENDOWIRE_ISA");
    if (wanted != nullptr && std::string_view(wanted) != "avx2") return false;
    return __builtin_cpu_supports("avx2") != 0;
  }();
  return chosen;
#else
  return false;
#endif
}

}  // namespace endowire::math
