// Records calls and plays them.
#include "device/openhaptics/record.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>

#include "device/call_record.hpp"

namespace dibhr::openhaptics {

namespace {

using Clock = CallRecorder::Clock;

constexpr const char* kKind = "openhaptics";
constexpr std::size_t kMostNumbers = 6;
constexpr std::chrono::microseconds kUsualTick{1000};

std::string hex(HdEnum number) {
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "0x%x", number);
    return text.data();
}

/// How many numbers a value has.
std::size_t size_of(HdEnum what) noexcept {
    switch (what) {
        case kHdPosition:
        case kHdVelocity:
        case kHdGimbalAngles:
        case kHdForce:
            return 3;
        case kHdEncoders:
        case kHdUsableWorkspace:
        case kHdMotorTemperature:
            return kMostNumbers;
        default:
            return 1;
    }
}

std::optional<std::size_t> answered_by(std::string_view function, std::string_view of) {
    if (function == "hdGetError") return 1;
    if (function.starts_with("hdGet") && function.ends_with("v"))
        return size_of(static_cast<HdEnum>(std::strtoul(std::string(of).c_str(), nullptr, 16)));
    return function.starts_with("hd") ? std::optional<std::size_t>(0) : std::nullopt;
}

/// A number of a record, which may be none that T can have: 0 then.
template <typename T>
T number_as(double number) noexcept {
    constexpr double kMost = 1e9;
    if constexpr (std::is_floating_point_v<T>) return number;
    return std::abs(number) < kMost ? static_cast<T>(static_cast<long>(number)) : T{0};
}

using Recorder = std::shared_ptr<CallRecorder>;

/// A function without an answer.
template <typename... Given>
std::function<void(Given...)> noted(const std::function<void(Given...)>& function, const char* name,
                                    const Recorder& recorder) {
    return [=](Given... given) {
        const auto asked = Clock::now();
        function(given...);
        const std::array<double, sizeof...(Given)> numbers{static_cast<double>(given)...};
        recorder->add(asked, {.function = name, .given = numbers});
    };
}

/// A function that reads values.
template <typename T>
std::function<void(HdEnum, T*)> noted_reading(const std::function<void(HdEnum, T*)>& function,
                                              const char* name, const Recorder& recorder) {
    using Numbers = std::array<double, kMostNumbers>;
    const auto last = std::make_shared<std::map<HdEnum, Numbers>>();
    return [=](HdEnum what, T* values) {
        const auto asked = Clock::now();
        function(what, values);
        Numbers numbers{};
        std::copy_n(values, size_of(what), numbers.begin());
        const auto [known, is_new] = last->try_emplace(what, numbers);
        if (!is_new && std::memcmp(&known->second, &numbers, sizeof numbers) == 0) return;
        known->second = numbers;
        recorder->add(asked, {.function = name,
                              .of = hex(what),
                              .answered = std::span(numbers).first(size_of(what))});
    };
}

HdLibrary recorded(const HdLibrary& library, const Recorder& recorder) {
    HdLibrary noting = library;
    noting.init_device = [=](const char* name) {
        const auto asked = Clock::now();
        const HdHandle handle = library.init_device(name);
        recorder->add(asked, {.function = "hdInitDevice",
                              .result = static_cast<int>(handle),
                              .text = name != nullptr ? name : ""});
        return handle;
    };
    noting.get_error = [=] {
        const auto asked = Clock::now();
        const HdErrorInfo error = library.get_error();
        const std::array<double, 1> internal{static_cast<double>(error.internal_code)};
        if (error.code != kHdSuccess)
            recorder->add(asked, {.function = "hdGetError",
                                  .result = static_cast<int>(error.code),
                                  .answered = internal});
        return error;
    };
    noting.get_string = [=](HdEnum what) {
        const auto asked = Clock::now();
        const char* const text = library.get_string(what);
        if (text != nullptr)
            recorder->add(asked, {.function = "hdGetString", .of = hex(what), .text = text});
        return text;
    };
    noting.check_calibration = [=, last = std::make_shared<HdEnum>(0)] {
        const auto asked = Clock::now();
        const HdEnum calibration = library.check_calibration();
        if (std::exchange(*last, calibration) != calibration)
            recorder->add(
                asked, {.function = "hdCheckCalibration", .result = static_cast<int>(calibration)});
        return calibration;
    };
    noting.begin_frame = noted(library.begin_frame, "hdBeginFrame", recorder);
    noting.disable_device = noted(library.disable_device, "hdDisableDevice", recorder);
    noting.enable = noted(library.enable, "hdEnable", recorder);
    noting.disable = noted(library.disable, "hdDisable", recorder);
    noting.update_calibration = noted(library.update_calibration, "hdUpdateCalibration", recorder);
    noting.start_scheduler = noted(library.start_scheduler, "hdStartScheduler", recorder);
    noting.stop_scheduler = noted(library.stop_scheduler, "hdStopScheduler", recorder);
    noting.get_booleans = noted_reading(library.get_booleans, "hdGetBooleanv", recorder);
    noting.get_integers = noted_reading(library.get_integers, "hdGetIntegerv", recorder);
    noting.get_doubles = noted_reading(library.get_doubles, "hdGetDoublev", recorder);
    noting.get_longs = noted_reading(library.get_longs, "hdGetLongv", recorder);
    return noting;
}

/// A record as a library.
class PlayedLibrary {
  public:
    explicit PlayedLibrary(std::shared_ptr<const CallRecord> record)
        : record_(std::move(record)), errors_(record_->answers("hdGetError", "-")) {}
    ~PlayedLibrary() { stop(); }
    PlayedLibrary(const PlayedLibrary&) = delete;
    PlayedLibrary& operator=(const PlayedLibrary&) = delete;

