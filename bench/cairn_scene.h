#pragma once
// A benchmark's scene in Cairn's own words.

#include "cairn/cairn.h"
#include "scene.h"

namespace cairn::bench {

/// At the library's defaults but for what the scene says.
WorldSettings describe_world(const BenchScene& scene);
BodyDef describe_body(const BenchScene& scene, const SceneBody& body);

}  // namespace cairn::bench
