// Writes every tick into one SQLite file from its own thread, so that no tick waits for a disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "core/realtime/spsc_ring.hpp"

namespace dibhr {

/// One tick as it is recorded; trivially copyable. Grid space, newtons, seconds.
struct TickRecord {
    std::int64_t tick{0};
    double t_s{0.0};  ///< monotonic, since the recording's clock began
    double playback_s{0.0};
    double blend{0.0};
    std::int64_t frame{0};  ///< index of the `from` depth frame in its file
    double goal[3]{}, proxy[3]{}, spring_newton[3]{}, sent_newton[3]{};
    double dt_s{0.0};
    double lateness_us{0.0};
    double update_us{0.0};
    std::int32_t moves{0};
    std::int32_t i{-1}, j{-1};
    std::uint8_t contact{0}, primitive{0}, buttons{0}, cut{0};
};

using TickRing = SpscRing<TickRecord, 16384>;

struct RecorderStatus {
    bool recording{false};
    std::uint64_t rows{0};     ///< safely in the file
    std::uint64_t dropped{0};  ///< by the ring since the recording began
    std::uint64_t bytes{0};    ///< on the disk
    std::string
        failure{};  ///< a plain sentence when writing broke off; what was written stays readable
};

/// Drains the ring into `file` (write-ahead log, a transaction at least every 250 ms). What is in
/// the ring at the start is recorded too. The tables are described in session_file.hpp and in the
/// file itself.
class Recorder {
  public:
    /// Creates the session file; throws InputError when it exists already or cannot be made.
    /// `facts` are name/value pairs kept with the session (program version, files, parameters,
    /// device).
    Recorder(const std::filesystem::path& file, TickRing& ring,
             const std::map<std::string, std::string>& facts);
    ~Recorder();  ///< drains what is left, merges the log into the file and closes it
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    [[nodiscard]] RecorderStatus status() const;

    /// Drains what is left and closes the file; the last word on how it went. May be called twice.
    RecorderStatus finish();

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace dibhr
