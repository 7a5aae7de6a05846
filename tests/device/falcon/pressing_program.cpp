// A program that presses with a Falcon until its life ends in the way that its first argument
// names; what the guardian's tests look at from outside. Its second argument, a file, becomes the
// LastMoment just before.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <map>
#include <new>
#include <string>

#include "device/falcon/guardian.hpp"
#include "tests/device/falcon/falcon_in_loop.hpp"
#include "tests/device/falcon/last_moment.hpp"

namespace {

using namespace std::chrono_literals;
using dibhr::test::falcon::LastMoment;
using dibhr::test::falcon::TickingFalcon;

constexpr int kExitCode = 3;

void* map_page(int file) {
    void* const page =
        mmap(nullptr, sizeof(LastMoment), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (page == MAP_FAILED) std::exit(EXIT_FAILURE);
    return page;
}

/// Of a program that presses.
class Life {
  public:
    explicit Life(const char* file) {
        const int opened = open(file, O_RDWR | O_CREAT | O_CLOEXEC, 0600);
        if (ftruncate(opened, sizeof(LastMoment)) != 0) std::exit(EXIT_FAILURE);
        last_ = new (map_page(opened)) LastMoment;
        loop.force_newton = {0.0, 0.0, 1.0};
        if (!loop.tick_until_ready()) std::exit(EXIT_FAILURE);
        loop.tick_for(500ms);
    }
    void tell() {
        loop.tick();
        last_->t_s =
            std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
                .count();
        last_->program = getpid();
    }

    TickingFalcon loop{dibhr::falcon::ConnectionOptions{}};

  private:
    LastMoment* last_{nullptr};
};

template <typename End>
auto told_before(End end) {
    return [end](Life& life) {
        life.tell();
        end(life.loop);
    };
}

/// A page of a file that has none.
void touch_what_is_not_there(Life& life) {
    std::FILE* const file = std::tmpfile();
    auto* const page = static_cast<volatile char*>(map_page(fileno(file)));
    life.tell();
    *page = 1;
}

void write_too_much(Life& life) {
    std::FILE* const file = std::tmpfile();
    const rlimit none{0, 0};
    setrlimit(RLIMIT_FSIZE, &none);
    life.tell();
    (void)!write(fileno(file), "x", 1);
}

const std::map<std::string, std::function<void(Life&)>> kWays{
    {"kill", told_before([](TickingFalcon&) { (void)raise(SIGKILL); })},
    {"kill-group", told_before([](TickingFalcon&) { kill(0, SIGKILL); })},
    {"segmentation", told_before([](TickingFalcon&) { (void)raise(SIGSEGV); })},
    {"bus-error", touch_what_is_not_there},
    {"abort", told_before([](TickingFalcon&) { std::abort(); })},
    {"exception", told_before([](TickingFalcon&) { std::terminate(); })},
    {"file-size", write_too_much},
    {"exit", told_before([](TickingFalcon&) { _exit(kExitCode); })},
    // These go on.
    {"leave", told_before([](TickingFalcon& loop) { loop.tick_for(3s); })},
    {"stop", told_before([](TickingFalcon& loop) {
         (void)raise(SIGSTOP);
         loop.tick_for(2s);
     })},
    {"alarm", told_before([](TickingFalcon& loop) {
         dibhr::falcon::Guardian::alarm();
         loop.tick_for(500ms);
     })},
};

}  // namespace

int main(int count, char** words) {
    const auto way = count == 3 ? kWays.find(words[1]) : kWays.end();
    if (way == kWays.end()) return EXIT_FAILURE;
    setpgid(0, 0);
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    Life life(words[2]);
    way->second(life);
    return EXIT_SUCCESS;
}
