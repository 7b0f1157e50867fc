// Every broken scene of the corpus is refused with one line that begins with the path of what is
// wrong and says what was found. Reads tests/corpus/expected.tsv: file, path, words.

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace {

using namespace cairn;

struct Broken {
    std::string file, path, words;
};

const std::string corpus = CAIRN_SOURCE_DIR "/tests/corpus/broken/";

std::vector<Broken> read_manifest() {
    std::vector<Broken> list;
    std::ifstream manifest(CAIRN_SOURCE_DIR "/tests/corpus/expected.tsv");
    for (std::string line; std::getline(manifest, line);) {
        const std::size_t first = line.find('\t'), second = line.find('\t', first + 1);
        list.push_back({line.substr(0, first), line.substr(first + 1, second - first - 1),
                        line.substr(second + 1)});
    }
    return list;
}

std::string read_bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("the corpus holds at least 200 broken scenes in at least 20 classes") {
    std::set<std::string> classes;
    const std::vector<Broken> list = read_manifest();
    for (const Broken& broken : list) classes.insert(broken.file.substr(0, broken.file.find('/')));
    CHECK(list.size() >= 200);
    CHECK(classes.size() >= 20);
}

TEST_CASE(
    "each broken scene is refused in one line, with the path, what was found and what is allowed") {
    for (const Broken& broken : read_manifest()) {
        CAPTURE(broken.file);
        const Result<scene::Scene> read = scene::read_scene(read_bytes(corpus + broken.file));
        REQUIRE_FALSE(read.ok());
        const std::string& message = read.error().message;
        CAPTURE(message);
        CHECK(message.find('\n') == std::string::npos);
        CHECK(message.size() < 700);
        const std::string start = broken.path.empty() ? "" : broken.path + ": ";
        CHECK(message.substr(0, start.size()) == start);
        CHECK(message.find(broken.words) != std::string::npos);
        // Nothing of it is loaded.
        CHECK(read->bodies.empty());
    }
}

TEST_CASE("a scene file that is a folder, or is not there, is refused") {
    CHECK_FALSE(scene::read_scene_file(corpus).ok());
    CHECK_FALSE(scene::read_scene_file(corpus + "no_such_file.json").ok());
}

TEST_CASE("every cut of a whole scene is refused and none ends the program") {
    const std::string whole = R"({"cairn": 1, "materials": {"ice": {"friction": 0.02}}, "bodies": [
        {"repeat": {"count": [2, 2, 2], "spacing": [1.5, 1.5, 1.5], "jitter": 0.1, "seed": 3},
         "body": {"name": "a", "rotation": {"axis": [0, 1, 0], "degrees": 30},
                  "shapes": [{"kind": "box", "half_extents": [0.5, 0.5, 0.5], "material": "ice"}]}}]})";
    REQUIRE(scene::read_scene(whole).ok());
    for (std::size_t length = 0; length < whole.size(); ++length) {
        CAPTURE(length);
        CHECK_FALSE(scene::read_scene(whole.substr(0, length)).ok());
    }
}
