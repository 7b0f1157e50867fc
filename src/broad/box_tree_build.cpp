// Many leaves at once: the whole tree from the top, and upkeep of what has moved; see box_tree.h.
//
// From the top: leaves are cut in two at the median of their centers along the longest axis until
// there is a part for each child. Of two centers that lie alike the smaller id comes first, so that
// the parts are the same whatever the library.
//
// Upkeep: from the moved leaves up, level by level, each widened box is made tight once. A node
// that has become much larger than it was in its best days is dissolved and its children are put
// in anew from the top, each where it fits now. When that has happened to a good part of all
// leaves, building the tree anew costs less than it saves.

#include <algorithm>

#include "broad/box_tree.h"

namespace cairn {

namespace {

constexpr std::size_t width = BoxNode::width;

// A node is dissolved when it has grown by this factor. More lets boxes overlap for longer, less
// makes more work; from 1.2 to 1.5 the two together cost the same within a tenth.
constexpr float loose_node = 1.35f;
// All is built anew when as many leaves as this share have been put in again one by one.
constexpr std::uint32_t worn_share = 4;

template <class Point>
int find_longest_axis(std::span<const Point> points) {
    Vec3 low = points[0].twice_center, high = low;
    for (const Point& point : points) {
        low = min(low, point.twice_center);
        high = max(high, point.twice_center);
    }
    const Vec3 side = high - low;
    if (side.x >= side.y && side.x >= side.z) return 0;
    return side.y >= side.z ? 1 : 2;
}

template <float Vec3::*axis, class Point>
bool lies_lower(const Point& a, const Point& b) {
    const float x = a.twice_center.*axis, y = b.twice_center.*axis;
    return (x < y) | ((x == y) & (a.ref < b.ref));
}

// Puts the `count` points first that lie lowest along an axis: quickselect, whose inner loop has no
// branch to guess wrong and so takes half the time of std::nth_element.
template <float Vec3::*axis, class Point>
void part_along(std::span<Point> points, std::size_t count) {
    constexpr auto lower = lies_lower<axis, Point>;
    constexpr std::size_t few = 8;
    std::size_t begin = 0, end = points.size();
    // Pivots that keep being bad end in the library's, which is bounded.
    for (int rounds = 0; end - begin > few && rounds < 64; ++rounds) {
        Point& last = points[end - 1];
        Point& middle = points[begin + (end - begin) / 2];
        if (lower(middle, points[begin])) std::swap(middle, points[begin]);
        if (lower(middle, last)) std::swap(middle, last);
        if (lower(last, points[begin])) std::swap(last, points[begin]);
        const Point pivot = last;
        std::size_t low_end = begin;
        for (std::size_t i = begin; i < end - 1; ++i) {
            const Point point = points[i];
            points[i] = points[low_end];
            points[low_end] = point;
            low_end += lower(point, pivot);
        }
        std::swap(points[low_end], last);
        if (low_end == count) return;
        if (low_end < count) {
            begin = low_end + 1;
        } else {
            end = low_end;
        }
    }
    if (begin < count && count < end) {
        std::nth_element(points.begin() + std::ptrdiff_t(begin),
                         points.begin() + std::ptrdiff_t(count),
                         points.begin() + std::ptrdiff_t(end), lower);
    }
}

// Calls use(part) for `part_count` neighbouring parts of nearly equal number.
template <class Point, class Use>
void divide(std::span<Point> points, std::size_t part_count, const Use& use) {
    if (part_count == 1) return use(points);
    const std::size_t first_parts = part_count / 2;
    const std::size_t first_count = points.size() * first_parts / part_count;
    const int axis = find_longest_axis(std::span<const Point>(points));
    if (axis == 0) part_along<&Vec3::x>(points, first_count);
    if (axis == 1) part_along<&Vec3::y>(points, first_count);
    if (axis == 2) part_along<&Vec3::z>(points, first_count);
    divide(points.first(first_count), first_parts, use);
    divide(points.subspan(first_count), part_count - first_parts, use);
}

// Leaves below a full node of a level.
std::size_t leaves_below(int level) { return std::size_t(1) << (3 * (level + 1)); }
static_assert(width == 8);

}  // namespace

void BoxTree::build(std::span<const std::uint32_t> ids, std::span<const Aabb> boxes) {
    for (const BoxNode& node : nodes_) {
        if (node.is_free || node.level > 0) continue;
        for (int i = 0; i < node.count; ++i) places_[node.child[i]] = none;
    }
    free_all();
    if (ids.empty()) return;
    std::uint32_t end = 0;
    LargeArray<Point> points;
    points.reserve(ids.size());
    for (const std::uint32_t id : ids) {
        end = std::max(end, id + 1);
        points.push_back({boxes[id].lower + boxes[id].upper, id});
    }
    if (places_.size() < end) places_.resize(end, none);
    // The nodes of a deep tree have more than six children each, on average.
    nodes_.reserve(ids.size() / 6 + 1);
    int level = 0;
    while (leaves_below(level) < ids.size()) ++level;
    root_ = add_node(level);
    build_below(root_, points, boxes);
    size_ = std::uint32_t(ids.size());
}

void BoxTree::build_below(std::uint32_t at, std::span<Point> points, std::span<const Aabb> boxes) {
    const int level = nodes_[at].level;
    if (level == 0) {
        for (const Point& point : points) append(at, {boxes[point.ref], point.ref});
        return;
    }
    const std::size_t most = leaves_below(level - 1);
    const std::size_t part_count =
        std::max((points.size() + most - 1) / most, std::size_t(min_count));
    divide(points, part_count, [&](std::span<Point> part) {
        const std::uint32_t child = add_node(level - 1);
        build_below(child, part, boxes);
        append(at, {node_box(nodes_[child]), child});
    });
}

void BoxTree::settle(std::span<const Aabb> boxes) {
    loose_.clear();
    tighten_dirty();
    dissolve_loose(boxes);
}

void BoxTree::tighten_dirty() {
    while (!dirty_.empty()) {
        dirty_above_.clear();
        for (const std::uint32_t at : dirty_) {
            // Freed, or here for the second time after having been freed.
            if (!nodes_[at].dirty) continue;
            nodes_[at].dirty = false;
            judge(at);
            const std::uint32_t above = nodes_[at].parent;
            if (above == none) continue;
            const Aabb box = node_box(nodes_[at]);
            const Aabb old = slot_box(nodes_[above], nodes_[at].slot);
            if (box.lower == old.lower && box.upper == old.upper) continue;
            set_slot_box(nodes_[above], nodes_[at].slot, box);
            if (nodes_[above].dirty) continue;
            nodes_[above].dirty = true;
            dirty_above_.push_back(above);
        }
        dirty_.swap(dirty_above_);
    }
}

void BoxTree::judge(std::uint32_t at) {
    BoxNode& node = nodes_[at];
    const float size = measure(node_box(node));
    if (node.size_in_order == 0 || size < node.size_in_order) {
        node.size_in_order = size;
    } else if (size > loose_node * node.size_in_order && at != root_) {
        loose_.push_back(at);
    }
}

void BoxTree::dissolve_loose(std::span<const Aabb> boxes) {
    for (const std::uint32_t at : loose_) {
        // Not if it is another node by now, or in order since a sibling went.
        const BoxNode& node = nodes_[at];
        if (node.is_free || at == root_ || node.size_in_order == 0) continue;
        if (measure(node_box(node)) <= loose_node * node.size_in_order) continue;
        if (node.level == 0) worn_ += node.count;
        if (worn_ > size_ / worn_share) {
            loose_.clear();
            list_leaves(loose_);
            build(loose_, boxes);
            return;
        }
        dissolve(at);
    }
}

bool BoxTree::is_sound() const {
    std::size_t leaves = 0, nodes = 0;
    for (std::size_t at = 0; at < nodes_.size(); ++at) {
        const BoxNode& node = nodes_[at];
        if (node.is_free) continue;
        ++nodes;
        const bool is_root = at == root_;
        if (node.marks != 0 || (is_root ? node.parent != none : node.count < min_count))
            return false;
        for (int i = 0; i < int(width); ++i) {
            if (i >= node.count) {
                if (find_overlaps(node, clamp_to_finite(whole_space)) >> i != 0) return false;
                continue;
            }
            if (node.level == 0) {
                ++leaves;
                if (places_[node.child[i]] != width * at + std::size_t(i)) return false;
                continue;
            }
            const BoxNode& child = nodes_[node.child[i]];
            if (child.is_free || child.parent != at || child.slot != i ||
                child.level + 1 != node.level || !contains(slot_box(node, i), node_box(child)))
                return false;
        }
    }
    return leaves == size_ && (root_ != none || nodes == 0) &&
           (root_ == none || (!nodes_[root_].is_free && nodes_[root_].count > 0));
}

std::size_t BoxTree::count_visits(const Aabb& box) const {
    std::size_t visits = 0;
    if (root_ == none) return visits;
    const Aabb finite = clamp_to_finite(box);
    std::vector<std::uint32_t> stack = {root_};
    while (!stack.empty()) {
        const BoxNode& at = nodes_[stack.back()];
        stack.pop_back();
        ++visits;
        if (at.level == 0) continue;
        for (std::uint32_t hits = find_overlaps(at, finite); hits != 0; hits &= hits - 1)
            stack.push_back(at.child[std::countr_zero(hits)]);
    }
    return visits;
}

std::size_t BoxTree::byte_count() const {
    return nodes_.capacity() * sizeof(BoxNode) + places_.capacity() * sizeof(std::uint32_t) +
           (dirty_.capacity() + dirty_above_.capacity() + loose_.capacity()) *
               sizeof(std::uint32_t);
}

}  // namespace cairn
