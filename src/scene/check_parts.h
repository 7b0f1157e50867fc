#pragma once
// What the doctor's examinations share.

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "scene/check.h"

namespace cairn::scene {

inline double widen(float number) { return static_cast<double>(number); }
double find_length(const Vec3& v);

/// How large a body is, m.
struct Extent {
    double least = std::numeric_limits<double>::infinity();  ///< its thinnest shape's thinnest side
    double most = 0;                                         ///< its largest shape's diameter
    double reach = 0;  ///< of any point from the body's origin
};
Extent measure(const BodyDef& def);

/// Collects findings; the first few of a kind in full, of the rest how many there are.
class Findings {
public:
    void add(const char* kind, std::string where, std::string what, std::string cure);
    std::vector<Finding> take();

private:
    static constexpr std::size_t told_in_full = 4;
    std::map<std::string, std::size_t> counts_;
    std::vector<Finding> list_;
    std::vector<std::string> kinds_;
};

void check_world(const Scene& scene, Findings& findings);
void check_bodies(const Scene& scene, Findings& findings);
/// What touches, overlaps, carries or falls at the first instant.
void check_placement(const Scene& scene, const BuiltWorld& built, Findings& findings);

}  // namespace cairn::scene
