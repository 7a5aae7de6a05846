// Writes records of calls and reads them.
#include "device/call_record.hpp"

#include <algorithm>
#include <cerrno>
#include <iterator>
#include <limits>
#include <sstream>
#include <utility>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/write_failure.hpp"

namespace dibhr {

namespace {

constexpr const char* kLegend =
    "# microseconds since the first line, microseconds that the call took, function, device or "
    "parameter (- for none), given numbers = result, answered numbers, \"answered text";

std::int64_t whole_us(CallRecorder::Clock::duration span) {
    return std::chrono::duration_cast<std::chrono::microseconds>(span).count();
}

std::string first_line(std::string_view kind) {
    return "dibhr " + std::string(kind) + " record 1";
}

std::string key_of(std::string_view function, std::string_view of) {
    return std::string(function) + (of.empty() ? "" : " ") + std::string(of);
}

}  // namespace

CallRecorder::CallRecorder(const std::filesystem::path& file, std::string_view kind,
                           const std::string& library)
    : stream_(file) {
    stream_.precision(17);
    stream_ << first_line(kind) << "\n# " << one_line(library) << '\n' << kLegend << '\n';
    if (!stream_.flush()) throw InputError(file.string() + ": " + write_failure(errno));
}

void CallRecorder::add(Clock::time_point asked, const RecordedCall& call) {
    const auto took = Clock::now() - asked;
    const std::lock_guard lock(mutex_);
    stream_ << whole_us(asked - begun_) << ' ' << whole_us(took) << ' ' << call.function << ' '
            << call.of;
    for (const double value : call.given) stream_ << ' ' << value;
    stream_ << " = " << call.result;
    for (const double value : call.answered) stream_ << ' ' << value;
    if (!call.text.empty()) stream_ << " \"" << one_line(call.text);
    stream_ << '\n';
}

void CallRecorder::note(std::string_view text) {
    const std::lock_guard lock(mutex_);
    stream_ << "# " << text << '\n';
}

const RecordedAnswers* CallRecord::answers(std::string_view function, std::string_view of) const {
    const auto found = answers_.find(key_of(function, of));
    return found != answers_.end() ? &found->second : nullptr;
}

bool CallRecord::has_note(std::string_view text) const {
    return std::find(notes_.begin(), notes_.end(), text) != notes_.end();
}

/// False: the line is no call.
bool CallRecord::add(const std::string& line, const AnswerCount& count, bool by_parameter) {
    const std::size_t quoted = line.find('"');
    std::istringstream words(line.substr(0, quoted));
    RecordedAnswer answer;
    std::string took;
    std::string name;
    std::string of;
    if (!(words >> answer.at_us >> took >> name >> of) || answer.at_us < 0) return false;
    const auto numbers = count(name, of);
    std::string word;
    while (words >> word && word != "=") {
    }
    if (!numbers || word != "=" || !(words >> answer.result)) return false;
    while (answer.numbers.size() < *numbers) {
        if (!(words >> word)) return false;
        answer.numbers.push_back(
            number_of_text(word).value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    if (quoted != std::string::npos) answer.text = line.substr(quoted + 1);
    auto& all = answers_[key_of(name, by_parameter ? of : std::string{})];
    // Lines of two threads may be in another order than their times.
    if (!all.empty()) answer.at_us = std::max(answer.at_us, all.back().at_us);
    all.push_back(std::move(answer));
    return true;
}

bool is_call_record(const std::filesystem::path& file, std::string_view kind) {
    std::ifstream stream(file);
    std::string line;
    return std::getline(stream, line) && line == first_line(kind);
}

FoundRecord read_call_record(const std::filesystem::path& file, std::string_view kind,
                             const AnswerCount& count, bool by_parameter) {
    auto record = std::make_shared<CallRecord>();
    std::ifstream stream(file);
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        const bool first = number == 1 && line == first_line(kind);
        if (line.starts_with("# ")) record->notes_.push_back(line.substr(2));
        if (first || line.starts_with('#') || record->add(line, count, by_parameter)) continue;
        return {nullptr, one_line(file.string()) + ", line " + std::to_string(number) +
                             ", is not a call of a record: send for the file again"};
    }
    return {std::move(record), {}};
}

const RecordedAnswer& answer_at(const RecordedAnswers& answers, std::int64_t at_us) {
    const auto next = std::upper_bound(
        answers.begin(), answers.end(), at_us,
        [](std::int64_t time, const RecordedAnswer& one) { return time < one.at_us; });
    return next == answers.begin() ? *next : *std::prev(next);
}

}  // namespace dibhr
