// The table of built-in scenes, and how a person sets their parameters.

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "scene/builtin_parts.h"
#include "scene/fields.h"

namespace cairn::scene {

namespace {

constexpr Parameter drop_parameters[] = {
    {"height", 4, 0.1, 1000, false, "metres from the floor to the lowest body's centre"}};
constexpr Parameter bounce_parameters[] = {
    {"height", 3, 0.1, 1000, false, "metres that each ball falls"}};
constexpr Parameter incline_parameters[] = {{"degrees", 20, 0, 60, false, "slope of the ramp"}};
constexpr Parameter roll_parameters[] = {
    {"speed", 5, 0.1, 50, false, "first speed of every ball, m/s"}};
constexpr Parameter conveyor_parameters[] = {
    {"speed", 1.5, 0, 10, false, "of the belts, m/s"},
    {"count", 12, 1, 200, true, "parcels that fall on the highest belt"}};
constexpr Parameter pyramid_parameters[] = {{"base", 20, 1, 200, true, "boxes in the lowest row"}};
constexpr Parameter tower_parameters[] = {
    {"height", 10, 1, 200, true, "boxes in the tower"},
    {"top", 1, 0.001, 10000, false, "how many times as dense the top box is"}};
constexpr Parameter dominoes_parameters[] = {
    {"count", 40, 2, 2000, true, "dominoes"},
    {"spacing", 0.05, 0.03, 0.15, false, "metres from centre to centre"}};
constexpr Parameter card_house_parameters[] = {{"storeys", 5, 1, 12, true, "storeys of cards"}};
constexpr Parameter mass_ratio_parameters[] = {
    {"ratio", 100, 1, 100000, false, "how many times as dense the upper cube is"}};
constexpr Parameter pit_parameters[] = {
    {"count", 300, 1, 100000, true, "bodies, boxes and spheres by turns"},
    {"seed", 1, 0, 1000000, true, "of the random sizes and turns"}};
constexpr Parameter logs_parameters[] = {
    {"base", 8, 1, 100, true, "logs in the lowest row"},
    {"posts", 1, 0, 1, true, "1: four posts beside the lowest row; 0: none"},
    {"friction", 0.6, 0, 2, false, "of the logs and the ground"}};
constexpr Parameter billiards_parameters[] = {
    {"speed", 8, 0.1, 30, false, "of the cue ball, m/s"},
    {"cushions", 1, 0, 1, true, "1: a table with cushions; 0: none, the balls fly on"}};
constexpr Parameter cradle_parameters[] = {
    {"balls", 5, 2, 50, true, "balls in the row"},
    {"moving", 1, 1, 49, true, "balls that strike it, fewer than there are balls"}};
constexpr Parameter t_handle_parameters[] = {
    {"spin", 6, 0.1, 60, false, "rad/s about the stem, the axis of the middle moment"}};
constexpr Parameter showcase_parameters[] = {
    {"base", 9, 1, 20, true, "stones in the lowest row of each pyramid"}};

constexpr Builtin table[] = {
    {"showcase", "growing dominoes set a ball rolling that runs into a row of pyramids",
     "after the bend each domino is 9% larger than the one before: the first push is a finger's, "
     "the last a "
     "wrecker's",
     showcase_parameters, make_showcase},
    {"drop", "a box, a ball and a bar fall on the floor",
     "the box lands on a corner and comes to rest on a face; nothing trembles afterwards",
     drop_parameters, make_drop},
    {"bounce", "six balls of restitution 0 to 1 fall side by side",
     "each rises to e^2 of the height before; the last neither gains nor loses", bounce_parameters,
     make_bounce},
    {"incline", "five blocks of friction 0.1 to 0.5 on one ramp",
     "a block slides if tan(slope) exceeds its friction, with a = g (sin - mu cos), and stays if "
     "not",
     incline_parameters, make_incline},
    {"roll", "balls of different friction start sliding and end rolling",
     "rough or smooth, each ends at 5/7 of its first speed; only how long that takes differs",
     roll_parameters, make_roll},
    {"conveyor", "parcels ride three belts, down a level at each end",
     "parcels take on the belt's speed in v / (mu g) seconds and turn about with each level",
     conveyor_parameters, make_conveyor},
    {"pyramid", "boxes stacked into a wall with a sloping outline",
     "the top box stays where it was put, and the rows do not creep apart", pyramid_parameters,
     make_pyramid},
    {"tower", "boxes on top of each other",
     "it stands; with a dense top, look at the deepest penetration", tower_parameters, make_tower},
    {"dominoes", "a row of dominoes, the first one pushed",
     "after a dozen dominoes the wave runs at a constant speed", dominoes_parameters,
     make_dominoes},
    {"card-house", "five storeys of cards that lean on each other",
     "friction alone holds it: the crown sinks a little and stays", card_house_parameters,
     make_card_house},
    {"mass-ratio", "a heavy cube on a light one, beside two equal ones",
     "how far the heavy cube sinks in, and that it does not topple", mass_ratio_parameters,
     make_mass_ratio},
    {"pit", "boxes and spheres pour into a walled pit",
     "the heap comes to rest and nothing escapes", pit_parameters, make_pit},
    {"logs", "a pile of logs between four posts",
     "it stays as it was put; without posts friction alone holds two rows, and higher piles roll "
     "apart",
     logs_parameters, make_logs},
    {"billiards", "a cue ball breaks a rack of fifteen",
     "the rack opens almost as its own mirror image; momentum holds until the first cushion",
     billiards_parameters, make_billiards},
    {"cradle", "a row of balls passes a blow from end to end and back, without gravity",
     "as many balls leave as have struck, at the same speed, and the rest stand still",
     cradle_parameters, make_cradle},
    {"t-handle", "a T-shaped handle spins in free flight",
     "it flips over and back for ever (the Dzhanibekov effect), and loses no energy by it",
     t_handle_parameters, make_t_handle},
};

Error explain(const Builtin& builtin, const std::string& problem) {
    std::string message = fmt::format("{}; the parameters of {} are: ", problem, builtin.name);
    bool is_first = true;
    for (const std::string& line : describe_parameters(builtin)) {
        message += (is_first ? "" : "; ") + line;
        is_first = false;
    }
    return {ErrorCode::OutOfRange, message};
}

}  // namespace

std::span<const Builtin> builtins() { return table; }

const Builtin* find_builtin(std::string_view name) {
    for (const Builtin& builtin : table) {
        if (name == builtin.name) return &builtin;
    }
    return nullptr;
}

std::string_view find_nearest_builtin(std::string_view name) {
    std::vector<std::string_view> names;
    for (const Builtin& builtin : table) names.push_back(builtin.name);
    return find_nearest(name, names);
}

std::vector<std::string> describe_parameters(const Builtin& builtin) {
    std::vector<std::string> lines;
    for (const Parameter& parameter : builtin.parameters) {
        lines.push_back(fmt::format("{}={} ({} to {}{}): {}", parameter.name, parameter.standard,
                                    parameter.least, parameter.most,
                                    parameter.is_whole ? ", whole" : "", parameter.meaning));
    }
    return lines;
}

Result<Scene> make_builtin(const Builtin& builtin, std::span<const std::string> settings) {
    std::vector<double> values;
    std::vector<std::string_view> names;
    for (const Parameter& parameter : builtin.parameters) {
        values.push_back(parameter.standard);
        names.push_back(parameter.name);
    }
    for (const std::string& setting : settings) {
        const std::string shown = make_printable(setting);
        const std::size_t equals = setting.find('=');
        if (equals == std::string::npos) {
            return explain(builtin,
                           fmt::format("--set {}: found no '='; allowed: key=value", shown));
        }
        const std::string key = setting.substr(0, equals);
        const std::size_t index =
            static_cast<std::size_t>(std::find(names.begin(), names.end(), key) - names.begin());
        if (index == names.size()) {
            const std::string_view near = find_nearest(key, names);
            return explain(
                builtin,
                fmt::format("--set {}: no parameter \"{}\"{}", shown, make_printable(key),
                            near.empty() ? "" : fmt::format(", did you mean \"{}\"?", near)));
        }
        const Parameter& parameter = builtin.parameters[index];
        double value = 0;
        const char* const end = setting.data() + setting.size();
        const auto parsed = std::from_chars(setting.data() + equals + 1, end, value);
        if (parsed.ec != std::errc{} || parsed.ptr != end || !(value >= parameter.least) ||
            !(value <= parameter.most) || (parameter.is_whole && value != std::floor(value))) {
            return explain(builtin, fmt::format("--set {}: not a {}number from {} to {}", shown,
                                                parameter.is_whole ? "whole " : "", parameter.least,
                                                parameter.most));
        }
        values[index] = value;
    }
    if (std::string_view(builtin.name) == "cradle" && values[1] >= values[0]) {
        return explain(builtin, "moving must be less than balls");
    }
    return builtin.make(values);
}

}  // namespace cairn::scene
