// The passes of the soft step, 4 rows side by side.

#include "solver/soft_step/soft_passes.h"

namespace cairn {

extern const SoftKernels soft_kernels_4;
const SoftKernels soft_kernels_4 = make_soft_kernels<4>();

}  // namespace cairn
