// Formats and writes rows; redraws the lines that show progress.
#include "app/commands/output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <cstdio>
#include <iostream>
#include <mutex>
#include <stop_token>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr std::size_t kPiece_bytes = std::size_t{1} << 20;

constexpr std::chrono::milliseconds kShowAfter{500};
constexpr int kWidth = 40;

}  // namespace

void append_row(std::string& text, const OutputRow& row) {
    const Touch& touch = row.touch;
    const Proxy& proxy = touch.proxy;
    append_number(text, row.t_s);
    for (const Vec3& vector :
         {touch.goal, proxy.position, touch.spring_force_newton, touch.sent_force_newton}) {
        for (const double value : {vector.x, vector.y, vector.z}) {
            text += ',';
            append_number(text, value);
        }
    }
    text += proxy.contact ? ",1," : ",0,";
    text += name_of(proxy.active.kind);
    for (const std::int64_t number : {std::int64_t{proxy.active.i}, std::int64_t{proxy.active.j},
                                      std::int64_t{proxy.moves}, row.update_ns}) {
        text += ',';
        text += std::to_string(number);
    }
    text += '\n';
}

std::string bounds_met_text(std::size_t bounds_met, std::size_t updates) {
    return std::to_string(bounds_met) + " of " + std::to_string(updates) +
           " updates ended before the proxy had caught up with its goal";
}

std::string megabytes_text(std::uintmax_t bytes) {
    return short_text(static_cast<double>(bytes) / 1e6, 3) + " MB";
}

std::string size_text(int columns, int rows) {
    return std::to_string(columns) + "x" + std::to_string(rows);
}

std::string report_doubt(const MediaDescription& media, bool must_be_sure, StatedBy way) {
    std::string doubt = doubt_about(media, way);
    if (doubt.empty()) return doubt;
    if (must_be_sure) throw InputError(doubt);
    print_error_line(doubt);
    return doubt;
}

void refuse_overwriting(const std::filesystem::path& target,
                        const std::vector<std::filesystem::path>& inputs, const std::string& why) {
    for (const std::filesystem::path& input : inputs) {
        std::error_code missing;
        if (std::filesystem::equivalent(input, target, missing))
            throw InputError(target.string() + ": " + why);
    }
}

RowFile::RowFile(const std::filesystem::path& target,
                 const std::vector<std::filesystem::path>& inputs, const std::string& why) {
    if (target.empty()) return;
    refuse_overwriting(target, inputs, why);
    file_.emplace(target);
}

void RowFile::rows_done() {
    if (text_.size() < kPiece_bytes || !file_) return;
    file_->write(text_);
    text_.clear();
}

void RowFile::commit() {
    if (!file_) return;
    file_->write(text_);
    file_->commit();
}

ProgressBar::ProgressBar(std::string title)
    : title_(std::move(title)),
      begin_(std::chrono::steady_clock::now()),
      on_terminal_(::isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
    if (shown_percent_ >= 0) std::cerr << "\r\x1b[K" << std::flush;
}

void ProgressBar::show(double share, const std::string& beside) {
    if (!on_terminal_ || std::chrono::steady_clock::now() - begin_ < kShowAfter) return;
    const int percent = static_cast<int>(100.0 * std::clamp(share, 0.0, 1.0));
    if (percent == shown_percent_ && beside == shown_beside_) return;
    shown_percent_ = percent;
    shown_beside_ = beside;
    const auto full = static_cast<std::size_t>(percent * kWidth / 100);
    std::cerr << '\r' << title_ << " [" << std::string(full, '#') << std::string(kWidth - full, '.')
              << "] " << percent << " %" << (beside.empty() ? "" : "  ") << beside
              << (beside.empty() ? "" : "\x1b[K") << std::flush;
}

WorkingLine::WorkingLine(const std::string& title) {
    if (::isatty(STDERR_FILENO) == 0) return;
    terminal_ = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
    thread_ = std::jthread([title, terminal = terminal_](const std::stop_token& stop) {
        std::mutex mutex;
        std::condition_variable_any stopped;
        std::unique_lock lock(mutex);
        const auto is_over_within = [&](std::chrono::milliseconds time) {
            stopped.wait_for(lock, stop, time, [] { return false; });
            return stop.stop_requested();
        };
        int seconds = 0;
        for (auto wait = kShowAfter; !is_over_within(wait); wait = std::chrono::seconds(1)) {
            ::dprintf(terminal, "\r%s ... %d s", title.c_str(), seconds);
            ++seconds;
        }
        if (seconds > 0) ::dprintf(terminal, "\r\x1b[K");
    });
}

WorkingLine::~WorkingLine() {
    if (terminal_ < 0) return;
    thread_.request_stop();
    thread_.join();
    ::close(terminal_);
}

}  // namespace dibhr