    HdHandle open() {
        const std::lock_guard lock(mutex_);
        if (!begun_) begun_ = Clock::now();
        const RecordedAnswer* const answer = answer_to("hdInitDevice", "-");
        return answer != nullptr ? static_cast<HdHandle>(answer->result) : kHdInvalidHandle;
    }
    /// Each error of the record comes once.
    HdErrorInfo next_error() {
        const std::lock_guard lock(mutex_);
        if (std::exchange(unknown_, false)) return {kHdUnknownParameter, 0, kHdInvalidHandle};
        if (errors_ == nullptr || told_ >= errors_->size()) return {};
        const RecordedAnswer& error = (*errors_)[told_];
        if (error.at_us > now_us()) return {};
        ++told_;
        return {static_cast<unsigned int>(error.result), number_as<int>(error.numbers[0]),
                kHdInvalidHandle};
    }
    template <typename T>
    void read(const char* function, HdEnum what, T* values) {
        const std::lock_guard lock(mutex_);
        const RecordedAnswer* const answer = answer_to(function, hex(what));
        unknown_ = unknown_ || answer == nullptr;
        if (answer == nullptr) return;
        std::transform(answer->numbers.begin(), answer->numbers.end(), values, number_as<T>);
    }
    const char* text(HdEnum what) {
        const std::lock_guard lock(mutex_);
        const RecordedAnswer* const answer = answer_to("hdGetString", hex(what));
        return answer != nullptr ? answer->text.c_str() : nullptr;
    }
    HdEnum calibration() {
        const std::lock_guard lock(mutex_);
        const RecordedAnswer* const answer = answer_to("hdCheckCalibration", "-");
        return answer != nullptr ? static_cast<HdEnum>(answer->result) : kHdNeedsPerson;
    }
    HdSchedule schedule(HdCallback callback, void* data) {
        const std::lock_guard lock(mutex_);
        callback_ = callback;
        data_ = data;
        return 1;
    }
    void start() {
        servo_ = std::jthread([this](const std::stop_token& end) {
            const auto tick = recorded_tick();
            for (auto next = Clock::now(); !end.stop_requested(); next += tick) {
                std::this_thread::sleep_until(next);
                if (callback_(data_) == kHdCallbackDone) return;
            }
        });
    }
    void stop() { servo_ = {}; }

