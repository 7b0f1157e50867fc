#pragma once

namespace cairn {

/// "MAJOR.MINOR.PATCH" of the library in use.
const char* version();

}  // namespace cairn
