#pragma once
// The little that is asked of the system: a thread, a place for idle threads to sleep, and the two
// ways of waiting that come before sleep.
//
// CAIRN_THREADS is 1 where there are POSIX threads, and may be set to 0 by the build. Without them
// no thread starts, which is all that the scheduler needs to know. POSIX rather than <thread>: a
// thread that the system refuses must be an answer, and without exceptions <thread> has none.

#if !defined(CAIRN_THREADS)
#if defined(__wasm__) && !defined(_REENTRANT)
#define CAIRN_THREADS 0
#elif __has_include(<pthread.h>)
#define CAIRN_THREADS 1
#else
#define CAIRN_THREADS 0
#endif
#endif

#if CAIRN_THREADS
#include <pthread.h>
#endif

namespace cairn {

// A thread that takes none of the process's signals but those of its own faults.
class OsThread {
public:
    using Entry = void (*)(void* context, int index);
    OsThread() = default;
    OsThread(const OsThread&) = delete;
    OsThread& operator=(const OsThread&) = delete;

    // Calls entry(context, index) on a new thread; false where the system starts none.
    bool start(Entry entry, void* context, int index);
    // Returns when the entry has. Once for each successful start.
    void join();

private:
#if CAIRN_THREADS
    static void* enter(void* self);
    pthread_t thread_ = {};
    Entry entry_ = nullptr;
    void* context_ = nullptr;
    int index_ = 0;
#endif
};

// Where idle threads sleep. A ring wakes all who sleep and is not remembered for those who come
// later, except that a sleeper looks at `must_wake` once more before it lies down.
class Doorbell {
public:
    Doorbell() = default;
    Doorbell(const Doorbell&) = delete;
    Doorbell& operator=(const Doorbell&) = delete;
    ~Doorbell();

    // Sleeps until the next ring, unless must_wake() says no; called while rings are held off.
    template <class MustWake>
    void sleep(MustWake must_wake) {
        lock();
        if (!must_wake()) wait_for_ring();
        unlock();
    }
    void ring();

private:
    void lock();
    void unlock();
    void wait_for_ring();
#if CAIRN_THREADS
    pthread_mutex_t mutex_ = PTHREAD_MUTEX_INITIALIZER;
    pthread_cond_t rung_ = PTHREAD_COND_INITIALIZER;
    unsigned rings_ = 0;
#endif
};

// Tells the processor that this is a waiting loop: some tens of nanoseconds.
inline void pause_processor() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ volatile("isb");
#endif
}

// Gives the core to another thread that could run, if there is one.
void yield_to_os();

// Waits a little longer each time it is asked: first on the processor, then by giving it away, so
// that more threads than cores get on.
class Patience {
public:
    // Some microseconds: longer than a barrier takes between cores that both run.
    static constexpr int pauses = 200;

    void wait() {
        if (++waits_ <= pauses)
            pause_processor();
        else
            yield_to_os();
    }
    int waits() const { return waits_; }

private:
    int waits_ = 0;
};

}  // namespace cairn
