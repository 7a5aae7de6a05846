// A session file open for writing: filled tick by tick, within transactions.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/session/log_keeper.hpp"
#include "core/session/session_schema.hpp"
#include "core/session/surface_writer.hpp"
#include "core/session/tick_record.hpp"
#include "core/sqlite/database.hpp"

namespace dibhr {

/// The tables are described in README.md and in the file itself. One thread at a time. Every call
/// that writes throws DatabaseError.
class SessionFile {
  public:
    /// Makes the file and its tables. Throws InputError, and leaves nothing behind, when that
    /// fails; an existing file is never touched. `surfaces`: see RecordedSurface.
    SessionFile(const std::filesystem::path& file, const SessionFacts& facts,
                const RecordedSurface& surface = {});
    ~SessionFile();
    SessionFile(const SessionFile&) = delete;  // the statements refer to the database beside them
    SessionFile& operator=(const SessionFile&) = delete;

    void begin();
    /// Adds the tick, and the rows of its parameters, frames and files where it uses them first.
    void add(const TickRecord& record);
    /// Throws also when the file was removed or replaced.
    void commit();

    // Registered here, and written with the first tick that uses them; files by absolute paths.
    void register_parameters(const SessionParameters& parameters,
                             const std::shared_ptr<const BumpMap>& bump = nullptr);
    void register_media(std::uint32_t number, const std::filesystem::path& colour,
                        const std::filesystem::path& depth, const std::string& depth_meaning,
                        bool grows = false);
    /// The growing files are complete: files that are not in `contents` are to be summed up.
    void complete_media(const std::vector<SessionMedia>& contents = {});

    /// Adds the touch maps to which ticks refer by that version; once.
    void add_maps(std::uint32_t version, const std::vector<SessionMap>& maps);
    void set_fact(const std::string& key, const std::string& value);
    void add_mark(const SessionMark& mark);
    void add_clock(std::int64_t t_ns, double utc_s, std::uint64_t dropped,
                   std::uint64_t high_water);

    /// Files that ticks refer to since the last call, and whose SHA-256 is to be computed.
    [[nodiscard]] std::vector<std::filesystem::path> take_new_files();
    void set_content(const SessionMedia& content);

    /// Moves what is in the write-ahead log into the file, so that one file remains after closing;
    /// to be called last.
    void merge_log();
    /// Ends the use of a log, so that the finished file can be read where nothing can be written.
    /// Has no effect while another program reads the file.
    void end_log() noexcept;

    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
    /// Pairs of frames whose surface could not be stored.
    [[nodiscard]] std::uint64_t missing_surfaces() const noexcept {
        return surface_ ? surface_->missing() : 0;
    }
    /// Bytes on the disk, log included.
    [[nodiscard]] std::uint64_t bytes() const;
    /// Bytes of the recorded content, in file or log.
    [[nodiscard]] std::uint64_t bytes_recorded();

  private:
    using Place = std::pair<std::uint64_t, std::uint64_t>;  ///< device and node; zero: nothing
    struct MediaFiles {
        std::filesystem::path colour{}, depth{};
        std::string depth_meaning{};
        bool grows{false};  ///< is still being written
    };

    void try_to(const char* sql) noexcept;
    void use_settings(const TickRecord& record);
    void add_parameters(SessionParameters parameters);
    void add_pair(const TickRecord& record);
    void use_bump(const std::filesystem::path& file);
    void add_times(const TickRecord& record);
    void add_forces(const TickRecord& record);
    [[nodiscard]] std::int64_t source_row(const FrameSource& source, std::int64_t tick);
    [[nodiscard]] std::optional<std::int64_t> media_row(const std::filesystem::path& file,
                                                        bool grows = false);
    void complete_file(const std::filesystem::path& file);
    [[nodiscard]] static Place place_of(const std::filesystem::path& file);

    std::filesystem::path path_;
    Database database_;
    Statement insert_tick_;
    Statement insert_pair_;
    Statement insert_fact_;
    Place place_{};

    std::map<std::uint64_t, SessionParameters> known_parameters_{};
    std::map<std::filesystem::path, std::shared_ptr<const BumpMap>> known_bumps_{};
    std::map<std::uint32_t, MediaFiles> known_media_{};
    std::map<std::filesystem::path, std::int64_t> media_rows_{};
    std::vector<std::filesystem::path> new_files_{}, growing_files_{};
    std::map<std::filesystem::path, SessionMedia> known_contents_{};  ///< of those that grew
    std::vector<FrameSource> sources_{};                              ///< by their rows, from 1
    std::optional<FramePair> pair_{};  ///< the last row of table pair
    SurfaceMark mark_{};               ///< its images in memory, where the surface is stored
    std::optional<SurfaceWriter> surface_{};
    std::int64_t pairs_{0};  ///< and its number
    /// The rows written for each version: one for each set of device limits to which it was
    /// lowered.
    std::map<std::uint64_t, std::vector<SessionParameters>> held_parameters_{};
    std::optional<std::uint64_t> version_{};        ///< of the last tick
    std::optional<DeviceLimits> limits_{};          ///< and its device limits
    std::uint64_t parameters_row_{0};               ///< its key in table parameters
    const SessionParameters* parameters_{nullptr};  ///< that row, of held_parameters_; null: none
    std::shared_ptr<const BumpMap> bump_{};         ///< its map, where the surface is stored
    std::optional<double> newton_per_px_{};         ///< its spring's, where known
    std::int64_t last_tick_{0};                     ///< its number
    std::optional<std::int64_t> last_t_ns_{};       ///< its time, if it is stored as that
    std::unique_ptr<LogKeeper> keeper_{};           ///< until the log is merged for good
};

}  // namespace dibhr
