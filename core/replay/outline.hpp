// When a session was in contact, summed up in the background: the band on the time line.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <filesystem>
#include <future>
#include <memory>

#include "core/session/session.hpp"

namespace dibhr {

/// Pieces of the time from the first tick to the last: which of them hold a contact.
struct ContactBand {
    static constexpr std::size_t kPieces = 1200;

    std::array<bool, kPieces> contact{};
    HandTicks hand{};
};

/// Reads the session once, on a thread of its own, from construction on.
class SessionOutline {
  public:
    SessionOutline(const std::filesystem::path& file, double begin_s, double end_s);
    ~SessionOutline();  ///< breaks off
    SessionOutline(const SessionOutline&) = delete;
    SessionOutline& operator=(const SessionOutline&) = delete;

    /// Null until it is done, or when the session cannot be read on: whoever plays it says why.
    [[nodiscard]] const ContactBand* band();

  private:
    std::atomic<bool> leaving_{false};
    std::future<std::unique_ptr<ContactBand>> result_;
    std::unique_ptr<ContactBand> band_{};
};

}  // namespace dibhr
