// The steps of an estimation, one after the other.
#include "core/estimate/depth_estimate.hpp"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/estimate/colour_frames.hpp"
#include "core/estimate/depth_cache.hpp"
#include "core/estimate/depth_result.hpp"
#include "core/estimate/estimator_command.hpp"
#include "core/estimate/estimator_output.hpp"
#include "core/estimate/printed_progress.hpp"
#include "core/files/cache_folder.hpp"
#include "core/files/content_hash.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/sources/layouts/layouts.hpp"
#include "core/video/sources/sidecar.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

using std::chrono::steady_clock;

double seconds_since(steady_clock::time_point begin) {
    return std::chrono::duration<double>(steady_clock::now() - begin).count();
}

/// Writes the estimator's output to a file; of a very long output only its begin and its end.
class OutputLog {
  public:
    explicit OutputLog(const fs::path& file) : file_(file, std::ios::binary | std::ios::trunc) {}
    ~OutputLog() {
        if (left_out_ > 0) file_ << "\n[" << left_out_ << " bytes are left out here]\n";
        file_ << last_;
    }
    OutputLog(const OutputLog&) = delete;
    OutputLog& operator=(const OutputLog&) = delete;

    void take(std::string_view text) {
        const std::string_view first = text.substr(0, kMost - std::min(first_, kMost));
        first_ += first.size();
        file_ << first << std::flush;
        last_ += text.substr(first.size());
        if (last_.size() < 2 * kMost) return;
        const std::size_t over = last_.size() - kMost;
        last_.erase(0, over);
        left_out_ += over;
    }

  private:
    static constexpr std::size_t kMost = std::size_t{1} << 19;  ///< bytes of begin and end

    std::ofstream file_;
    std::size_t first_{0}, left_out_{0};
    std::string last_{};
};

/// One run of the estimator, with its progress.
class Run {
  public:
    Run(const EstimateRequest& request, const EstimateFolder& folder,
        const EstimatorCommand& command, std::size_t frames, EstimateWatch& watch)
        : folder_(folder),
          frames_(frames),
          watch_(watch),
          timeout_s_(request.timeout_s),
          output_log_(folder.said()),
          child_(command.words({fs::absolute(request.colour), folder.frames(), folder.output()}),
                 request.priority) {
        before_ = std::min(row_so_far(folder_.output()).size(), frames_);
        watch_.set_keeper(child_.keeper());
    }
    ~Run() { watch_.set_keeper(0); }
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

    /// Waits. How it ended; nothing when it was stopped. Throws InputError at a timeout.
    std::optional<ChildEnd> wait_for_end() {
        constexpr std::chrono::milliseconds kPause{50};
        constexpr double kCheckInterval_s = 0.25;
        while (true) {
            const auto ended = child_.ended();
            take_output(child_.written(ended ? std::chrono::milliseconds(0) : kPause));
            if (watch_.stopped()) {
                child_.end();
                return std::nullopt;
            }
            if (ended) return ended;
            if (seconds_since(checked_at_) >= kCheckInterval_s) check_output();
        }
    }

    [[nodiscard]] const std::string& last_line() const { return printed_.last_line(); }

  private:
    void take_output(const std::string& text) {
        if (text.empty()) return;
        output_log_.take(text);
        printed_.take(text);
        last_sign_at_ = steady_clock::now();
        report();
    }

    /// Counts frames and bytes in the output folder, and checks the timeout.
    void check_output() {
        checked_at_ = steady_clock::now();
        done_ = std::min(row_so_far(folder_.output()).size(), frames_);
        const std::uintmax_t bytes = bytes_in(folder_.output());
        if (std::exchange(bytes_, bytes) != bytes) last_sign_at_ = checked_at_;
        report();
        if (seconds_since(last_sign_at_) < timeout_s_) return;
        child_.end();
        throw InputError("the estimator wrote and printed nothing for " + short_text(timeout_s_) +
                         " s and was ended");
    }

    void report() {
        EstimateProgress progress{.step = EstimateStep::estimating,
                                  .done = done_,
                                  .of = frames_,
                                  .counted = done_ > 0,
                                  .elapsed_s = seconds_since(begun_),
                                  .said = printed_.last_line()};
        const auto printed = printed_.done_of(frames_ - before_);
        if (printed && before_ + *printed > progress.done) {
            progress.done = before_ + *printed;
            progress.counted = true;
        }
        progress.left_s = left_s(progress);
        watch_.report(progress);
    }

