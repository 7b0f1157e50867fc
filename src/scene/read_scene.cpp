// A scene file's text to a Scene.
//
// Reads: JSON text. Writes: a Scene, or an Error of one line. The first fault that is found ends
// the reading; exceptions of the JSON library and Faults end here.

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <new>

#include "scene/read_bodies.h"

namespace cairn::scene {

namespace {

template <class Value>
struct Word {
    std::string_view word;
    Value value;
};

constexpr Word<Solver> solver_words[] = {{"soft-step", Solver::SoftStep},
                                         {"sequential-impulse", Solver::SequentialImpulse},
                                         {"xpbd", Solver::Xpbd}};
constexpr Word<NarrowPhase> narrow_phase_words[] = {{"sat", NarrowPhase::Sat},
                                                    {"gjk-epa", NarrowPhase::GjkEpa}};
constexpr Word<BroadPhase> broad_phase_words[] = {{"tree", BroadPhase::Tree},
                                                  {"brute-force", BroadPhase::BruteForce}};
constexpr std::string_view later_words[] = {"avbd"};

template <class Value, std::size_t N>
std::string_view find_word(const Word<Value> (&words)[N], Value value) {
    for (const auto& entry : words) {
        if (entry.value == value) return entry.word;
    }
    return {};
}

template <class Value, std::size_t N>
Result<Value> parse_word(const Word<Value> (&words)[N], std::string_view word, const char* later) {
    std::vector<std::string_view> allowed;
    for (const auto& entry : words) {
        if (entry.word == word) return entry.value;
        allowed.push_back(entry.word);
    }
    if (std::find(std::begin(later_words), std::end(later_words), word) != std::end(later_words) &&
        std::string_view(later).find(word) != std::string_view::npos) {
        return Error{ErrorCode::NotSupported,
                     fmt::format("\"{}\" is not yet supported by this version; supported: {}", word,
                                 list_words(allowed))};
    }
    const std::string_view near = find_nearest(word, allowed);
    return Error{ErrorCode::OutOfRange,
                 fmt::format("found \"{}\"{}; allowed: {}", make_printable(word),
                             near.empty() ? "" : fmt::format(", did you mean \"{}\"?", near),
                             list_words(allowed))};
}

template <class Value>
void read_word(const Fields& fields, std::string_view key, Result<Value> (*parse)(std::string_view),
               Value& out) {
    const JsonValue* value = fields.find(key);
    if (value == nullptr) return;
    const Place at = fields.place(key);
    Result<Value> parsed = parse(read_string(*value, at));
    if (!parsed) at.fail(parsed.error().message);
    out = *parsed;
}

void read_world(const JsonValue& value, const Place& at, Scene& scene) {
    static constexpr std::string_view keys[] = {"gravity", "sleeping", "sleep_time", "continuous",
                                                "restitution_threshold"};
    const Fields fields(value, at, keys);
    fields.read("gravity", scene.world.gravity);
    fields.read("sleeping", scene.world.sleeping);
    fields.read("sleep_time", scene.world.sleep_time, positive);
    fields.read("continuous", scene.continuous);
    fields.read("restitution_threshold", scene.world.restitution_threshold, not_negative);
}

void read_step(const JsonValue& value, const Place& at, Scene& scene) {
    static constexpr std::string_view keys[] = {"dt",         "solver",       "substeps",
                                                "iterations", "narrow_phase", "broad_phase"};
    const Fields fields(value, at, keys);
    constexpr Range dt_range = {min_dt, max_dt, false, "seconds from 1e-9 to 100"};
    fields.read("dt", scene.dt, dt_range);
    StepSettings& step = scene.world.step;
    read_word(fields, "solver", parse_solver, step.solver);
    read_word(fields, "narrow_phase", parse_narrow_phase, step.narrow_phase);
    read_word(fields, "broad_phase", parse_broad_phase, step.broad_phase);
    if (const JsonValue* substeps = fields.find("substeps")) {
        step.substeps =
            static_cast<int>(read_integer(*substeps, fields.place("substeps"), 1, 1000));
    }
    if (const JsonValue* iterations = fields.find("iterations")) {
        step.iterations =
            static_cast<int>(read_integer(*iterations, fields.place("iterations"), 1, 1000));
    }
}

void read_materials(const JsonValue& value, const Place& at, Scene& scene) {
    if (value.kind != JsonValue::Kind::Object) {
        at.fail(fmt::format("found {}; allowed: an object of materials by name", describe(value)));
    }
    for (std::size_t i = 0; i < value.keys.size(); ++i) {
        // The place keeps a view: both must outlive it.
        const std::string_view key = value.keys[i];
        const Place material_at = {&at, key.empty() ? "\"\"" : key, 0};
        if (key.empty()) {
            material_at.fail(
                "found a material named \"\"; allowed: a name of at least one character");
        }
        const Fields fields(value.items[i], material_at, material_keys);
        scene.materials.push_back({value.keys[i], read_material_fields(fields)});
    }
}

// The number in "body[3]" or a copy's "[1,0,2]": -1 where the text is not a plain whole number.
std::int64_t parse_index(std::string_view digits) {
    if (digits.empty() || digits.size() > 8) return -1;
    if (digits.size() > 1 && digits[0] == '0') return -1;
    std::int64_t number = 0;
    for (const char c : digits) {
        if (c < '0' || c > '9') return -1;
        number = number * 10 + (c - '0');
    }
    return number;
}

// Who, if anyone, is called `name` because of a repeat or for want of a name of its own.
class ImpliedNames {
public:
    void add(const SceneBody& body, std::size_t entry) {
        const std::int64_t copies =
            body.repeat ? body.repeat->count[0] * body.repeat->count[1] * body.repeat->count[2] : 1;
        if (body.name.empty()) {
            unnamed_.push_back({next_, next_ + copies, entry});
        } else if (body.repeat) {
            repeats_.emplace(body.name, std::pair(body.repeat->count, entry));
        }
        next_ += copies;
    }

