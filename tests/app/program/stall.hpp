// A disk that stands still on demand, under a program that is started with it.
#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::test {

/// Of the files with `part` in their path (stalling_disk.cpp).
class Stall {
  public:
    explicit Stall(std::string part)
        : part_(std::move(part)),
          lock_(::open(file().c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600)) {}
    ~Stall() { ::close(lock_); }
    Stall(const Stall&) = delete;
    Stall& operator=(const Stall&) = delete;

    /// What starts a program that is to have this disk.
    [[nodiscard]] std::vector<std::string> host() const {
        return {"env", "LD_PRELOAD=" STALLING_DISK, "STALL_PATH=" + part_, "STALL_WHILE=" + file()};
    }
    void begin() const { REQUIRE(::flock(lock_, LOCK_EX) == 0); }
    void end() const { REQUIRE(::flock(lock_, LOCK_UN) == 0); }

  private:
    [[nodiscard]] std::string file() const { return (folder_ / "lock").string(); }

    TemporaryFolder folder_{};
    std::string part_;
    int lock_;
};

}  // namespace dibhr::test
