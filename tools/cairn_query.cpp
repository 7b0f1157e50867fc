// `cairn query`: reads the questions, takes the steps, asks, and prints the answers as one JSON
// document. Nothing is printed on standard output where a question makes no sense.

#include "cairn_query.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "cairn_run.h"
#include "cairn_terminal.h"
#include "scene/json_tree.h"
#include "scene/json_writer.h"

namespace cairn::tool {

namespace {

using scene::BuiltWorld;
using scene::JsonWriter;
using scene::Layout;
using Numbers = std::vector<double>;

// "1,2.5,-3" as so many numbers, or as one of two counts.
Result<Numbers> read_numbers(const char* flag, const std::string& text, std::size_t count,
                             std::size_t or_count, const char* allowed) {
    const Error refusal{ErrorCode::OutOfRange,
                        fmt::format("{}: found \"{}\"; allowed: {}", flag,
                                    scene::make_printable(text, 200), allowed)};
    Numbers numbers;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
        double number = 0;
        const auto read = std::from_chars(at, end, number);
        if (read.ec != std::errc()) return refusal;
        numbers.push_back(number);
        if (read.ptr == end) break;
        if (*read.ptr != ',') return refusal;
        at = read.ptr + 1;
    }
    if (numbers.size() != count && numbers.size() != or_count) return refusal;
    return numbers;
}

Position position_from(const Numbers& n, std::size_t first) {
    return {n[first], n[first + 1], n[first + 2]};
}

// Asks a world, and keeps what it answers and what it refuses.
class Questioner {
public:
    explicit Questioner(BuiltWorld& built) : world_(built.world), names_(built.names) {
        bodies_ = world_.bodies();
        built.world.set_error_handler([this](const Error& error) { refusal_ = error.message; });
    }

    Status ask_ray(const std::string& text, bool all, JsonWriter& json) {
        const Result<Numbers> numbers =
            read_numbers("--ray", text, 6, 7, "ox,oy,oz,dx,dy,dz or ox,oy,oz,dx,dy,dz,length");
        if (!numbers) return numbers.error();
        const Numbers& n = *numbers;
        Ray ray{position_from(n, 0),
                {static_cast<float>(n[3]), static_cast<float>(n[4]), static_cast<float>(n[5])}};
        if (n.size() == 7) ray.length = n[6];
        std::vector<RayHit> hits;
        if (all) {
            hits = world_.all_hits(ray);
        } else if (const RayHit hit = world_.cast_ray(ray)) {
            hits.push_back(hit);
        }
        if (!refusal_.empty()) return refuse("--ray", text);
        json.begin_object().member("origin", ray.origin).member("direction", ray.direction);
        json.member("length", ray.length).key("hits").begin_array();
        for (const RayHit& hit : hits) {
            json.begin_object(Layout::Inline);
            write_whose(hit.body, hit.shape, json);
            json.member("distance", hit.distance).member("point", hit.point);
            json.member("normal", hit.normal).member("inside", hit.inside).end();
        }
        json.end().end();
        return Done{};
    }

    Status ask_point(const std::string& text, JsonWriter& json) {
        const Result<Numbers> numbers = read_numbers("--point", text, 3, 4, "x,y,z or x,y,z,reach");
        if (!numbers) return numbers.error();
        const Position position = position_from(*numbers, 0);
        const NearestHit nearest = numbers->size() == 4
                                       ? world_.closest_point(position, (*numbers)[3])
                                       : world_.closest_point(position);
        if (!refusal_.empty()) return refuse("--point", text);
        json.begin_object().member("position", position).key("nearest");
        if (nearest) {
            json.begin_object(Layout::Inline);
            write_whose(nearest.body, nearest.shape, json);
            json.member("distance", nearest.distance).member("point", nearest.point);
            json.member("normal", nearest.normal).end();
        } else {
            json.value_verbatim("null");
        }
        json.end();
        return Done{};
    }

