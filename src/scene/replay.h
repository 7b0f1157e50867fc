#pragma once
// The replay: a run of a world, sampled and quantised, and the self-contained HTML page that plays
// it.
//
// A page opens straight from disk with no network: the player, its styles, three.js and the
// recording are all inside. The recording thins itself out as it grows, so that the page stays
// under 30 MB whatever the scene.

#include <memory>
#include <string>
#include <vector>

#include "cairn/cairn.h"

namespace cairn::scene {

struct Camera {
    Vec3 eye = {8, 5, 8};
    Vec3 target = {0, 1, 0};
};

struct ReplayInfo {
    std::string scene;  // the scene's name
    std::string description;
    std::vector<std::string>
        body_names;        // in the order of World::bodies() when the recording begins
    std::string settings;  // one line: solver, substeps, iterations, narrow phase, dt
    double dt = 1.0 / 60;
    std::size_t step_count = 0;  // how many steps the run will take
    Camera camera;
};

class ReplayRecorder {
public:
    // Notes the bodies, their shapes and their first poses.
    ReplayRecorder(const World& world, ReplayInfo info);
    ~ReplayRecorder();
    // To be called after every step; what is kept of it, the recorder decides.
    void record(const World& world);
    // Writes the page; an error names the path and what went wrong.
    Status write(const std::string& path) const;

private:
    struct Recording;
    std::unique_ptr<Recording> recording_;
};

}  // namespace cairn::scene
