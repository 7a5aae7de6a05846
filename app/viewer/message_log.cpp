// Collects lines and appends them to the file.
#include "app/viewer/message_log.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <utility>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

/// "2026-11-24 21:07:31.250", local time.
std::string time_now() {
    const auto now = std::chrono::system_clock::now();
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch());
    const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
    std::tm local{};
    localtime_r(&seconds, &local);
    std::array<char, 32> date{};
    std::strftime(date.data(), date.size(), "%Y-%m-%d %H:%M:%S", &local);
    std::array<char, 8> part{};
    std::snprintf(part.data(), part.size(), ".%03d", static_cast<int>(ms.count() % 1000));
    return std::string(date.data()) + part.data();
}

/// Whether the file is empty or begins with a year: guards against damaging a video.
bool may_be_log(const std::filesystem::path& file) {
    std::array<char, 5> begin{};
    std::ifstream in(file, std::ios::binary);
    in.read(begin.data(), begin.size());
    if (in.gcount() == 0) return true;
    return std::isdigit(static_cast<unsigned char>(begin[0])) != 0 && begin[4] == '-';
}

/// Appends all lines or none. Returns why that failed; empty: written.
std::string appended(const std::filesystem::path& file, std::string_view lines) {
    const int log = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    if (log < 0) return std::strerror(errno);
    const off_t before = ::lseek(log, 0, SEEK_END);
    const ssize_t count = ::write(log, lines.data(), lines.size());
    const std::string reason = count < 0 ? std::strerror(errno) : "no room for it";
    const bool whole = count == static_cast<ssize_t>(lines.size());
    const bool cut = whole || ::ftruncate(log, before) == 0;
    ::close(log);
    return whole && cut ? std::string{} : reason;
}

}  // namespace

MessageLog::MessageLog(std::filesystem::path file, TaskGroup& tasks)
    : file_(std::move(file)), writing_(tasks) {
    if (file_.empty()) return;
    std::error_code unknown;
    const bool there = std::filesystem::exists(file_, unknown);
    if ((there && !std::filesystem::is_regular_file(file_, unknown)) || !may_be_log(file_))
        throw InputError(file_.string() + " is no log of dibhr: give --log-file another name");
    const std::string reason = appended(file_, {});
    if (!reason.empty())
        throw InputError("cannot write " + file_.string() + " (" + reason +
                         "): choose a folder that can be written for --log-file");
}

void MessageLog::append(std::string_view kind, std::string_view words) {
    if (file_.empty() || failed_ || words.empty()) return;
    waiting_ += time_now() + " " + std::string(kind) + ": " + one_line(words) + "\n";
}

void MessageLog::append_if_changed(const std::string& kind, const std::string& words) {
    if (std::exchange(last_[kind], words) != words) append(kind, words);
}

void MessageLog::write() {
    if (const auto reason = writing_.take(); reason && !reason->empty()) {
        failed_ = true;
        throw InputError("the log " + file_.string() + " is not kept any more: " + *reason);
    }
    if (waiting_.empty() || writing_.running()) return;
    writing_.restart(
        [file = file_, lines = std::exchange(waiting_, {})] { return appended(file, lines); });
}

void MessageLog::finish(std::chrono::milliseconds patience) try {
    const auto latest = std::chrono::steady_clock::now() + patience;
    writing_.wait_until(latest);
    write();
    writing_.wait_until(latest);
} catch (const InputError&) {
}

}  // namespace dibhr
