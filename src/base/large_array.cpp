// Pages from the system; see large_array.h.

#include "base/large_array.h"

#include <algorithm>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace cairn {

namespace {

constexpr std::size_t small_page = 4096;
constexpr std::size_t large_page = std::size_t{2} << 20u;
// Less than this comes from the heap, whose pages are mostly there already.
constexpr std::size_t worth_asking = std::size_t{64} << 10u;

constexpr std::size_t round_up_to(std::size_t bytes, std::size_t page) {
    return (bytes + page - 1) / page * page;
}

// What is taken for so many bytes, and how it is aligned.
struct Extent {
    std::size_t bytes, alignment;

    Extent(std::size_t wanted, std::size_t alignment_wanted)
        : bytes(wanted), alignment(alignment_wanted) {
        if (bytes < worth_asking) return;
        // The last of the large pages may be half empty, but not more.
        const bool fills_last = bytes % large_page >= large_page / 2;
        bytes = round_up_to(bytes, fills_last ? large_page : small_page);
        alignment = std::max(alignment, large_bytes() > 0 ? large_page : small_page);
    }
    std::size_t large_bytes() const { return bytes / large_page * large_page; }
};

// Only advice: where it is not taken, pages come one by one as they are touched.
void advise(void* pages, const Extent& extent) {
#if defined(MADV_HUGEPAGE) && defined(MADV_POPULATE_WRITE)
    const std::size_t large = extent.large_bytes();
    if (large > 0) (void)madvise(pages, large, MADV_HUGEPAGE);
    if (extent.bytes > large) {
        (void)madvise(static_cast<char*>(pages) + large, extent.bytes - large, MADV_POPULATE_WRITE);
    }
#else
    (void)pages, (void)extent;
#endif
}

// The heap keeps what is given back to it, and a world of a million bodies would keep as much
// again as it needs: what its arrays lay in while they grew. Their addresses stay the heap's.
void empty(void* pages, const Extent& extent) {
#if defined(__linux__)
    if (extent.large_bytes() > 0) (void)madvise(pages, extent.bytes, MADV_DONTNEED);
#else
    (void)pages, (void)extent;
#endif
}

}  // namespace

void* take_pages(std::size_t bytes, std::size_t alignment) {
    const Extent extent(bytes, alignment);
    void* const pages = ::operator new(extent.bytes, std::align_val_t(extent.alignment));
    if (extent.bytes >= worth_asking) advise(pages, extent);
    return pages;
}

void give_pages_back(void* pages, std::size_t bytes, std::size_t alignment) {
    const Extent extent(bytes, alignment);
    empty(pages, extent);
    ::operator delete(pages, std::align_val_t(extent.alignment));
}

}  // namespace cairn
