// The doctor, see check.h: collects what the examinations find.

#include "scene/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/check_parts.h"

namespace cairn::scene {

double find_length(const Vec3& v) {
    return std::sqrt(widen(v.x) * widen(v.x) + widen(v.y) * widen(v.y) + widen(v.z) * widen(v.z));
}

Extent measure(const BodyDef& def) {
    Extent extent;
    for (const ShapeDef& shape : def.shapes) {
        double least = 0, most = 0;
        if (const auto* sphere = std::get_if<Sphere>(&shape.geometry)) {
            least = most = 2 * widen(sphere->radius);
        } else if (const auto* box = std::get_if<Box>(&shape.geometry)) {
            const Vec3& half = box->half_extents;
            least = 2 * widen(std::min({half.x, half.y, half.z}));
            most = 2 * find_length(half);
        } else if (const auto* capsule = std::get_if<Capsule>(&shape.geometry)) {
            least = 2 * widen(capsule->radius);
            most = least + widen(capsule->height);
        } else {
            continue;
        }
        extent.least = std::min(extent.least, least);
        extent.most = std::max(extent.most, most);
        extent.reach = std::max(extent.reach, find_length(shape.local_pose.position) + most / 2);
    }
    return extent;
}

void Findings::add(const char* kind, std::string where, std::string what, std::string cure) {
    if (++counts_[kind] > told_in_full) return;
    list_.push_back({std::move(where), std::move(what), std::move(cure)});
    kinds_.push_back(kind);
}

std::vector<Finding> Findings::take() {
    // The last one that is told of a kind says how many are not.
    for (std::size_t i = list_.size(); i-- > 0;) {
        std::size_t& count = counts_[kinds_[i]];
        if (count <= told_in_full) continue;
        list_[i].what += fmt::format(" (and {} more like this)", count - told_in_full);
        count = 0;
    }
    return std::move(list_);
}

Result<std::vector<Finding>> find_misbehaviour(const Scene& scene) {
    const Result<BuiltWorld> built = build_world(scene);
    if (!built) return built.error();
    Findings findings;
    check_world(scene, findings);
    check_bodies(scene, findings);
    check_placement(scene, *built, findings);
    return findings.take();
}

}  // namespace cairn::scene
