// The passes of the soft step, one row after the other: the scalar build.

#include "solver/soft_step/soft_passes.h"

namespace cairn {

extern const SoftKernels soft_kernels_1;
const SoftKernels soft_kernels_1 = make_soft_kernels<1>();

}  // namespace cairn
