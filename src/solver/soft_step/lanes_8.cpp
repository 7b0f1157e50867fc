// The passes of the soft step, 8 rows side by side.

#include "solver/soft_step/soft_passes.h"

namespace cairn {

extern const SoftKernels soft_kernels_8;
const SoftKernels soft_kernels_8 = make_soft_kernels<8>();

}  // namespace cairn