    Status ask_box(const std::string& text, JsonWriter& json) {
        const Result<Numbers> numbers =
            read_numbers("--box", text, 6, 6, "lx,ly,lz,ux,uy,uz, the lower and upper corner");
        if (!numbers) return numbers.error();
        const Bounds box{position_from(*numbers, 0), position_from(*numbers, 3)};
        const std::vector<BodyId> found = world_.bodies_in(box);
        if (!refusal_.empty()) return refuse("--box", text);
        json.begin_object().member("lower", box.lower).member("upper", box.upper);
        json.key("bodies").begin_array(Layout::Inline);
        for (const BodyId body : found) json.value(name_of(body));
        json.end().end();
        return Done{};
    }

private:
    Status refuse(const char* flag, const std::string& text) const {
        return Error{ErrorCode::OutOfRange,
                     fmt::format("{} {}: {}", flag, scene::make_printable(text, 200), refusal_)};
    }
    const std::string& name_of(BodyId body) const {
        const auto place = std::lower_bound(bodies_.begin(), bodies_.end(), body) - bodies_.begin();
        return names_[static_cast<std::size_t>(place)];
    }
    void write_whose(BodyId body, ShapeId shape, JsonWriter& json) const {
        const std::vector<ShapeId> shapes = world_.shapes(body);
        const auto place = std::find(shapes.begin(), shapes.end(), shape) - shapes.begin();
        json.member("body", name_of(body)).member("shape", static_cast<std::int64_t>(place));
    }

    const World& world_;
    const std::vector<std::string>& names_;
    std::vector<BodyId> bodies_;
    std::string refusal_;
};

Status ask_all(const QueryCommand& command, Questioner& questioner, JsonWriter& json) {
    const auto ask_each = [&](const char* key, const std::vector<std::string>& questions,
                              auto ask) -> Status {
        json.key(key).begin_array();
        for (const std::string& question : questions) {
            if (Status status = ask(question); !status) return status;
        }
        json.end();
        return Done{};
    };
    Status status = ask_each("rays", command.rays, [&](const std::string& text) {
        return questioner.ask_ray(text, command.all, json);
    });
    if (!status) return status;
    status = ask_each("points", command.points,
                      [&](const std::string& text) { return questioner.ask_point(text, json); });
    if (!status) return status;
    return ask_each("boxes", command.boxes,
                    [&](const std::string& text) { return questioner.ask_box(text, json); });
}

}  // namespace

int query(const QueryCommand& command) {
    if (command.rays.empty() && command.points.empty() && command.boxes.empty())
        return fail(bad_usage, "query: found no question; allowed: --ray, --point, --box");
    Result<scene::Scene> loaded = load_scene(command.scene, command.settings);
    if (!loaded) return fail(bad_usage, loaded.error().message);
    scene::RunOptions options;
    options.steps = command.steps;
    Result<scene::RunPlan> plan = scene::plan_run(std::move(loaded).value(), options);
    if (!plan) return fail(bad_usage, plan.error().message);
    Result<BuiltWorld> made = scene::build_world(plan->scene);
    if (!made) return fail(bad_usage, fmt::format("{}: {}", command.scene, made.error().message));
    BuiltWorld built = std::move(made).value();
    const Result<scene::RunRecord> record =
        scene::perform_run(built, *plan, [](const World&, std::uint64_t) { return true; });
    if (!record) return fail(went_wrong, record.error().message);

    built.world.prepare_questions();
    Questioner questioner(built);
    JsonWriter json;
    json.begin_object().member("cairn", version()).member("scene", plan->scene.name);
    json.member("time", static_cast<double>(plan->steps) * plan->scene.dt);
    if (const Status status = ask_all(command, questioner, json); !status)
        return fail(bad_usage, status.error().message);
    json.end();
    fmt::print("{}", json.take());
    return std::fflush(stdout) == 0 ? done : fail(went_wrong, "standard output cannot be written");
}

}  // namespace cairn::tool
