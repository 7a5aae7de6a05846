// Recordings whose surface was cleaned once, off line, and is kept: a folder each, named by the
// content of the recording, how it was cleaned, and the version of both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/files/content_hash.hpp"
#include "core/video/cleaning/cleaning_chain.hpp"
#include "core/video/playing/prepared_file.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// A file of a recording, as it was when it was prepared.
struct PreparedSource {
    FileContent content{};
    std::int64_t changed_ns{0};  ///< its time of last change, or the newest in a folder
};

struct PreparedRecord {
    std::vector<PreparedSource> sources{};  ///< colour, where there is one of its own, and depth
    std::string meaning{};                  ///< what its depth means, as text
    std::string cleaning{};                 ///< what was asked for, as text
    std::string made_by{};                  ///< versions of all that may change a bit
    CleaningPlan plan{};                    ///< what that was for this recording
    std::size_t frames{0};
    int columns{0}, rows{0};
    double duration_s{0.0};
};

/// A recording in the cache: a row of `dibhr prepare --list`.
struct KeptRecording {
    std::filesystem::path folder{};
    std::optional<PreparedRecord> record{};  ///< nothing: not finished, or not readable
    bool is_current{false};                  ///< made by this version: it is used
    std::uintmax_t bytes{0};
};

/// The one used last first. Empty without a cache.
[[nodiscard]] std::vector<KeptRecording> kept_recordings(const std::filesystem::path& cache);

/// Removes one; false when another program has the lock. Throws InputError when that fails.
bool forget_recording(const KeptRecording& kept);

/// The prepared surface of a recording.
struct PreparedSurface {
    std::filesystem::path folder{};
    PreparedReader reader;
    CleaningPlan plan{};
};

/// A damaged one: it is not found again, and prepared anew on request.
void drop_prepared(const PreparedSurface& damaged) noexcept;

/// Looks in `media.prepared_in` for the surface with that cleaning. Null: there is none. Notes its
/// use. Throws InputError where it is there and damaged.
[[nodiscard]] std::unique_ptr<PreparedSurface> find_prepared(const MediaDescription& media,
                                                             const CleaningOptions& cleaning);

struct PrepareRequest {
    std::filesystem::path cache{};
    CleaningOptions cleaning{};
    std::uintmax_t most_bytes{0};  ///< of the cache; those used longest ago go first
    bool again{false};             ///< also where it is kept already
    /// Called with the share that is done; false: breaks off.
    std::function<bool(double share)> progress{};
};

struct Prepared {
    std::filesystem::path folder{};
    bool was_kept{false};  ///< it was there already
    std::size_t frames{0};
    std::uintmax_t bytes{0};
    std::size_t removed{0};  ///< recordings that went for it
};

/// Cleans a whole recording and keeps the surface. Nothing: progress() broke it off, and nothing is
/// kept. Throws InputError: what, which file, what to do next.
[[nodiscard]] std::optional<Prepared> prepare(std::unique_ptr<Media> media,
                                              const PrepareRequest& request);

}  // namespace dibhr
