#pragma once
// Arrays that may grow large: vectors whose memory comes from the system in few large pieces.
//
// The first touch of each page of 4 KiB is a trap into the system, some microseconds each, and a
// world's first step touches thousands of them: more time than all that it computes. So arrays of
// a MiB and more ask for pages of 2 MiB, which serve later look-ups better too, and those of 64 KiB
// and more have their pages given all at once. Where the system knows neither, they are like any
// others. No result depends on it.

#include <cstddef>
#include <vector>

namespace cairn {

// Room for so many bytes, and back. The alignment is that of the elements.
void* take_pages(std::size_t bytes, std::size_t alignment);
void give_pages_back(void* pages, std::size_t bytes, std::size_t alignment);

template <class Element>
struct LargePages {
    using value_type = Element;

    LargePages() = default;
    template <class Other>
    LargePages(const LargePages<Other>&) {}

    Element* allocate(std::size_t count) {
        return static_cast<Element*>(take_pages(count * sizeof(Element), alignof(Element)));
    }
    void deallocate(Element* elements, std::size_t count) {
        give_pages_back(elements, count * sizeof(Element), alignof(Element));
    }
    friend bool operator==(const LargePages&, const LargePages&) { return true; }
};

template <class Element>
using LargeArray = std::vector<Element, LargePages<Element>>;

// Room for `size` elements in all: for exactly so many at first, where it grows again for twice as
// many as before. Filled one by one, an array touches as much memory again as it needs.
template <class Element>
void make_room(LargeArray<Element>& elements, std::size_t size) {
    const std::size_t before = elements.capacity();
    if (size > before) elements.reserve(size > 2 * before ? size : 2 * before);
}

// Empties a list, and gives its memory back if it is as long as lists are only once, when a world
// is built.
template <class Element>
void forget(LargeArray<Element>& list) {
    constexpr std::size_t many = 100000;
    if (list.size() > many)
        LargeArray<Element>().swap(list);
    else
        list.clear();
}

}  // namespace cairn