    /// From the speed since the first new frame: before that the estimator loads its model.
    std::optional<double> left_s(const EstimateProgress& now) {
        if (now.done <= before_) return std::nullopt;
        if (first_.done == 0) first_ = {now.done, now.elapsed_s};
        if (now.done <= first_.done) return std::nullopt;
        const double each_s =
            (now.elapsed_s - first_.at_s) / static_cast<double>(now.done - first_.done);
        return each_s * static_cast<double>(frames_ - now.done);
    }

    struct FirstFrames {
        std::size_t done{0};
        double at_s{0.0};
    };

    const EstimateFolder& folder_;
    std::size_t frames_;
    EstimateWatch& watch_;
    double timeout_s_;
    OutputLog output_log_;
    PrintedProgress printed_{};
    std::size_t before_{0};  ///< frames of earlier runs
    std::size_t done_{0};
    FirstFrames first_{};
    std::uintmax_t bytes_{0};
    steady_clock::time_point begun_{steady_clock::now()};
    steady_clock::time_point last_sign_at_{begun_}, checked_at_{begun_};
    ChildProgram child_;
};

ReportFrames frame_reporter(EstimateWatch& watch, EstimateStep step) {
    return [&watch, step](std::size_t done, std::size_t of) {
        watch.report({.step = step, .done = done, .of = of});
    };
}

/// At which frame it failed, for the message.
std::string progress_text(const EstimatorCommand& command, const EstimateFolder& folder,
                          std::size_t frames) {
    const std::size_t done = row_so_far(folder.output()).size();
    if (done == 0 || done >= frames) return "";
    std::string words = " at frame " + std::to_string(done + 1) + " of " + std::to_string(frames);
    if (command.takes_frames())
        words += "; " + std::to_string(done) + " are kept: run it again to go on from there";
    return words;
}

/// The meaning of the finished file's levels: `said` is on the estimator's numbers, `levels` on
/// their conversion to levels.
DepthStatement meaning_of(const DepthStatement& said, const DepthStatement& levels) {
    DepthStatement meaning = said;
    if (!meaning.unit) meaning.unit = DepthUnit::levels;
    if (!meaning.near)
        meaning.near = is_distance(*meaning.unit) ? NearLevels::dark : NearLevels::bright;
    meaning.scale = said.scale.value_or(1.0) * levels.scale.value_or(1.0);
    if (levels.no_data) meaning.no_data = levels.no_data;
    if (!meaning.no_data) meaning.no_data.emplace();
    meaning.packing = DepthPacking::separate;
    meaning.code = DepthCode::grey;
    return meaning;
}

/// Performs one request: searches the cache, runs, checks and keeps.
class Estimation {
  public:
    Estimation(const EstimateRequest& request, EstimateWatch& watch)
        : request_(request), watch_(watch), command_(request.command) {
        if (request_.colour.empty() || !names_pictures(request_.colour))
            require_readable(request_.colour);
    }

    std::optional<DepthEstimate> made() {
        const auto sum = sha256_of_file(request_.colour, watch_.stopped());
        if (!sum) return std::nullopt;
        folder_ = std::make_unique<EstimateFolder>(request_.cache, *sum, command_.text());
        if (request_.again) folder_->empty();
        const auto before = folder_->record();
        if (before && !before->depth.empty()) {
            const fs::path depth = folder_->path() / before->depth;
            const auto is = fs::exists(depth) ? sha256_of_file(depth, watch_.stopped()) : "";
            if (!is) return std::nullopt;
            if (*is == before->sha256) return save_result(*before, true);
            print_warning("the depth kept for " + shown(request_.colour) +
                          " has changed since it was written, and is made anew");
        }
        if (!prepare_frames()) return std::nullopt;
        const bool all_there = command_.takes_frames() && done_.size() >= colour_.count();
        if (!all_there && !run()) return std::nullopt;
        return written();
    }

  private:
    /// Reads the colour, and writes frames that are not done yet. False when it was stopped.
    bool prepare_frames() {
        const ReportFrames report = frame_reporter(watch_, EstimateStep::reading_frames);
        std::error_code failed;
        if (command_.takes_frames()) {
            done_ = whole_outputs(folder_->output()).numbers;
            if (done_.empty()) fs::remove_all(folder_->output(), failed);
            colour_ = write_colour_frames(request_.colour, folder_->frames(), done_,
                                          watch_.stopped(), report);
        } else {
            fs::remove_all(folder_->output(), failed);
            colour_ = read_colour_frames(request_.colour, watch_.stopped(), report);
        }
        if (watch_.stopped()) return false;
        colour_.file = fs::absolute(request_.colour);
        fs::create_directories(folder_->output(), failed);
        folder_->keep({.colour = colour_, .command = command_.text()});
        return true;
    }

