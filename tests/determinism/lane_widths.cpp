// Asks the library's own choice; see lane_widths.h. Apart from the scenes, because the kernels'
// headers and the public arithmetic are not for one file.

#include "determinism/lane_widths.h"

#include "solver/soft_step/soft_kernels.h"

namespace cairn::test {

bool has_lane_width(int width) { return width == 0 || find_soft_kernels(width).width == width; }

}  // namespace cairn::test
