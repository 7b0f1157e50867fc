// Merging and splitting of islands; see islands.h.

#include "island/islands.h"

#include <algorithm>

namespace cairn {

namespace {

// Links of one body that are looked through for a second link between the same two: more of it
// saves splits that find nothing, and costs time at every link of a crowded body.
constexpr int most_looks = 8;

std::uint32_t take_number(LargeArray<std::uint32_t>& free, std::size_t size) {
    if (free.empty()) return std::uint32_t(size);
    const std::uint32_t number = free.back();
    free.pop_back();
    return number;
}

}  // namespace

bool Islands::add_body(std::uint32_t body) {
    if (body == none || is_there(body)) return false;
    if (body >= places_.size()) places_.resize(std::size_t{body} + 1, none);
    const std::uint32_t node = take_number(free_nodes_, nodes_.size());
    if (node == nodes_.size()) nodes_.emplace_back();
    nodes_[node] = {.body = body};
    places_[body] = node;
    append(make_island(), node);
    return true;
}

bool Islands::remove_body(std::uint32_t body) {
    if (!is_there(body)) return false;
    const std::uint32_t node = places_[body];
    while (nodes_[node].first != none) remove_link(link_of(nodes_[node].first));
    take_out(node);
    nodes_[node] = {};
    free_nodes_.push_back(node);
    places_[body] = none;
    return true;
}

std::uint32_t Islands::add_link(std::uint32_t body_a, std::uint32_t body_b) {
    if (body_a == body_b || !is_there(body_a) || !is_there(body_b)) return none;
    const std::uint32_t a = places_[body_a];
    const std::uint32_t b = places_[body_b];
    const std::uint32_t link = take_number(free_links_, links_.size());
    if (link == links_.size()) links_.emplace_back();
    attach(link, 0, a);
    attach(link, 1, b);
    const std::uint32_t island_a = nodes_[a].island;
    const std::uint32_t island_b = nodes_[b].island;
    if (island_a == island_b) return link;
    if (islands_[island_a].count >= islands_[island_b].count)
        merge(island_a, island_b);
    else
        merge(island_b, island_a);
    return link;
}

bool Islands::remove_link(std::uint32_t link) {
    if (!has_link(link)) return false;
    const std::uint32_t a = links_[link].ends[0].node;
    const std::uint32_t b = links_[link].ends[1].node;
    detach(link, 0);
    detach(link, 1);
    free_links_.push_back(link);
    const bool a_is_alone = nodes_[a].first == none;
    const bool b_is_alone = nodes_[b].first == none;
    if (a_is_alone) leave_alone(a);
    if (b_is_alone) leave_alone(b);
    if (!a_is_alone && !b_is_alone && !are_linked(a, b)) islands_[nodes_[a].island].parted = true;
    return true;
}

void Islands::split(std::uint32_t island, std::vector<std::uint32_t>& parts) {
    parts.clear();
    parts.push_back(island);
    if (!islands_[island].parted) return;
    islands_[island].parted = false;

    // Number what hangs together, in the order of the first bodies.
    members_.clear();
    labels_.resize(nodes_.size());
    for (std::uint32_t n = islands_[island].first; n != none; n = nodes_[n].next) {
        members_.push_back(n);
        labels_[n] = none;
    }
    sizes_.clear();
    for (const std::uint32_t n : members_) {
        if (labels_[n] == none) find_part(n, std::uint32_t(sizes_.size()));
    }
    if (sizes_.size() == 1) return;

    // The largest stays, so that the fewest bodies are told a new number.
    const auto largest =
        std::uint32_t(std::max_element(sizes_.begin(), sizes_.end()) - sizes_.begin());
    LargeArray<std::uint32_t>& numbers = sizes_;
    for (std::uint32_t part = 0; part < numbers.size(); ++part) {
        numbers[part] = part == largest ? island : make_island();
        if (part != largest) parts.push_back(numbers[part]);
    }
    for (const std::uint32_t n : members_) {
        if (labels_[n] == largest) continue;
        take_out(n);
        append(numbers[labels_[n]], n);
    }
}

// Labels all that `from` is linked with, and counts it.
void Islands::find_part(std::uint32_t from, std::uint32_t part) {
    queue_.clear();
    queue_.push_back(from);
    labels_[from] = part;
    for (std::size_t i = 0; i < queue_.size(); ++i) {
        for (End e = nodes_[queue_[i]].first; e != none; e = at(e).next) {
            const std::uint32_t other = at(e ^ 1u).node;
            if (labels_[other] == part) continue;
            labels_[other] = part;
            queue_.push_back(other);
        }
    }
    sizes_.push_back(std::uint32_t(queue_.size()));
}

std::uint32_t Islands::make_island() {
    const std::uint32_t island = take_number(free_islands_, islands_.size());
    if (island == islands_.size()) islands_.emplace_back();
    islands_[island] = {};
    return island;
}

void Islands::append(std::uint32_t island, std::uint32_t node) {
    Island& to = islands_[island];
    nodes_[node].island = island;
    nodes_[node].previous = to.last;
    nodes_[node].next = none;
    (to.last == none ? to.first : nodes_[to.last].next) = node;
    to.last = node;
    ++to.count;
}

// An island that loses its last body is no more.
void Islands::take_out(std::uint32_t node) {
    const Node& n = nodes_[node];
    Island& from = islands_[n.island];
    (n.previous == none ? from.first : nodes_[n.previous].next) = n.next;
    (n.next == none ? from.last : nodes_[n.next].previous) = n.previous;
    if (--from.count > 0) return;
    from = {};
    free_islands_.push_back(n.island);
}

void Islands::merge(std::uint32_t into, std::uint32_t from) {
    Island& to = islands_[into];
    Island& gone = islands_[from];
    for (std::uint32_t n = gone.first; n != none; n = nodes_[n].next) nodes_[n].island = into;
    nodes_[to.last].next = gone.first;
    nodes_[gone.first].previous = to.last;
    to.last = gone.last;
    to.count += gone.count;
    to.parted = to.parted || gone.parted;
    gone = {};
    free_islands_.push_back(from);
}

void Islands::attach(std::uint32_t link, std::uint32_t side, std::uint32_t node) {
    const End end = (link << 1u) | side;
    at(end) = {.node = node, .next = nodes_[node].first};
    if (at(end).next != none) at(at(end).next).previous = end;
    nodes_[node].first = end;
}

void Islands::detach(std::uint32_t link, std::uint32_t side) {
    LinkEnd& end = links_[link].ends[side];
    if (end.previous == none)
        nodes_[end.node].first = end.next;
    else
        at(end.previous).next = end.next;
    if (end.next != none) at(end.next).previous = end.previous;
    end = {};
}

void Islands::leave_alone(std::uint32_t node) {
    const std::uint32_t island = nodes_[node].island;
    if (islands_[island].count == 1) return;
    take_out(node);
    append(make_island(), node);
    if (islands_[island].count == 1) islands_[island].parted = false;
}

// Whether a link between the two is soon found. A miss costs a split, no more.
bool Islands::are_linked(std::uint32_t node_a, std::uint32_t node_b) const {
    End of_a = nodes_[node_a].first;
    End of_b = nodes_[node_b].first;
    for (int look = 0; look < most_looks && of_a != none && of_b != none; ++look) {
        if (at(of_a ^ 1u).node == node_b || at(of_b ^ 1u).node == node_a) return true;
        of_a = at(of_a).next;
        of_b = at(of_b).next;
    }
    return false;
}

std::size_t Islands::byte_count() const {
    const auto bytes = [](const auto& list) { return list.capacity() * sizeof(list[0]); };
    return bytes(places_) + bytes(nodes_) + bytes(links_) + bytes(islands_) + bytes(free_nodes_) +
           bytes(free_links_) + bytes(free_islands_) + bytes(members_) + bytes(labels_) +
           bytes(queue_) + bytes(sizes_);
}

bool Islands::is_sound() const {
    std::size_t listed = 0;
    for (std::uint32_t i = 0; i < islands_.size(); ++i) {
        std::uint32_t count = 0;
        std::uint32_t previous = none;
        for (std::uint32_t n = islands_[i].first; n != none; n = nodes_[n].next) {
            const Node& node = nodes_[n];
            if (node.island != i || node.previous != previous || !is_there(node.body)) return false;
            if (places_[node.body] != n || ++count > nodes_.size()) return false;
            previous = n;
        }
        if (count != islands_[i].count || previous != islands_[i].last) return false;
        listed += count;
    }
    std::size_t ends = 0;
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
        if (nodes_[n].body == none) continue;
        End previous = none;
        for (End e = nodes_[n].first; e != none; e = at(e).next) {
            // Whatever is linked lies in one island.
            if (at(e).node != n || at(e).previous != previous) return false;
            if (nodes_[at(e ^ 1u).node].island != nodes_[n].island) return false;
            if (++ends > 2 * links_.size()) return false;
            previous = e;
        }
    }
    return listed + free_nodes_.size() == nodes_.size() &&
           ends == 2 * (links_.size() - free_links_.size());
}

}  // namespace cairn
