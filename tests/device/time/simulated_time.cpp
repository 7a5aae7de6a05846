// The steady clock of this program, and every call that waits: interposed system calls, as those of
// falcon/usbfs_shim.cpp. A thread that works works for no time, however long the machine keeps it
// from a processor; when all wait, and nothing that one of them waits for is under way, the clock
// goes to the end of the wait that ends next. So what takes two seconds takes a millisecond, and 20
// ms are 20 ms on the busiest machine. Processes that were forked from this one, and execute no
// other program, are waited for likewise. See README.md of this folder.
//
// No sanitizer is to see the order that this file gives to threads, which is not theirs: it is
// compiled without, and its lock is the kernel's futex.
#undef _FORTIFY_SOURCE  // else libc's headers define poll() themselves
#include "tests/device/time/simulated_time.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <linux/futex.h>
#include <linux/tcp.h>
#include <netinet/in.h>
#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>

namespace dibhr::test {

namespace {

using Moment = std::int64_t;  // [ns] of CLOCK_MONOTONIC
constexpr Moment kNever = std::numeric_limits<Moment>::max();
constexpr Moment kSecond = 1'000'000'000;
// A look at the clock takes a microsecond: who looks until a time has come does not look for ever.
constexpr Moment kLook = 1'000;
constexpr pid_t kNotYet = -1;
// Of real time, until it is looked again for what others do: longer each time.
constexpr Moment kNap = 50'000;
constexpr Moment kLongestNap = 1'000'000;
constexpr std::size_t kMostFiles = 64;    // that one thread waits for
constexpr std::size_t kMostSockets = 64;  // of TCP, in the whole program
// States of a TCP connection, which are numbers of the kernel's.
constexpr int kEstablished = 1;
constexpr int kSynSent = 2;

Moment of(const timespec& time) noexcept {
    return time.tv_sec * kSecond + time.tv_nsec;
}
timespec as_timespec(Moment moment) noexcept {
    return {static_cast<time_t>(moment / kSecond), static_cast<long>(moment % kSecond)};
}
Moment later(Moment now, Moment span) noexcept {
    return span >= kNever - now ? kNever : now + std::max<Moment>(span, 0);
}

// The kernel itself: past every interposed call, of this file and of others.

Moment real_time(clockid_t clock) noexcept {
    timespec time{};
    syscall(SYS_clock_gettime, clock, &time);
    return of(time);
}
void nap(Moment span) noexcept {
    const timespec time = as_timespec(span);
    syscall(SYS_nanosleep, &time, nullptr);
}
int poll_really(pollfd* files, nfds_t count, const timespec* limit) noexcept {
    timespec left = limit != nullptr ? *limit : timespec{};
    return static_cast<int>(
        syscall(SYS_ppoll, files, count, limit != nullptr ? &left : nullptr, nullptr, 0));
}
int poll_now(pollfd* files, nfds_t count) noexcept {
    const timespec none{};
    return poll_really(files, count, &none);
}
void sleep_while(std::atomic<std::uint32_t>& word, std::uint32_t value) noexcept {
    syscall(SYS_futex, &word, FUTEX_WAIT_PRIVATE, value, nullptr, nullptr, 0);
}
void wake_one(std::atomic<std::uint32_t>& word) noexcept {
    syscall(SYS_futex, &word, FUTEX_WAKE_PRIVATE, 1, nullptr, nullptr, 0);
}

class Lock {
  public:
    void lock() noexcept {
        std::uint32_t free = 0;
        if (word_.compare_exchange_strong(free, 1)) return;
        while (word_.exchange(2) != 0) sleep_while(word_, 2);
    }
    void unlock() noexcept {
        if (word_.exchange(0) == 2) wake_one(word_);
    }