  private:
    [[nodiscard]] std::int64_t now_us() const {
        const auto passed = begun_ ? Clock::now() - *begun_ : Clock::duration(0);
        return std::chrono::duration_cast<std::chrono::microseconds>(passed).count();
    }
    [[nodiscard]] const RecordedAnswer* answer_to(const char* function,
                                                  const std::string& of) const {
        const RecordedAnswers* const answers = record_->answers(function, of);
        return answers != nullptr ? &answer_at(*answers, now_us()) : nullptr;
    }
    /// Mean time from one frame to the next.
    [[nodiscard]] std::chrono::microseconds recorded_tick() const {
        const RecordedAnswers* const frames = record_->answers("hdBeginFrame", "-");
        if (frames == nullptr || frames->size() < 2) return kUsualTick;
        const std::int64_t span_us = frames->back().at_us - frames->front().at_us;
        const auto count = static_cast<std::int64_t>(frames->size()) - 1;
        return std::clamp(std::chrono::microseconds(span_us / count), kUsualTick / 10,
                          10 * kUsualTick);
    }

    const std::shared_ptr<const CallRecord> record_;
    const RecordedAnswers* const errors_;
    std::mutex mutex_{};
    std::optional<Clock::time_point> begun_{};  // from here on guarded by mutex_
    std::size_t told_{0};                       // errors
    bool unknown_{false};                       // the last value is not in the record
    HdCallback callback_{nullptr};
    void* data_{nullptr};
    std::jthread servo_{};
};

}  // namespace

std::function<HdLibrary(const HdLibrary&)> recording_in(const std::filesystem::path& file,
                                                        const std::string& library) {
    const auto recorder = std::make_shared<CallRecorder>(file, kKind, library);
    return [recorder](const HdLibrary& functions) { return recorded(functions, recorder); };
}

bool is_record(const std::filesystem::path& file) {
    return is_call_record(file, kKind);
}

LoadedLibrary play_record(const std::filesystem::path& file) {
    FoundRecord found = read_call_record(file, kKind, answered_by, true);
    LoadedLibrary loaded{.file = file.string(), .trouble = found.trouble};
    if (found.record == nullptr) return loaded;
    const auto played = std::make_shared<PlayedLibrary>(std::move(found.record));
    HdLibrary& functions = loaded.functions;
    functions.init_device = [played](const char*) { return played->open(); };
    functions.get_error = [played] { return played->next_error(); };
    functions.get_booleans = [played](HdEnum what, std::uint8_t* values) {
        played->read("hdGetBooleanv", what, values);
    };
    functions.get_integers = [played](HdEnum what, int* values) {
        played->read("hdGetIntegerv", what, values);
    };
    functions.get_doubles = [played](HdEnum what, double* values) {
        played->read("hdGetDoublev", what, values);
    };
    functions.get_longs = [played](HdEnum what, long* values) {
        played->read("hdGetLongv", what, values);
    };
    functions.get_string = [played](HdEnum what) { return played->text(what); };
    functions.check_calibration = [played] { return played->calibration(); };
    functions.schedule = [played](HdCallback callback, void* data, unsigned short) {
        return played->schedule(callback, data);
    };
    functions.start_scheduler = [played] { played->start(); };
    functions.stop_scheduler = [played] { played->stop(); };
    functions.set_doubles = [](HdEnum, const double*) {};
    functions.unschedule = [](HdSchedule) {};
    functions.disable_device = functions.make_current = functions.begin_frame =
        functions.end_frame = [](HdHandle) {};
    functions.enable = functions.disable = functions.update_calibration = [](HdEnum) {};
    loaded.loaded = true;
    return loaded;
}

}  // namespace dibhr::openhaptics