    // The entry, or -1.
    std::int64_t find(std::string_view name) const {
        const std::size_t open = name.rfind('[');
        if (open == std::string_view::npos || name.back() != ']') return -1;
        const std::string_view stem = name.substr(0, open);
        const std::string_view inside = name.substr(open + 1, name.size() - open - 2);
        if (const auto repeat = repeats_.find(std::string(stem)); repeat != repeats_.end()) {
            if (is_copy(inside, repeat->second.first)) {
                return static_cast<std::int64_t>(repeat->second.second);
            }
        }
        const std::int64_t index = stem == "body" ? parse_index(inside) : -1;
        for (const Run& run : unnamed_) {
            if (index >= run.first && index < run.last) return static_cast<std::int64_t>(run.entry);
        }
        return -1;
    }

private:
    struct Run {
        std::int64_t first, last;
        std::size_t entry;
    };
    static bool is_copy(std::string_view inside, const std::array<std::int64_t, 3>& count) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t comma = axis < 2 ? inside.find(',') : inside.size();
            if (comma == std::string_view::npos) return false;
            const std::int64_t index = parse_index(inside.substr(0, comma));
            if (index < 0 || index >= count[axis]) return false;
            inside.remove_prefix(std::min(inside.size(), comma + 1));
        }
        return true;
    }
    std::vector<Run> unnamed_;
    std::map<std::string, std::pair<std::array<std::int64_t, 3>, std::size_t>> repeats_;
    std::int64_t next_ = 0;
};

// Names are unique after repeats are written out and the unnamed are named.
void check_names(const Scene& scene, const Place& bodies_at) {
    ImpliedNames implied;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) implied.add(scene.bodies[i], i);
    // A body and a repeat may share a name, for copies carry their indices behind it.
    std::map<std::pair<std::string_view, bool>, std::size_t> seen;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const SceneBody& body = scene.bodies[i];
        if (body.name.empty()) continue;
        const Place entry_at = {&bodies_at, {}, i};
        const Place body_at = {&entry_at, "body", 0};
        const Place name_at = {body.repeat ? &body_at : &entry_at, "name", 0};
        const auto [twin, is_new] =
            seen.emplace(std::pair(std::string_view(body.name), body.repeat.has_value()), i);
        std::int64_t other = is_new ? -1 : static_cast<std::int64_t>(twin->second);
        if (other < 0 && !body.repeat) other = implied.find(body.name);
        if (other >= 0) {
            name_at.fail(
                fmt::format("found \"{}\", a name that bodies[{}] has already; allowed: names "
                            "that are unique",
                            make_printable(body.name), other));
        }
    }
}

void read_bodies(const JsonValue& value, const Place& at, Scene& scene) {
    read_array(value, at, "an array of bodies");
    std::int64_t total = 0;
    for (std::size_t i = 0; i < value.items.size(); ++i) {
        const Place entry_at = {&at, {}, i};
        scene.bodies.push_back(read_body_entry(value.items[i], entry_at, scene.materials));
        const auto& repeat = scene.bodies.back().repeat;
        total += repeat ? repeat->count[0] * repeat->count[1] * repeat->count[2] : 1;
        if (total > max_bodies) {
            entry_at.fail(
                fmt::format("found more than {} bodies up to here; allowed: at most {} in a "
                            "scene, copies included",
                            max_bodies, max_bodies));
        }
    }
    check_names(scene, at);
}

void refuse_joints(const JsonValue& value, const Place& at) {
    read_array(value, at, "an array of joints");
    if (value.items.empty()) return;
    const Place joint_at = {&at, {}, 0};
    const JsonValue& joint = value.items[0];
    const auto key = std::find(joint.keys.begin(), joint.keys.end(), "kind");
    if (joint.kind != JsonValue::Kind::Object || key == joint.keys.end()) {
        joint_at.fail(
            fmt::format("found {}; allowed: no joints, which this version does not yet support",
                        describe(joint)));
    }
    const JsonValue& kind = joint.items[static_cast<std::size_t>(key - joint.keys.begin())];
    const Place kind_at = {&joint_at, "kind", 0};
    kind_at.fail(
        fmt::format("the joint {} is not yet supported by this version; supported: no joints "
                    "at all",
                    describe(kind)));
}

