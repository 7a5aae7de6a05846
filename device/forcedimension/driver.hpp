// The device's thread: finds an arm, opens it, exchanges poses and forces with it until it is lost,
// and searches again.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "device/arm_buffers.hpp"
#include "device/forcedimension/exchange_loop.hpp"
#include "device/forcedimension/status.hpp"
#include "device/library_thread.hpp"

namespace dibhr::forcedimension {

/// Without a library that can be used there is no thread, and the stage says why.
class Driver {
  public:
    /// `found`: as load_calls() returns it.
    Driver(ConnectionOptions options, FoundCalls found, std::shared_ptr<ArmBuffers> buffers);
    /// Takes the force off, brakes and closes the arm. Where a call of the library does not return,
    /// it is left behind after kLeaveAfter, and another thread stops the arm.
    ~Driver();
    Driver(const Driver&) = delete;
    Driver& operator=(const Driver&) = delete;

    static constexpr std::chrono::milliseconds kLeaveAfter{500};

    [[nodiscard]] Status status() const;
    /// Any thread: the user agrees to the offer of this number.
    void agree_to(std::uint64_t offer);

  private:
    class Search;

    std::shared_ptr<Search> search_;
    std::optional<LibraryThread> thread_{};
};

}  // namespace dibhr::forcedimension
