// The passes of the soft step, 16 rows side by side.

#include "solver/soft_step/soft_passes.h"

namespace cairn {

extern const SoftKernels soft_kernels_16;
const SoftKernels soft_kernels_16 = make_soft_kernels<16>();

}  // namespace cairn
