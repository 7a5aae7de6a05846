// Records calls and plays them.
#include "device/forcedimension/record.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <mutex>
#include <optional>
#include <string_view>
#include <utility>

#include "device/call_record.hpp"

namespace dibhr::forcedimension {

namespace {

using Clock = CallRecorder::Clock;

constexpr const char* kKind = "forcedimension";
constexpr const char* kByHandOnly = "by hand only";

std::optional<std::size_t> answered_by(std::string_view name, std::string_view /*of*/) {
    const auto* const found =
        std::find_if(kFunctions.begin(), kFunctions.end(),
                     [name](const FunctionShape& shape) { return shape.name == name; });
    return found != kFunctions.end() ? std::optional(found->answered) : std::nullopt;
}

class PlayedCalls final : public Calls {
  public:
    PlayedCalls(std::string file, const CallRecord& record)
        : file_(std::move(file)), by_hand_only_(record.has_note(kByHandOnly)) {
        for (std::size_t k = 0; k < kFunctions.size(); ++k)
            if (const auto* const answers = record.answers(kFunctions[k].name))
                answers_[k] = *answers;
    }

    int call(Function function, int id, std::span<const double> given,
             std::span<double> answered) override;
    [[nodiscard]] bool by_hand_only() const noexcept override { return by_hand_only_; }
    [[nodiscard]] const std::string& file() const noexcept override { return file_; }

  private:
    const std::string file_;
    const bool by_hand_only_;
    std::array<RecordedAnswers, kFunctions.size()> answers_{};
    std::once_flag begins_{};
    Clock::time_point begun_{};
};

int PlayedCalls::call(Function function, int /*id*/, std::span<const double> /*given*/,
                      std::span<double> answered) {
    std::call_once(begins_, [this] { begun_ = Clock::now(); });
    const auto& answers = answers_[static_cast<std::size_t>(function)];
    if (answers.empty()) return -1;
    const auto at = std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - begun_);
    const RecordedAnswer& one = answer_at(answers, at.count());
    std::copy_n(one.numbers.begin(), answered.size(), answered.begin());
    return one.result;
}

}  // namespace

RecordedCalls::RecordedCalls(std::shared_ptr<Calls> library, const std::filesystem::path& file)
    : library_(std::move(library)),
      recorder_(std::make_unique<CallRecorder>(file, kKind, library_->file())) {
    if (by_hand_only()) recorder_->note(kByHandOnly);
}

RecordedCalls::~RecordedCalls() = default;

int RecordedCalls::call(Function function, int id, std::span<const double> given,
                        std::span<double> answered) {
    const auto asked = Clock::now();
    const int result = library_->call(function, id, given, answered);
    const FunctionShape& shape = shape_of(function);
    recorder_->add(asked, {.function = shape.name,
                           .of = shape.of_device ? std::to_string(id) : "-",
                           .given = given,
                           .result = result,
                           .answered = answered});
    return result;
}

bool is_record(const std::filesystem::path& file) {
    return is_call_record(file, kKind);
}

FoundCalls play_record(const std::filesystem::path& file) {
    const FoundRecord found = read_call_record(file, kKind, answered_by, false);
    if (found.record == nullptr) return {nullptr, found.trouble};
    return {std::make_shared<PlayedCalls>(file.string(), *found.record), {}};
}

}  // namespace dibhr::forcedimension
