#pragma once
// The processor's rounding and denormal modes, put to the IEEE defaults for as long as one of these
// lives.
//
// A host may round upward, flush denormals to zero (a library linked with -ffast-math does so for
// the whole process) or trap on inexact results; the bits of a step may not depend on it. Whatever
// was set is put back at the end.

#include <cstdint>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace cairn {

class FloatEnvironment {
public:
    FloatEnvironment() : saved_(read()) {
        if (saved_ != ieee_default) write(ieee_default);
    }
    ~FloatEnvironment() {
        if (saved_ != ieee_default) write(saved_);
    }
    FloatEnvironment(const FloatEnvironment&) = delete;
    FloatEnvironment& operator=(const FloatEnvironment&) = delete;

private:
#if defined(__SSE2__)
    using Word = std::uint32_t;
    // Every exception masked, round to nearest, denormals kept. The low six bits are sticky flags.
    static constexpr Word ieee_default = 0x1f80;
    static Word read() { return _mm_getcsr() & ~Word{0x3f}; }
    static void write(Word word) { _mm_setcsr(word); }
#elif defined(__aarch64__)
    using Word = std::uint64_t;
    static constexpr Word ieee_default = 0;
    static Word read() {
        Word word;
        __asm__ volatile("mrs %0, fpcr" : "=r"(word));
        return word;
    }
    static void write(Word word) { __asm__ volatile("msr fpcr, %0" : : "r"(word)); }
#else
    using Word = std::uint32_t;
    static constexpr Word ieee_default = 0;
    static Word read() { return 0; }
    static void write(Word) {}
#endif
    Word saved_;
};

}  // namespace cairn