    /// False when it was stopped.
    bool run() {
        Run run(request_, *folder_, command_, colour_.count(), watch_);
        std::string failure;
        try {
            const auto end = run.wait_for_end();
            if (!end) return false;
            if (!end->well()) failure = "the estimator " + in_words(*end);
        } catch (const InputError& error) {
            failure = error.what();
        }
        const WholeOutputs outputs =
            command_.takes_frames() ? whole_outputs(folder_->output()) : WholeOutputs{};
        const std::size_t removed = outputs.removed.size();
        // Where most are unreadable, another run would not help: write_depth() reports what is
        // wrong.
        if (failure.empty() && removed > 0 && removed < outputs.numbers.size())
            throw InputError("the estimator left a picture that cannot be read, " +
                             shown(outputs.removed.front().filename()) +
                             ", which is removed: run it again to have it made anew");
        const bool complete = outputs.numbers.size() >= colour_.count();
        if (failure.empty() || complete) return true;
        failure += progress_text(command_, *folder_, colour_.count());
        if (!run.last_line().empty())
            failure += "; its last line: " + in_quotes(run.last_line(), 160);
        if (fs::exists(folder_->said()) && fs::file_size(folder_->said()) > 0)
            failure += "; all its output is in " + folder_->said().string();
        throw InputError(failure);
    }

    std::optional<DepthEstimate> written() {
        const DepthWritten written = write_depth(
            folder_->output(), colour_, request_.meaning.unit.value_or(DepthUnit::levels),
            folder_->path(), watch_.stopped(), frame_reporter(watch_, EstimateStep::checking));
        if (written.file.empty()) return std::nullopt;
        const auto sum = sha256_of_file(written.file, watch_.stopped());
        if (!sum) return std::nullopt;
        const DepthEstimate made = save_result({.colour = colour_,
                                                .command = command_.text(),
                                                .depth = written.file.filename().string(),
                                                .sha256 = *sum,
                                                .levels = written.levels},
                                               false);
        folder_->remove_work_files();
        return made;
    }

    /// Stores the record, and a sidecar by this request's statement, completed by the last one's.
    DepthEstimate save_result(EstimateRecord record, bool kept_before) {
        DepthStatement said = request_.meaning;
        said.fill_in(record.said);
        record.said = said;
        record.colour.file = fs::absolute(request_.colour);
        folder_->keep(record);
        const fs::path depth = folder_->path() / record.depth;
        write_sidecar(depth, meaning_of(said, record.levels));
        return {depth, record.colour.count(), kept_before};
    }

    const EstimateRequest& request_;
    EstimateWatch& watch_;
    EstimatorCommand command_;
    std::unique_ptr<EstimateFolder> folder_{};
    std::set<std::size_t> done_{};
    ColourFrames colour_{};
};

void copy_whole(const fs::path& from, const fs::path& to) {
    std::ifstream in(from, std::ios::binary);
    OutputFile out(to);
    std::string piece(std::size_t{1} << 20, '\0');
    while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())) || in.gcount() > 0)
        out.write({piece.data(), static_cast<std::size_t>(in.gcount())});
    if (!in.eof()) throw InputError(shown(from) + " cannot be read: make the depth again");
    out.commit();
}

}  // namespace

std::optional<DepthEstimate> estimate_depth(const EstimateRequest& request, EstimateWatch& watch) {
    if (request.priority == ChildPriority::low) lower_priority(0);  // and the decoder's threads
    try {
        return Estimation(request, watch).made();
    } catch (const fs::filesystem_error& error) {
        throw InputError(one_line(error.what()) + ": make it readable");
    }
}

fs::path copy_depth(const DepthEstimate& estimate, const fs::path& colour, const fs::path& out) {
    const fs::path ending = estimate.depth.extension();
    fs::path target = out;
    const bool into_folder = is_folder(out) || !out.has_filename();
    if (into_folder) {
        fs::path name = colour.has_filename() ? colour : colour.parent_path();
        target = out / (name.stem().string() + "_depth" + ending.string());
    }
    if (target.extension() != ending)
        throw InputError("the depth is written as " + ending.string() + ": let the name " +
                         shown(target) + " end so, or give a folder");
    std::error_code failed;
    if (into_folder) make_folders(out, failed);
    copy_whole(estimate.depth, target);
    if (const auto meaning = read_sidecar(estimate.depth)) write_sidecar(target, *meaning);
    return target;
}

}  // namespace dibhr