  private:
    std::atomic<std::uint32_t> word_{0};  // 1: taken, 2: and somebody wants it
};

/// A place for a process that was forked from this one, or from one such.
struct Forked {
    std::atomic<pid_t> process{0};  ///< 0: nobody has it
    std::atomic<bool> waits{false};
    std::atomic<Moment> deadline{kNever};
    std::atomic<int> event{
        -1};  ///< wakes it; the same number in every process; -1: there is no place
};

/// What forked processes see, too.
struct Page {
    std::atomic<Moment> now{0};
    std::array<Forked, 32> forked{};
};

struct Thread {
    Thread* next{nullptr};
    pthread_t id{};
    pid_t task{0};
    bool ended{false};
    std::atomic<std::uint64_t> waits{0};
    int event{-1};  // wakes it while it waits for files
    void* (*work)(void*){nullptr};
    void* argument{nullptr};
};

/// One wait of a thread, on its stack.
struct Wait {
    Wait* next{nullptr};
    Moment deadline{kNever};
    const pthread_cond_t* condition{nullptr};
    const Thread* end_of{nullptr};
    pollfd* files{nullptr};
    nfds_t file_count{0};
    int event{-1};
    std::atomic<std::uint32_t> over{0};
    bool in_time{false};  // somebody ended it, and not its deadline
};

/// Of TCP, connected.
struct Socket {
    int descriptor{-1};
    in_port_t here{0};
    in_port_t there{0};
    bool met{false};  // the other end has been there
};

struct Simulation {
    Lock lock{};
    int working{1};  // threads that do not wait; the first one is there from the beginning
    Wait* waits{nullptr};
    Thread first{};
    Thread* threads{&first};
    std::atomic<Moment> next_deadline{kNever};
    std::array<Socket, kMostSockets> sockets{};
    std::size_t socket_count{0};
};

// A program has one clock, which is asked before any constructor has run: hence variables of the
// whole program, ready from the start.
constinit Simulation simulation{};
constinit std::atomic<Page*> shared_page{nullptr};
constinit std::atomic<bool> is_forked{false};
constinit Forked* own_place = nullptr;  // of a forked process
thread_local Thread* this_thread __attribute__((tls_model("initial-exec"))) = nullptr;

Page& page() noexcept {
    Page* there = shared_page;
    if (there != nullptr) return *there;
    void* const memory =
        reinterpret_cast<void*>(syscall(SYS_mmap, nullptr, sizeof(Page), PROT_READ | PROT_WRITE,
                                        MAP_SHARED | MAP_ANONYMOUS, -1, 0));
    auto* const made = new (memory) Page;
    made->now = real_time(CLOCK_MONOTONIC);
    if (shared_page.compare_exchange_strong(there, made)) return *made;
    syscall(SYS_munmap, memory, sizeof(Page));
    return *there;
}

Thread& own_thread() noexcept {
    if (this_thread == nullptr) this_thread = &simulation.first;
    return *this_thread;
}

template <typename Function>
Function next_in_line(const char* name) noexcept {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

// All below, up to the interposed calls, with the simulation's lock.

void find_next_deadline() noexcept {
    Moment next = kNever;
    for (const Wait* wait = simulation.waits; wait != nullptr; wait = wait->next) {
        if (wait->over == 0) next = std::min(next, wait->deadline);
    }
    simulation.next_deadline = next;
}

void add(Wait& wait) noexcept {
    Wait** end = &simulation.waits;
    while (*end != nullptr) end = &(*end)->next;
    *end = &wait;
    find_next_deadline();
}

void remove(Wait& wait) noexcept {
    Wait** at = &simulation.waits;
    while (*at != &wait) at = &(*at)->next;
    *at = wait.next;
    find_next_deadline();
}

void wake(int event) noexcept {
    const std::uint64_t one = 1;
    syscall(SYS_write, event, &one, sizeof one);
}
void forget_wakes(int event) noexcept {
    std::uint64_t wakes = 0;
    syscall(SYS_read, event, &wakes, sizeof wakes);
}
int new_event() noexcept {
    return static_cast<int>(syscall(SYS_eventfd2, 0, EFD_NONBLOCK | EFD_CLOEXEC));
}

void end(Wait& wait, bool in_time) noexcept {
    wait.in_time = in_time;
    ++simulation.working;
    wait.over = 1;
    if (wait.event >= 0) {
        wake(wait.event);
    } else {
        wake_one(wait.over);
    }
}

/// The kernel has woken somebody who waits for files, and who goes on by itself.
bool somebody_has_been_woken() noexcept {
    std::array<pollfd, 4 * kMostFiles> files{};
    std::size_t count = 0;
    for (const Wait* wait = simulation.waits; wait != nullptr; wait = wait->next) {
        if (wait->over != 0) continue;
        if (count + wait->file_count > files.size()) std::abort();  // no test waits for so many
        for (nfds_t k = 0; k < wait->file_count; ++k) {
            files[count++] = {wait->files[k].fd, wait->files[k].events, 0};
        }
    }
    if (count == 0 || poll_now(files.data(), count) <= 0) return false;
    return std::any_of(files.begin(), files.begin() + count,
                       [](const pollfd& file) { return (file.revents & ~POLLNVAL) != 0; });
}

/// Of a process: 'S' while it sleeps; '\0': there is none.
char state_of(pid_t process) noexcept {
    std::array<char, 32> path{};
    std::snprintf(path.data(), path.size(), "/proc/%d/stat", process);
    const auto file = static_cast<int>(syscall(SYS_openat, AT_FDCWD, path.data(), O_RDONLY));
    if (file < 0) return '\0';
    std::array<char, 256> text{};
    const auto size = syscall(SYS_read, file, text.data(), text.size() - 1);
    syscall(SYS_close, file);
    const char* const name_ends = size > 0 ? std::strrchr(text.data(), ')') : nullptr;
    return name_ends != nullptr ? name_ends[2] : '\0';
}

/// Frees the place of a process that has ended.
void free_if_ended(Forked& forked) noexcept {
    pid_t process = forked.process;
    if (process == 0 || process == kNotYet) return;
    const char state = state_of(process);
    if (state == '\0' || state == 'Z' || state == 'X') {
        forked.process.compare_exchange_strong(process, 0);
    }
}

/// Every forked process waits for what is to come.
bool forked_are_quiet() noexcept {
    for (Forked& forked : page().forked) {
        free_if_ended(forked);
        const pid_t process = forked.process;
        if (process == 0) continue;
        if (process == kNotYet) return false;
        if (forked.waits && forked.deadline <= page().now) {
            wake(forked.event);
            return false;
        }
        if (!forked.waits || state_of(process) != 'S') return false;
    }
    return true;
}

/// One end of a connection.
struct Traffic {
    Socket socket{};
    std::uint64_t sent{0};
    std::uint64_t received{0};
    bool open{false};
};

/// False: it is closed.
bool look_up(const Socket& socket, Traffic& traffic) noexcept {
    tcp_info info{};
    socklen_t size = sizeof info;
    if (getsockopt(socket.descriptor, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return false;
    traffic = {socket, info.tcpi_bytes_sent - info.tcpi_bytes_retrans, info.tcpi_bytes_received,
               info.tcpi_state == kEstablished || info.tcpi_state == kSynSent};
    return true;
}

/// All that was sent has arrived, and so has every end of a connection: on a busy machine the
/// kernel may leave that for later.
bool connections_are_quiet() noexcept {
    std::array<Traffic, kMostSockets> ends{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < simulation.socket_count;) {
        if (look_up(simulation.sockets[k], ends[count])) {
            ++count;
            ++k;
        } else {
            simulation.sockets[k] = simulation.sockets[--simulation.socket_count];
        }
    }
    for (std::size_t k = 0; k < count; ++k) {
        const Traffic& one = ends[k];
        if (!one.open) continue;
        const auto* const other =
            std::find_if(ends.begin(), ends.begin() + count, [&](const Traffic& each) {
                return each.socket.here == one.socket.there && each.socket.there == one.socket.here;
            });
        const bool is_there = other != ends.begin() + count;
        bool& met = simulation.sockets[k].met;
        if (!is_there && met) continue;  // only a forked process has it still
        met = is_there;
        if (!is_there || one.sent > other->received || other->sent > one.received) return false;
    }
    return true;
}

/// To the end of the wait that ends next; false: none has one.
bool pass_time() noexcept {
    Wait* first = nullptr;
    for (Wait* wait = simulation.waits; wait != nullptr; wait = wait->next) {
        const bool sooner = first == nullptr || wait->deadline < first->deadline;
        if (wait->over == 0 && sooner) first = wait;
    }
    Moment end_of_wait = first != nullptr ? first->deadline : kNever;
    for (const Forked& forked : page().forked) {
        if (forked.process == 0 || forked.deadline >= end_of_wait) continue;
        end_of_wait = forked.deadline;
        first = nullptr;  // it sees by itself that its time has come
    }
    if (end_of_wait == kNever) return false;
    Moment now = page().now;
    while (now < end_of_wait && !page().now.compare_exchange_weak(now, end_of_wait)) {
    }
    if (first != nullptr) end(*first, false);
    return true;
}

/// When the last one goes to wait it sees to it that somebody goes on.
void let_others_go_on(const Wait* own) noexcept {
    Moment span = kNap;
    while (simulation.working == 0 && (own == nullptr || own->over == 0)) {
        if (somebody_has_been_woken()) return;
        if (connections_are_quiet() && forked_are_quiet()) {
            if (!pass_time()) return;
            continue;
        }
        simulation.lock.unlock();
        nap(span);
        span = std::min(2 * span, kLongestNap);
        simulation.lock.lock();
    }
}

void stop_working(const Wait* own) noexcept {
    --simulation.working;
    ++own_thread().waits;
    let_others_go_on(own);
}

// The lock is not held from here on.

Moment look_at_clock() noexcept {
    if (is_forked) return page().now;
    const Moment now = page().now.fetch_add(kLook) + kLook;
    if (now < simulation.next_deadline) return now;
    simulation.lock.lock();
    for (Wait* wait = simulation.waits; wait != nullptr; wait = wait->next) {
        if (wait->over == 0 && wait->deadline <= now) end(*wait, false);
    }
    find_next_deadline();
    simulation.lock.unlock();
    return now;
}

/// `files`, of which there is room for one more, and an event that ends the waiting for them.
struct WaitedFor {
    WaitedFor(const pollfd* files, nfds_t file_count, int event) noexcept : count(file_count) {
        if (count >= kMostFiles || event < 0) std::abort();  // no test waits for so many
        std::copy_n(files, count, all.begin());
        all[count] = {event, POLLIN, 0};
    }
    /// Until one of them, or the event; how many of the files are ready, or -1.
    int wait() noexcept {
        const int ready = poll_really(all.data(), count + 1, nullptr);
        return ready > 0 && all[count].revents != 0 ? ready - 1 : ready;
    }
    void tell(pollfd* files) const noexcept {
        for (nfds_t k = 0; k < count; ++k) files[k].revents = all[k].revents;
    }

    std::array<pollfd, kMostFiles> all{};
    nfds_t count;
};

/// Of a forked process, which is woken when it is to look at the clock.
int poll_forked(pollfd* files, nfds_t count, Moment deadline) noexcept {
    WaitedFor all(files, count, own_place->event);
    own_place->deadline = deadline;
    own_place->waits = true;
    int ready = 0;
    do {
        ready = all.wait();
        forget_wakes(own_place->event);
    } while (ready == 0 && page().now < deadline);
    own_place->waits = false;
    all.tell(files);
    return ready;
}

void wait_until_over(Wait& wait) noexcept {
    while (wait.over == 0) sleep_while(wait.over, 0);
    simulation.lock.lock();
    remove(wait);
    simulation.lock.unlock();
}

void wait_for_time(Moment deadline) noexcept {
    if (is_forked) {
        (void)poll_forked(nullptr, 0, deadline);
        return;
    }
    Wait wait;
    wait.deadline = deadline;
    simulation.lock.lock();
    add(wait);
    stop_working(&wait);
    simulation.lock.unlock();
    wait_until_over(wait);
}

int own_event() noexcept {
    Thread& thread = own_thread();
    if (thread.event < 0) thread.event = new_event();
    return thread.event;
}

/// As ppoll() when nothing is ready yet.
int wait_for_files(pollfd* files, nfds_t count, Moment deadline) noexcept {
    WaitedFor all(files, count, own_event());
    Wait wait;
    wait.event = own_event();
    wait.deadline = deadline;
    wait.files = files;
    wait.file_count = count;
    simulation.lock.lock();
    add(wait);
    stop_working(&wait);
    simulation.lock.unlock();
    int ready = 0;
    while ((ready = all.wait()) < 0 && errno == EINTR) {
    }
    simulation.lock.lock();
    if (wait.over == 0) ++simulation.working;
    remove(wait);
    if (wait.over != 0) forget_wakes(wait.event);
    simulation.lock.unlock();
    all.tell(files);
    return ready;
}

int poll_until(pollfd* files, nfds_t count, Moment span) noexcept {
    const int ready = poll_now(files, count);
    if (ready != 0 || span == 0) return ready;
    const Moment deadline = later(look_at_clock(), span);
    if (is_forked) return poll_forked(files, count, deadline);
    for (;;) {
        const int came = wait_for_files(files, count, deadline);
        if (came != 0 || page().now >= deadline) return came;
    }
}

/// 0, or ETIMEDOUT.
int wait_for_condition(pthread_cond_t* condition, pthread_mutex_t* mutex,
                       Moment deadline) noexcept {
    Wait wait;
    wait.deadline = deadline;
    wait.condition = condition;
    simulation.lock.lock();
    add(wait);
    simulation.lock.unlock();
    pthread_mutex_unlock(mutex);
    simulation.lock.lock();
    stop_working(&wait);
    simulation.lock.unlock();
    wait_until_over(wait);
    pthread_mutex_lock(mutex);
    return wait.in_time ? 0 : ETIMEDOUT;
}

int signal_condition(const pthread_cond_t* condition, bool all) noexcept {
    simulation.lock.lock();
    for (Wait* wait = simulation.waits; wait != nullptr; wait = wait->next) {
        if (wait->over != 0 || wait->condition != condition) continue;
        end(*wait, true);
        if (!all) break;
    }
    simulation.lock.unlock();
    return 0;
}

/// Conditions of the C library say in themselves which clock they have; the times of one are far
/// from the other's.
Moment deadline_of_condition(const timespec& time) noexcept {
    constexpr Moment kSinceEpoch = 1'000'000'000 * kSecond;
    const Moment deadline = of(time);
    if (deadline < kSinceEpoch) return deadline;
    return later(page().now, deadline - real_time(CLOCK_REALTIME));
}

void* work_and_end(void* argument) noexcept {
    auto& thread = *static_cast<Thread*>(argument);
    this_thread = &thread;
    simulation.lock.lock();
    thread.id = pthread_self();
    thread.task = static_cast<pid_t>(syscall(SYS_gettid));
    simulation.lock.unlock();
    void* const result = thread.work(thread.argument);
    if (thread.event >= 0) syscall(SYS_close, thread.event);
    simulation.lock.lock();
    thread.ended = true;
    for (Wait* wait = simulation.waits; wait != nullptr; wait = wait->next) {
        if (wait->over == 0 && wait->end_of == &thread) end(*wait, true);
    }
    stop_working(nullptr);
    simulation.lock.unlock();
    return result;
}

Thread* thread_of(pthread_t id) noexcept {
    for (Thread* thread = simulation.threads; thread != nullptr; thread = thread->next) {
        if (!thread->ended && pthread_equal(thread->id, id) != 0) return thread;
    }
    return nullptr;
}

void wait_for_end_of(pthread_t id) noexcept {
    Wait wait;
    simulation.lock.lock();
    wait.end_of = thread_of(id);
    if (wait.end_of == nullptr) {
        simulation.lock.unlock();
        return;
    }
    add(wait);
    stop_working(&wait);
    simulation.lock.unlock();
    wait_until_over(wait);
}

/// An end of a connection to `there`.
void note_socket(int descriptor, const sockaddr_in& there) noexcept {
    sockaddr_in here{};
    socklen_t size = sizeof here;
    if (is_forked || there.sin_family != AF_INET ||
        getsockname(descriptor, reinterpret_cast<sockaddr*>(&here), &size) != 0) {
        return;
    }
    simulation.lock.lock();
    std::size_t k = 0;
    while (k < simulation.socket_count && simulation.sockets[k].descriptor != descriptor) ++k;
    if (k == kMostSockets) std::abort();  // no test has so many
    simulation.sockets[k] = {descriptor, here.sin_port, there.sin_port, false};
    simulation.socket_count = std::max(simulation.socket_count, k + 1);
    simulation.lock.unlock();
}

/// Of the program itself, whose forked processes may fork others: there is room for those, too.
void make_places_for_forked() noexcept {
    constexpr std::size_t kEnough = 3;
    std::size_t free = 0;
    // Who never waits never asks whether the others are quiet, which frees places, too.
    for (Forked& place : page().forked) free_if_ended(place);
    for (Forked& place : page().forked) {
        if (place.process != 0) continue;
        if (place.event < 0) place.event = new_event();
        if (++free == kEnough) return;
    }
}

/// Before it is there: nothing passes until it has begun to wait.
Forked& place_for_forked() noexcept {
    for (Forked& place : page().forked) {
        pid_t none = 0;
        if (place.event < 0 || !place.process.compare_exchange_strong(none, kNotYet)) continue;
        place.waits = false;
        place.deadline = kNever;
        return place;
    }
    std::abort();  // no test forks so many
}

[[gnu::constructor]] void begin() {
    (void)page();
    simulation.first.id = pthread_self();
    simulation.first.task = static_cast<pid_t>(syscall(SYS_gettid));
}

}  // namespace

std::uint64_t waits_so_far() noexcept {
    std::uint64_t waits = 0;
    simulation.lock.lock();
    for (const Thread* thread = simulation.threads; thread != nullptr; thread = thread->next) {
        waits += thread->waits;
    }
    simulation.lock.unlock();
    return waits;
}

std::uint64_t waits_so_far_of(std::string_view name) noexcept {
    std::uint64_t waits = 0;
    simulation.lock.lock();
    for (const Thread* thread = simulation.threads; thread != nullptr; thread = thread->next) {
        std::array<char, 16> told{};
        if (thread->ended || pthread_getname_np(thread->id, told.data(), told.size()) != 0)
            continue;
        if (name == told.data()) waits += thread->waits;
    }
    simulation.lock.unlock();
    return waits;
}

}  // namespace dibhr::test

namespace simulated = dibhr::test;

#define SEEN_BY_LIBRARIES __attribute__((visibility("default")))

extern "C" {

// Where a sanitizer is part of this program, it is to hear of new threads.
__attribute__((weak)) int __interceptor_pthread_create(pthread_t*, const pthread_attr_t*,
                                                       void* (*)(void*), void*);

SEEN_BY_LIBRARIES int clock_gettime(clockid_t clock, timespec* time) noexcept {
    const bool steady = clock == CLOCK_MONOTONIC || clock == CLOCK_MONOTONIC_RAW ||
                        clock == CLOCK_MONOTONIC_COARSE || clock == CLOCK_BOOTTIME;
    if (!steady) return static_cast<int>(syscall(SYS_clock_gettime, clock, time));
    *time = simulated::as_timespec(simulated::look_at_clock());
    return 0;
}

SEEN_BY_LIBRARIES int clock_nanosleep(clockid_t clock, int flags, const timespec* time,
                                      timespec* left) {
    const simulated::Moment now = simulated::look_at_clock();
    simulated::Moment deadline = simulated::of(*time);
    if ((flags & TIMER_ABSTIME) == 0) {
        deadline = simulated::later(now, deadline);
    } else if (clock == CLOCK_REALTIME) {
        deadline = simulated::later(now, deadline - simulated::real_time(clock));
    }
    simulated::wait_for_time(deadline);
    if (left != nullptr) *left = {};
    return 0;
}

SEEN_BY_LIBRARIES int nanosleep(const timespec* time, timespec* left) {
    return clock_nanosleep(CLOCK_MONOTONIC, 0, time, left);
}

SEEN_BY_LIBRARIES int poll(pollfd* files, nfds_t count, int limit_ms) {
    constexpr simulated::Moment kMillisecond = 1'000'000;
    return simulated::poll_until(files, count,
                                 limit_ms < 0 ? simulated::kNever : limit_ms * kMillisecond);
}

SEEN_BY_LIBRARIES int ppoll(pollfd* files, nfds_t count, const timespec* limit,
                            const sigset_t* /*signals: nobody here changes them*/) {
    return simulated::poll_until(files, count,
                                 limit == nullptr ? simulated::kNever : simulated::of(*limit));
}

/// Without one libusb keeps its time by poll().
SEEN_BY_LIBRARIES int timerfd_create(int, int) noexcept {
    errno = ENOSYS;
    return -1;
}

SEEN_BY_LIBRARIES int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
    return simulated::wait_for_condition(condition, mutex, simulated::kNever);
}

SEEN_BY_LIBRARIES int pthread_cond_timedwait(pthread_cond_t* condition, pthread_mutex_t* mutex,
                                             const timespec* deadline) {
    return simulated::wait_for_condition(condition, mutex,
                                         simulated::deadline_of_condition(*deadline));
}

SEEN_BY_LIBRARIES int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex,
                                             clockid_t /*one of both*/, const timespec* deadline) {
    return pthread_cond_timedwait(condition, mutex, deadline);
}

SEEN_BY_LIBRARIES int pthread_cond_signal(pthread_cond_t* condition) noexcept {
    return simulated::signal_condition(condition, false);
}

SEEN_BY_LIBRARIES int pthread_cond_broadcast(pthread_cond_t* condition) noexcept {
    return simulated::signal_condition(condition, true);
}

SEEN_BY_LIBRARIES int pthread_create(pthread_t* id, const pthread_attr_t* attributes,
                                     void* (*work)(void*), void* argument) noexcept {
    using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
    static const Create next = __interceptor_pthread_create != nullptr
                                   ? &__interceptor_pthread_create
                                   : simulated::next_in_line<Create>("pthread_create");
    auto* const thread = new simulated::Thread;  // for good: its waits stay counted
    thread->work = work;
    thread->argument = argument;
    simulated::simulation.lock.lock();
    ++simulated::simulation.working;  // from now on, though it may be long until it really is
    thread->next = simulated::simulation.threads;
    simulated::simulation.threads = thread;
    simulated::simulation.lock.unlock();
    const int refused = next(id, attributes, simulated::work_and_end, thread);
    simulated::simulation.lock.lock();
    if (refused != 0) {
        thread->ended = true;
        --simulated::simulation.working;
    } else {
        thread->id = *id;
    }
    simulated::simulation.lock.unlock();
    return refused;
}

SEEN_BY_LIBRARIES int pthread_join(pthread_t id, void** result) {
    static const auto next = simulated::next_in_line<int (*)(pthread_t, void**)>("pthread_join");
    simulated::wait_for_end_of(id);
    return next(id, result);
}

SEEN_BY_LIBRARIES pid_t fork() noexcept {
    static const auto next = simulated::next_in_line<pid_t (*)()>("fork");
    if (!simulated::is_forked) simulated::make_places_for_forked();
    simulated::Forked& place = simulated::place_for_forked();
    const pid_t process = next();
    if (process == 0) {
        simulated::is_forked = true;
        simulated::own_place = &place;
        place.process = static_cast<pid_t>(syscall(SYS_getpid));
    } else {
        place.process = std::max(process, 0);
    }
    return process;
}

/// A forked process that closes all that it has keeps what wakes it.
SEEN_BY_LIBRARIES int close_range(unsigned first, unsigned last, int flags) noexcept {
    const auto close_really = [flags](unsigned from, unsigned to) {
        return from > to ? 0 : static_cast<int>(syscall(SYS_close_range, from, to, flags));
    };
    if (!simulated::is_forked) return close_really(first, last);
    const auto kept = static_cast<unsigned>(simulated::own_place->event.load());
    if (kept < first || kept > last) return close_really(first, last);
    const int below = kept == 0 ? 0 : close_really(first, kept - 1);
    const int above = close_really(kept + 1, last);
    return below != 0 ? below : above;
}

SEEN_BY_LIBRARIES int accept4(int listener, sockaddr* address, socklen_t* size, int flags) {
    static const auto next =
        simulated::next_in_line<int (*)(int, sockaddr*, socklen_t*, int)>("accept4");
    const int socket = next(listener, address, size, flags);
    sockaddr_in there{};
    socklen_t there_size = sizeof there;
    if (socket >= 0 && getpeername(socket, reinterpret_cast<sockaddr*>(&there), &there_size) == 0) {
        simulated::note_socket(socket, there);
    }
    return socket;
}

SEEN_BY_LIBRARIES int connect(int socket, const sockaddr* address, socklen_t size) {
    static const auto next =
        simulated::next_in_line<int (*)(int, const sockaddr*, socklen_t)>("connect");
    const int result = next(socket, address, size);
    const int error = errno;
    sockaddr_in there{};
    if (address->sa_family == AF_INET) std::memcpy(&there, address, sizeof there);
    simulated::note_socket(socket, there);
    errno = error;
    return result;
}

}  // extern "C"
