// The share of the processor that software OpenGL takes.
#include "render/drawing_threads.hpp"

#include <pthread.h>
#include <sys/resource.h>

#include <ctime>
#include <future>
#include <string>
#include <thread>

#include "tests/support/catch.hpp"

namespace dibhr {
namespace {

/// The niceness of a thread of this name, after the call, above that of the calling thread.
int niceness_of(const std::string& name) {
    std::promise<void> named;
    std::promise<void> asked;
    int nice{0};
    std::thread thread([&] {
        pthread_setname_np(pthread_self(), name.c_str());
        named.set_value();
        asked.get_future().wait();
        nice = getpriority(PRIO_PROCESS, 0);
    });
    named.get_future().wait();
    lower_drawing_priority();
    asked.set_value();
    thread.join();
    return nice - getpriority(PRIO_PROCESS, 0);
}

TEST_CASE("the threads that software draws with give way, and no others") {
    CHECK(niceness_of("llvmpipe-7") == kDrawingNiceness);
    CHECK(niceness_of("dibhr-decode") == 0);
}

TEST_CASE("what the driver's threads take of a processor counts as drawing") {
    const double before_s = drawing_s();
    std::promise<void> asked;
    std::promise<void> worked;
    std::thread thread([&] {
        pthread_setname_np(pthread_self(), "llvmpipe-7");
        for (const std::clock_t begin = std::clock(); std::clock() - begin < CLOCKS_PER_SEC / 50;) {
        }
        worked.set_value();
        asked.get_future().wait();
    });
    worked.get_future().wait();
    CHECK(drawing_s() > before_s);
    asked.set_value();
    thread.join();
}

}  // namespace
}  // namespace dibhr
