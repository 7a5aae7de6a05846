// Records calls and plays them.
#include "device/forcedimension/record.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <iterator>
#include <limits>
#include <mutex>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr::forcedimension {

namespace {

using Clock = std::chrono::steady_clock;
using Microseconds = std::chrono::microseconds;

constexpr std::string_view kFirstLine = "dibhr forcedimension record 1";
constexpr const char* kLegend =
    "# microseconds since the first line, microseconds that the call took, function, device (- for "
    "none), given numbers = result, answered numbers";
constexpr std::string_view kByHandOnly = "# by hand only";

std::int64_t whole_us(Clock::duration span) {
    return std::chrono::duration_cast<Microseconds>(span).count();
}

/// One line of a record.
struct RecordedCall {
    std::int64_t at_us{0};
    int result{0};
    std::array<double, kMostNumbers> answered{};
};

std::optional<Function> function_named(std::string_view name) {
    const auto* const found =
        std::find_if(kFunctions.begin(), kFunctions.end(),
                     [name](const FunctionShape& shape) { return shape.name == name; });
    if (found == kFunctions.end()) return std::nullopt;
    return static_cast<Function>(std::distance(kFunctions.begin(), found));
}

class PlayedCalls final : public Calls {
  public:
    explicit PlayedCalls(std::string file) : file_(std::move(file)) {}

    /// False: the line is no call.
    bool add(const std::string& line);
    void set_by_hand_only() noexcept { by_hand_only_ = true; }

    int call(Function function, int id, std::span<const double> given,
             std::span<double> answered) override;
    [[nodiscard]] bool by_hand_only() const noexcept override { return by_hand_only_; }
    [[nodiscard]] const std::string& file() const noexcept override { return file_; }

  private:
    const std::string file_;
    bool by_hand_only_{false};
    std::array<std::vector<RecordedCall>, kFunctions.size()> calls_{};
    std::mutex mutex_{};
    std::optional<Clock::time_point> begun_{};  // guarded by mutex_
};

bool PlayedCalls::add(const std::string& line) {
    std::istringstream words(line);
    RecordedCall call;
    std::string took;
    std::string name;
    std::string word;
    if (!(words >> call.at_us >> took >> name >> word)) return false;
    const auto function = function_named(name);
    while (words >> word && word != "=") {
    }
    if (!function || word != "=" || !(words >> call.result)) return false;
    for (std::size_t k = 0; k < shape_of(*function).answered; ++k) {
        if (!(words >> word)) return false;
        const auto number = number_of_text(word);
        call.answered[k] = number.value_or(std::numeric_limits<double>::quiet_NaN());
    }
    auto& all = calls_[static_cast<std::size_t>(*function)];
    if (!all.empty() && call.at_us < all.back().at_us) return false;
    all.push_back(call);
    return true;
}

int PlayedCalls::call(Function function, int /*id*/, std::span<const double> /*given*/,
                      std::span<double> answered) {
    const Clock::time_point now = Clock::now();
    std::int64_t at_us = 0;
    {
        const std::lock_guard lock(mutex_);
        if (!begun_) begun_ = now;
        at_us = whole_us(now - *begun_);
    }
    const auto& all = calls_[static_cast<std::size_t>(function)];
    if (all.empty()) return -1;
    auto next = std::upper_bound(
        all.begin(), all.end(), at_us,
        [](std::int64_t time, const RecordedCall& one) { return time < one.at_us; });
    const RecordedCall& one = next == all.begin() ? *next : *std::prev(next);
    std::copy_n(one.answered.begin(), answered.size(), answered.begin());
    return one.result;
}

}  // namespace

struct RecordedCalls::Output {
    explicit Output(const std::filesystem::path& file) : stream(file) { stream.precision(17); }

    std::ofstream stream;
    std::mutex mutex{};
    const Clock::time_point begun{Clock::now()};
};

RecordedCalls::RecordedCalls(std::shared_ptr<Calls> library, const std::filesystem::path& file)
    : library_(std::move(library)), output_(std::make_unique<Output>(file)) {
    output_->stream << kFirstLine << "\n# " << library_->file() << '\n' << kLegend << '\n';
    if (by_hand_only()) output_->stream << kByHandOnly << '\n';
    if (!output_->stream.flush())
        throw InputError(file.string() + " cannot be written: choose another place");
}

RecordedCalls::~RecordedCalls() = default;

int RecordedCalls::call(Function function, int id, std::span<const double> given,
                        std::span<double> answered) {
    const auto asked = Clock::now();
    const int result = library_->call(function, id, given, answered);
    const auto took = Clock::now() - asked;
    const std::lock_guard lock(output_->mutex);
    std::ofstream& out = output_->stream;
    const FunctionShape& shape = shape_of(function);
    out << whole_us(asked - output_->begun) << ' ' << whole_us(took) << ' ' << shape.name << ' '
        << (shape.of_device ? std::to_string(id) : "-");
    for (const double value : given) out << ' ' << value;
    out << " = " << result;
    for (const double value : answered) out << ' ' << value;
    out << '\n';
    return result;
}

bool is_record(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string line;
    return std::getline(stream, line) && line == kFirstLine;
}

FoundCalls play_record(const std::filesystem::path& file) {
    auto played = std::make_shared<PlayedCalls>(file.string());
    std::ifstream stream(file);
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        if (line == kByHandOnly) played->set_by_hand_only();
        if (number == 1 || line.starts_with('#') || played->add(line)) continue;
        return {nullptr, file.string() + ", line " + std::to_string(number) +
                             ", is no call of a record: send for the file again"};
    }
    return {std::move(played), {}};
}

}  // namespace dibhr::forcedimension
