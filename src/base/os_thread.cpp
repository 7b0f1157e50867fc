// Threads, sleep and yielding by POSIX; see os_thread.h.

#include "base/os_thread.h"

#if CAIRN_THREADS
#include <sched.h>
#include <signal.h>

#include <initializer_list>
#endif

namespace cairn {

#if CAIRN_THREADS

namespace {

// The host's handlers run on the host's threads. What a fault of the thread itself raises stays
// open, for crash handlers, and so does the profiler's clock.
sigset_t signals_of_others() {
    sigset_t signals;
    sigfillset(&signals);
    for (const int own : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGABRT, SIGSYS, SIGPROF}) {
        sigdelset(&signals, own);
    }
    return signals;
}

}  // namespace

void* OsThread::enter(void* self) {
#if defined(__linux__)
    pthread_setname_np(pthread_self(), "cairn worker");
#endif
    const OsThread& thread = *static_cast<const OsThread*>(self);
    thread.entry_(thread.context_, thread.index_);
    return nullptr;
}

bool OsThread::start(Entry entry, void* context, int index) {
    entry_ = entry;
    context_ = context;
    index_ = index;
    // A new thread inherits the mask, so it is set around the start.
    const sigset_t blocked = signals_of_others();
    sigset_t before;
    pthread_sigmask(SIG_BLOCK, &blocked, &before);
    const bool started = pthread_create(&thread_, nullptr, &OsThread::enter, this) == 0;
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    return started;
}

void OsThread::join() { pthread_join(thread_, nullptr); }

Doorbell::~Doorbell() {
    pthread_cond_destroy(&rung_);
    pthread_mutex_destroy(&mutex_);
}

void Doorbell::ring() {
    lock();
    ++rings_;
    pthread_cond_broadcast(&rung_);
    unlock();
}

void Doorbell::lock() { pthread_mutex_lock(&mutex_); }

void Doorbell::unlock() { pthread_mutex_unlock(&mutex_); }

void Doorbell::wait_for_ring() {
    // A condition variable may wake without cause: only the count says that there was a ring.
    const unsigned before = rings_;
    while (rings_ == before) pthread_cond_wait(&rung_, &mutex_);
}

void yield_to_os() { sched_yield(); }

#else

bool OsThread::start(Entry, void*, int) { return false; }
void OsThread::join() {}
Doorbell::~Doorbell() = default;
void Doorbell::ring() {}
void Doorbell::lock() {}
void Doorbell::unlock() {}
void Doorbell::wait_for_ring() {}
void yield_to_os() {}

#endif

}  // namespace cairn
