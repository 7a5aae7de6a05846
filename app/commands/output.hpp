// Output of commands: rows of touch updates, one line an update (a contract that scripts depend
// on), and a progress bar on stderr for work of more than half a second.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "core/files/output_file.hpp"
#include "core/haptics/touch.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

inline constexpr std::string_view kOutputHeader =
    "t,gx,gy,gz,px,py,pz,fx,fy,fz,cx,cy,cz,contact,primitive,i,j,moves,ns\n";

/// One update. Grid space [px], forces [N] in the axes of grid space.
struct OutputRow {
    double t_s{0.0};
    Touch touch{};
    std::int64_t update_ns{0};
};

/// Appends one line.
void append_row(std::string& text, const OutputRow& row);

/// "3 of 10 updates ended before the proxy had caught up with its goal"
[[nodiscard]] std::string bounds_met_text(std::size_t bounds_met, std::size_t updates);

/// "12.5 MB".
[[nodiscard]] std::string megabytes_text(std::uintmax_t bytes);

/// "720x486".
[[nodiscard]] std::string size_text(int columns, int rows);

/// Where the meaning of the depth is likely but not sure: says so in one line on stderr, and
/// returns it; or, if it must be sure, throws InputError with that line. Empty: it is sure.
std::string report_doubt(const MediaDescription& media, bool must_be_sure,
                         StatedBy way = StatedBy::options);

/// Throws InputError, with `why`, when the target is one of the `inputs`.
void refuse_overwriting(const std::filesystem::path& target,
                        const std::vector<std::filesystem::path>& inputs, const std::string& why);

/// A file that is written in large pieces and appears at commit(), whole or not at all.
class RowFile {
  public:
    /// "-" is standard output; an empty name writes nothing. Throws InputError when the target
    /// cannot be written, or is one of the `inputs`, with `why`.
    RowFile(const std::filesystem::path& target, const std::vector<std::filesystem::path>& inputs,
            const std::string& why);

    [[nodiscard]] bool has_target() const noexcept { return file_.has_value(); }
    /// Append rows here, and call rows_done() after each or after a few.
    [[nodiscard]] std::string& text() noexcept { return text_; }
    void rows_done();
    void commit();

  private:
    std::optional<OutputFile> file_{};
    std::string text_{};
};

/// Drawn only on a terminal, and only after half a second; erased by the destructor.
class ProgressBar {
  public:
    explicit ProgressBar(std::string title);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// `share`: of the work that is done, 0 to 1. `beside`: text to the right of the bar.
    void show(double share, const std::string& beside = {});

  private:
    std::string title_;
    std::chrono::steady_clock::time_point begin_;
    int shown_percent_{-1};
    std::string shown_beside_{};
    bool on_terminal_{false};
};

/// As ProgressBar, for work whose share is not known: shows its title and the time that it takes.
class WorkingLine {
  public:
    explicit WorkingLine(const std::string& title);
    ~WorkingLine();
    WorkingLine(const WorkingLine&) = delete;
    WorkingLine& operator=(const WorkingLine&) = delete;

  private:
    int terminal_{-1};  ///< a duplicate: stderr is discarded while some pictures are decoded
    std::jthread thread_{};
};

}  // namespace dibhr
