// The board worked by one thread that plays all workers in turn, so that the order in which blocks
// are taken is a fact and not a matter of timing.

#include "base/stage_board.h"

#include <doctest/doctest.h>

#include <vector>

using cairn::StageBoard;
using cairn::TeamStage;

namespace {

struct Taken {
    int block;
    int worker;
    friend bool operator==(const Taken&, const Taken&) = default;
};

// Writes down which blocks were taken, in which order, by whom.
struct Record {
    std::vector<Taken>* taken;
    void operator()(int begin, int, int worker) const { taken->push_back({begin, worker}); }
};

std::vector<int> blocks_of(const std::vector<Taken>& taken) {
    std::vector<int> blocks;
    for (const Taken& t : taken) blocks.push_back(t.block);
    return blocks;
}

}  // namespace

TEST_CASE(
    "a worker goes through its own share from the front, then through others' from the back") {
    std::vector<Taken> taken;
    const Record record = {&taken};
    const std::vector<TeamStage> stage(1, TeamStage(8, 1, record));
    StageBoard board(2);

    board.work_on(board.publish(stage), 0);
    CHECK(blocks_of(taken) == std::vector{0, 1, 2, 3, 7, 6, 5, 4});
    taken.clear();
    board.work_on(board.publish(stage), 1);
    CHECK(blocks_of(taken) == std::vector{4, 5, 6, 7, 3, 2, 1, 0});
}

TEST_CASE("who was at the stage before keeps its last block until the others have nothing else") {
    std::vector<Taken> taken;
    const Record record = {&taken};
    const std::vector<TeamStage> stage(1, TeamStage(6, 1, record));
    StageBoard board(3);

    // Only worker 1 comes to the first; then it is about, and worker 2 is not.
    board.work_on(board.publish(stage), 1);
    taken.clear();
    board.work_on(board.publish(stage), 0);
    CHECK(blocks_of(taken) == std::vector{0, 1, 3, 5, 4, 2});

    // Two stages later it is no longer about.
    taken.clear();
    board.work_on(board.publish(stage), 0);
    CHECK(blocks_of(taken) == std::vector{0, 1, 3, 2, 5, 4});
}

TEST_CASE("one block is the caller's, and shares differ by one block at most") {
    std::vector<Taken> taken;
    const Record record = {&taken};
    StageBoard board(3);
    const auto blocks_in_share = [&](int block_count, int worker) {
        const std::vector<TeamStage> stage(1, TeamStage(block_count, 1, record));
        taken.clear();
        board.work_on(board.publish(stage), worker);
        // Its own come in rising order, before the first that is not.
        int share = 1;
        while (share < block_count &&
               taken[std::size_t(share)].block == taken[std::size_t(share - 1)].block + 1) {
            ++share;
        }
        return share;
    };
    CHECK(blocks_in_share(1, 0) == 1);
    CHECK(blocks_in_share(7, 0) == 3);
    CHECK(blocks_in_share(7, 1) == 2);
    CHECK(blocks_in_share(7, 2) == 2);
}

TEST_CASE("who comes late, by however much, finds nothing to do and is soon at the present") {
    std::vector<Taken> taken;
    const Record record = {&taken};
    StageBoard board(2);
    const std::vector<TeamStage> few(3, TeamStage(10, 2, record));
    const std::vector<TeamStage> many(StageBoard::capacity, TeamStage(4, 1, record));
    const auto work_through = [&](StageBoard::Ticket first, int worker) {
        int looks = 0;
        while (first < board.end()) first = board.work_on(first, worker), ++looks;
        return looks;
    };

    // Late by a part of a run, by a run, and by so many that its slots are about other stages now.
    const StageBoard::Ticket first = board.publish(few);
    board.work_on(board.work_on(first, 0), 0);
    taken.clear();
    CHECK(work_through(first, 1) == 3);
    CHECK(taken.size() == 5);
    for (int run = 0; run < 5; ++run) work_through(board.publish(many), 0);
    taken.clear();
    CHECK(work_through(first, 1) <= int(StageBoard::capacity) + 1);
    CHECK(taken.empty());

    // And what it comes to in the end, it works on.
    const StageBoard::Ticket last = board.publish(few);
    CHECK(work_through(first, 1) <= int(StageBoard::capacity) + 4);
    CHECK(taken.size() == 15);
    CHECK(taken.front() == Taken{6, 1});
    CHECK(board.end() == last + 3);
}
