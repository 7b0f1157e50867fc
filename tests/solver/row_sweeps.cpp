// The order of sweeps over rows: what a sweep over waves and over colours does is what one thread
// does in the order that it stands for.

#include "solver/row_sweeps.h"

#include <doctest/doctest.h>

#include <array>

using namespace cairn;

namespace {

constexpr std::size_t body_count = 300;
constexpr std::size_t contact_count = 1200;

// Contacts at random among bodies of which every seventh cannot be pushed, in no order of numbers;
// and a body in so many contacts that colours run out.
class Crowd {
public:
    Crowd() : motions_(body_count), inertias_(body_count), contacts_(contact_count) {
        for (std::size_t i = 0; i < body_count; ++i) inertias_[i].inverse_mass = i % 7 != 0;
        for (std::size_t k = 0; k < contact_count; ++k) {
            const std::uint32_t a = roll(body_count);
            contacts_[k].body_a = k % 12 == 0 ? 1 : a;
            contacts_[k].body_b = (contacts_[k].body_a + 1 + roll(body_count - 1)) % body_count;
            active_.push_back(std::uint32_t((k * 7) % contact_count));
        }
        problem_.motions = motions_;
        problem_.inertias = inertias_;
        problem_.contacts = contacts_;
        problem_.active = active_;
    }

    std::span<const std::uint32_t> active() const { return active_; }

    // What a row does depends on the contact, on both bodies, and on all that came before.
    using States = std::array<std::uint64_t, body_count>;
    void push(std::uint32_t contact, States& states) const {
        const std::uint32_t a = contacts_[contact].body_a, b = contacts_[contact].body_b;
        const std::uint64_t sum = 31 * states[a] + 37 * states[b] + contact + 1;
        if (inertias_[a].inverse_mass > 0) states[a] = sum;
        if (inertias_[b].inverse_mass > 0) states[b] = 3 * sum;
    }

    // Two sweeps, to and fro.
    States sweep(RowOrder order, int threads) {
        const SharedScheduler scheduler = *make_scheduler({.count = threads});
        Team team(scheduler);
        problem_.team = &team;
        RowSweeps sweeps;
        sweeps.order_rows(problem_, order);
        contacts_in_order_.assign(sweeps.contacts().begin(), sweeps.contacts().end());
        States states = {};
        auto visit = [&](std::size_t k) { push(contacts_in_order_[k], states); };
        sweeps.add_sweep(visit);
        sweeps.add_sweep(visit, true);
        sweeps.run(problem_);
        return states;
    }
    States sweep_alone(std::span<const std::uint32_t> contacts) const {
        States states = {};
        for (std::size_t k = 0; k < contacts.size(); ++k) push(contacts[k], states);
        for (std::size_t k = contacts.size(); k-- > 0;) push(contacts[k], states);
        return states;
    }
    std::span<const std::uint32_t> contacts_in_order() const { return contacts_in_order_; }

private:
    std::uint32_t roll(std::size_t below) {
        state_ = state_ * 1664525u + 1013904223u;
        return std::uint32_t((state_ >> 8u) % below);
    }

    std::uint32_t state_ = 1;
    std::vector<BodyMotion> motions_;
    std::vector<BodyInertia> inertias_;
    std::vector<Contact> contacts_;
    std::vector<std::uint32_t> active_, contacts_in_order_;
    StepProblem problem_;
};

}  // namespace

TEST_CASE(
    "a sweep over waves, to and fro, is one in the problem's order on any number of threads") {
    Crowd crowd;
    const Crowd::States alone = crowd.sweep_alone(crowd.active());
    for (const int threads : {1, 2, 4, 8}) {
        CAPTURE(threads);
        CHECK(crowd.sweep(RowOrder::Waves, threads) == alone);
    }
}

TEST_CASE("a sweep over colours is one from the first row to the last on any number of threads") {
    Crowd crowd;
    for (const int threads : {1, 2, 4, 8}) {
        CAPTURE(threads);
        const Crowd::States states = crowd.sweep(RowOrder::Colours, threads);
        CHECK(states == crowd.sweep_alone(crowd.contacts_in_order()));
    }
}
