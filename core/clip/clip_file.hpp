// Writes the file of a clip: the pictures of a window, each shown at its own time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "core/files/output_file.hpp"

namespace dibhr {

struct ColourImage;
class Mp4File;
class PictureEncoder;

/// What happens when a file of that name exists.
enum class ClipNameConflict { replaces, adds_number };

/// How a clip is finished: with the index at the begin of the file, which needs a copy; or at once,
/// with the index in pieces, which plays as well.
enum class ClipEnd { indexed, at_once };

/// An MP4 that appears whole or not at all. Until it is finished the clip is a file .part... beside
/// it, which plays up to a second before the last picture even when the program dies.
class ClipFile {
  public:
    /// Throws InputError when the file cannot be made.
    ClipFile(const std::filesystem::path& target, ClipNameConflict name);
    ~ClipFile();
    ClipFile(const ClipFile&) = delete;
    ClipFile& operator=(const ClipFile&) = delete;

    /// `shown_s` counts from the clip's begin. A picture less than a millisecond after the one
    /// before is dropped. The first picture sets the size of the video. Throws InputError: what,
    /// and which file.
    void add(const ColourImage& picture, double shown_s);

    /// The last picture is shown until `end_s`. Returns the file's name. Throws InputError.
    std::filesystem::path finish(double end_s, ClipEnd how);

    /// Whether what is written so far plays.
    [[nodiscard]] bool plays() const noexcept;
    /// The file that is written until the clip is finished.
    [[nodiscard]] const std::filesystem::path& written() const noexcept {
        return written_.written();
    }

  private:
    void open(const ColourImage& first);
    template <typename Step>
    auto with_file_in_errors(const Step& step);

    std::filesystem::path target_;
    ClipNameConflict name_;
    OutputFile written_;
    std::unique_ptr<PictureEncoder> encoder_{};
    std::unique_ptr<Mp4File> file_{};
    std::int64_t last_ms_{-1};
};

}  // namespace dibhr
