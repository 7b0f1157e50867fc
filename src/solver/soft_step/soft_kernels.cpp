// Which width this machine runs; see soft_kernels.h.

#include "solver/soft_step/soft_kernels.h"

namespace cairn {

// Each in a file of its own, compiled for what it needs.
extern const SoftKernels soft_kernels_1;
extern const SoftKernels soft_kernels_4;
#if defined(CAIRN_WIDE_LANES)
extern const SoftKernels soft_kernels_8;
extern const SoftKernels soft_kernels_16;
#endif

const SoftKernels& find_soft_kernels(int most) {
    if (most == 0) most = 16;
#if defined(CAIRN_WIDE_LANES)
    static const bool has_16 = __builtin_cpu_supports("avx512f") != 0;
    static const bool has_8 = __builtin_cpu_supports("avx2") != 0;
    if (most >= 16 && has_16) return soft_kernels_16;
    if (most >= 8 && has_8) return soft_kernels_8;
#endif
    return most >= 4 ? soft_kernels_4 : soft_kernels_1;
}

}  // namespace cairn
