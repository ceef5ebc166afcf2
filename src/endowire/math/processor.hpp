#pragma once

namespace endowire::math {

/// Whether kernels may use AVX2: this processor has it, and the environment variable ENDOWIRE_ISA, read once, does not ask for another
/// instruction set ("sse2"; results are the same bits). Never on processors that are not x86-64.
[[nodiscard]] bool runs_avx2();

}  // namespace endowire::math
