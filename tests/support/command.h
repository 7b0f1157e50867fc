#pragma once
// The command line from outside: what it says on which stream, and its exit status. For rooms that
// are given CAIRN_COMMAND, the path of the program.

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace cairn::test {

struct Outcome {
    int status = -1;  // -1 where it did not end by itself
    std::string out, err;
};

inline std::string read_all(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// A folder of one test's own, gone when that ends.
class Scratch {
public:
    Scratch() {
        std::string name = (std::filesystem::temp_directory_path() / "cairn_test_XXXXXX").string();
        path_ = mkdtemp(name.data());
    }
    ~Scratch() { std::filesystem::remove_all(path_); }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    std::string file(const std::string& name) const { return path_ + "/" + name; }

private:
    std::string path_;
};

inline Outcome call(const std::string& arguments, const std::string& input = "") {
    const Scratch scratch;
    std::ofstream(scratch.file("in"), std::ios::binary) << input;
    const std::string line = std::string(CAIRN_COMMAND) + " " + arguments + " <" +
                             scratch.file("in") + " >" + scratch.file("out") + " 2>" +
                             scratch.file("err");
    const int code = std::system(line.c_str());
    return {WIFEXITED(code) ? WEXITSTATUS(code) : -1, read_all(scratch.file("out")),
            read_all(scratch.file("err"))};
}

}  // namespace cairn::test