void read_camera(const JsonValue& value, const Place& at, Scene& scene) {
    static constexpr std::string_view keys[] = {"eye", "target"};
    const Fields fields(value, at, keys);
    fields.read("eye", scene.camera.eye);
    fields.read("target", scene.camera.target);
    if (scene.camera.eye == scene.camera.target) {
        at.fail("found eye and target at one point; allowed: two points");
    }
}

void check_version(const JsonValue& root, const Place& at) {
    const Place version_at = {&at, "cairn", 0};
    if (root.kind != JsonValue::Kind::Object) {
        at.fail(
            fmt::format("found {}; allowed: a scene, an object with \"cairn\": 1", describe(root)));
    }
    const auto key = std::find(root.keys.begin(), root.keys.end(), "cairn");
    if (key == root.keys.end()) {
        version_at.fail("missing; the key \"cairn\" is required: the format's version, 1");
    }
    const JsonValue& version = root.items[static_cast<std::size_t>(key - root.keys.begin())];
    if (version.kind != JsonValue::Kind::Number || version.number != 1) {
        version_at.fail(
            fmt::format("found {}; allowed: 1, the version of the format that this program "
                        "reads",
                        describe(version)));
    }
}

Scene read_root(const JsonValue& root) {
    static constexpr std::string_view keys[] = {"cairn",  "name",  "description", "duration",
                                                "world",  "step",  "materials",   "bodies",
                                                "joints", "camera"};
    const Place at;
    check_version(root, at);
    const Fields fields(root, at, keys);
    Scene scene;
    fields.read("name", scene.name);
    fields.read("description", scene.description);
    fields.read("duration", scene.duration, not_negative);
    if (const auto* world = fields.find("world")) read_world(*world, fields.place("world"), scene);
    if (const auto* step = fields.find("step")) read_step(*step, fields.place("step"), scene);
    if (const auto* materials = fields.find("materials")) {
        read_materials(*materials, fields.place("materials"), scene);
    }
    if (const auto* bodies = fields.find("bodies"))
        read_bodies(*bodies, fields.place("bodies"), scene);
    if (const auto* joints = fields.find("joints")) refuse_joints(*joints, fields.place("joints"));
    if (const auto* camera = fields.find("camera"))
        read_camera(*camera, fields.place("camera"), scene);
    return scene;
}

}  // namespace

std::string_view solver_name(Solver solver) { return find_word(solver_words, solver); }
std::string_view narrow_phase_name(NarrowPhase phase) {
    return find_word(narrow_phase_words, phase);
}
std::string_view broad_phase_name(BroadPhase phase) { return find_word(broad_phase_words, phase); }
Result<Solver> parse_solver(std::string_view word) {
    return parse_word(solver_words, word, "avbd");
}
Result<NarrowPhase> parse_narrow_phase(std::string_view word) {
    return parse_word(narrow_phase_words, word, "");
}
Result<BroadPhase> parse_broad_phase(std::string_view word) {
    return parse_word(broad_phase_words, word, "");
}

Result<Scene> read_scene(std::string_view text) {
    try {
        return read_root(parse_json(text));
    } catch (const Fault& fault) {
        return Error{ErrorCode::OutOfRange, fault.path.empty()
                                                ? fault.message
                                                : fmt::format("{}: {}", fault.path, fault.message)};
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::OutOfRange, "the scene does not fit into memory"};
    } catch (const std::exception& error) {
        return Error{ErrorCode::OutOfRange, fmt::format("not valid JSON: {}", error.what())};
    }
}

Result<Scene> read_scene_file(const std::string& path) {
    const bool is_standard_input = path == "-";
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
        is_standard_input ? stdin : std::fopen(path.c_str(), "rb"),
        is_standard_input ? +[](std::FILE*) { return 0; } : &std::fclose);
    if (!file) {
        return Error{ErrorCode::OutOfRange,
                     fmt::format("cannot open it: {}", std::strerror(errno))};
    }
    std::string text;
    std::vector<char> block(1 << 16);
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get())) {
        if (text.size() + count > max_scene_bytes) {
            return Error{
                ErrorCode::OutOfRange,
                fmt::format("the file is longer than {} bytes; allowed: shorter ones, grids of "
                            "bodies by \"repeat\"",
                            max_scene_bytes)};
        }
        text.append(block.data(), count);
    }
    if (std::ferror(file.get()) != 0) {
        return Error{ErrorCode::OutOfRange,
                     fmt::format("cannot read it: {}", std::strerror(errno))};
    }
    return read_scene(text);
}

}  // namespace cairn::scene
