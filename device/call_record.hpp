// A record of what a maker's library was asked and answered: a text file that a user can send, and
// that dibhr plays as a device.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dibhr {

/// One call. A text for the user comes last, behind a quotation mark.
struct RecordedCall {
    std::string_view function{};
    std::string of{"-"};  ///< a device or a parameter; "-": of nothing
    std::span<const double> given{};
    int result{0};
    std::span<const double> answered{};
    std::string_view text{};
};

class CallRecorder {
  public:
    using Clock = std::chrono::steady_clock;

    /// `kind`: of the device; `library`: its file. Throws InputError when the file cannot be
    /// written.
    CallRecorder(const std::filesystem::path& file, std::string_view kind,
                 const std::string& library);

    /// Any thread. The file is whole only when this object is destroyed.
    void add(Clock::time_point asked, const RecordedCall& call);
    /// A remark of one line.
    void note(std::string_view text);

  private:
    std::mutex mutex_{};
    std::ofstream stream_;  // guarded by mutex_
    const Clock::time_point begun_{Clock::now()};
};

/// An answer in a record.
struct RecordedAnswer {
    std::int64_t at_us{0};
    int result{0};
    std::vector<double> numbers{};
    std::string text{};
};

/// The answers to one function, of one parameter where `of` says so, in the order of their times.
using RecordedAnswers = std::vector<RecordedAnswer>;

/// How many numbers a call answers; nothing: there is no such function.
using AnswerCount =
    std::function<std::optional<std::size_t>(std::string_view function, std::string_view of)>;

class CallRecord {
  public:
    /// Null where the record does not have that call. `of`: empty for calls of every device.
    [[nodiscard]] const RecordedAnswers* answers(std::string_view function,
                                                 std::string_view of = {}) const;
    [[nodiscard]] bool has_note(std::string_view text) const;

  private:
    friend struct FoundRecord read_call_record(const std::filesystem::path&, std::string_view,
                                               const AnswerCount&, bool);
    bool add(const std::string& line, const AnswerCount& count, bool by_parameter);

    std::map<std::string, RecordedAnswers, std::less<>> answers_{};
    std::vector<std::string> notes_{};
};

/// The record, or why there is none.
struct FoundRecord {
    std::shared_ptr<const CallRecord> record{};
    std::string trouble{};
};

/// The file exists and begins as a record of this kind of device does.
[[nodiscard]] bool is_call_record(const std::filesystem::path& file, std::string_view kind);

/// A record that is damaged is refused with the number of the line.
[[nodiscard]] FoundRecord read_call_record(const std::filesystem::path& file, std::string_view kind,
                                           const AnswerCount& count, bool by_parameter);

/// The answer at that time: the last one before, or the first one. `answers` must not be empty.
[[nodiscard]] const RecordedAnswer& answer_at(const RecordedAnswers& answers, std::int64_t at_us);

}  // namespace dibhr
