// Writes every tick into one SQLite file from its own thread, so that no tick waits for a disk.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/realtime/heartbeat.hpp"
#include "core/realtime/now.hpp"
#include "core/session/felt_surface.hpp"
#include "core/session/tick_record.hpp"

namespace dibhr {

struct RecorderStatus {
    bool recording{false};
    std::uint64_t rows{0};         ///< safely in the file
    std::uint64_t dropped{0};      ///< by the ring since the recording began
    std::uint64_t high_water{0};   ///< the most ticks that waited in the ring
    std::uint64_t bytes{0};        ///< on the disk
    double bytes_per_minute{0.0};  ///< by which the file grows; 0 in the first second
    /// Pairs of frames of which no surface is stored, as their images were not in memory any more.
    std::uint64_t missing_surfaces{0};
    std::string failure{};  ///< a sentence when writing failed; what was written stays readable
};

/// Drains the ring into `file` (write-ahead log, a transaction at least every 250 ms). What is in
/// the ring at the start is recorded too. The tables are described in README.md and in the file
/// itself.
class Recorder {
  public:
    static constexpr std::chrono::milliseconds kPatience{1000};

    /// Creates the session file; throws InputError when it exists already or cannot be made.
    /// `facts` are name/value pairs kept with the session (program version, device, note,
    /// participant). `heart`, if any, beats while the recorder writes, not while it waits for the
    /// disk; it outlives the recorder. `now`: the clock of its transactions and marks. `surface`:
    /// what is stored of the surface that ticks feel.
    Recorder(const std::filesystem::path& file, TickRing& ring, const SessionFacts& facts,
             Heartbeat* heart = nullptr, Now now = std::chrono::steady_clock::now,
             const RecordedSurface& surface = {});
    ~Recorder();  ///< as finish()
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    // The next seven wait for no disk. Each counts for the ticks that are pushed after it.

    /// Parameters that ticks may refer to from now on by their version. `bump`: their bump map, if
    /// it is to be stored with the surface.
    void parameters(const SessionParameters& parameters,
                    std::shared_ptr<const BumpMap> bump = nullptr);
    /// The files that ticks may refer to from now on as media `number`; either may be empty.
    /// `depth_meaning`: see SessionSource. The files' SHA-256 is computed on a thread of its own
    /// once a tick touches them; of files that `grow`, which are still being written, after
    /// complete_media().
    void media(std::uint32_t number, const std::filesystem::path& colour,
               const std::filesystem::path& depth, const std::string& depth_meaning = {},
               bool grow = false);
    /// The growing files are complete. `contents`: of those whose writer knows them already.
    void complete_media(std::vector<SessionMedia> contents = {});
    /// The touch maps that ticks refer to by that version. May come after them.
    void maps(std::uint32_t version, std::vector<SessionMap> maps);
    /// Marks this moment, or `moment`.
    void mark(const std::string& tag, const std::string& text = {},
              std::optional<std::chrono::steady_clock::time_point> moment = {});
    /// Marks a moment of ticks that have a clock of their own, from the first tick on.
    void mark_at(double t_s, const std::string& tag, const std::string& text = {});
    /// Changes or adds a fact: "participant", "note".
    void set_fact(const std::string& key, const std::string& value);

    [[nodiscard]] RecorderStatus status() const;

    /// Drains the ring and closes the file; returns the final status. Waits for the sums of large
    /// files at most `for_sums`. May be called twice.
    RecorderStatus finish(std::chrono::milliseconds for_sums = kPatience);

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace dibhr
