// Sessions of a test's own, made by the real recorder, and SQLite's reading of JSON.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/session/recorder.hpp"
#include "core/session/tick_record.hpp"

namespace dibhr::test {

/// A tick of a 1 kHz loop above pixel (100, 100) of media 1, out of contact.
[[nodiscard]] TickRecord tick_above(std::int64_t number);

/// The same pressed into the surface by a millimetre at this pixel: 0.5 N of spring, `sent` of them
/// sent.
[[nodiscard]] TickRecord tick_in_contact(std::int64_t number, double x, double y,
                                         double sent_newton = 0.5);

/// Ticks 0 to `count`, in contact at (100, 100) in [first, end).
[[nodiscard]] std::vector<TickRecord> ticks_touching(std::int64_t count, std::int64_t first,
                                                     std::int64_t end);

struct MadeSession {
    SessionFacts facts{};
    std::vector<TickRecord> ticks{};
    std::filesystem::path colour{}, depth{};  ///< of media 1
    std::function<void(Recorder&)> also{};    ///< before the ticks
};

/// Pixels of 0.1 mm.
void record(const std::filesystem::path& file, const MadeSession& session);

/// What SQLite finds at `path` ("$.ticks.all") of a JSON file; an error's words when it is none.
[[nodiscard]] std::string json_at(const std::filesystem::path& file, const std::string& path);

}  // namespace dibhr::test
