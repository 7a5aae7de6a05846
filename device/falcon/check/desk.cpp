// Questions to the person, while the Falcon is kept company.
#include "device/falcon/check/desk.hpp"

#include <charconv>
#include <chrono>
#include <string_view>
#include <system_error>
#include <thread>

namespace dibhr::falcon {

namespace {

constexpr std::chrono::milliseconds kPause{10};  // the program never falls silent

std::optional<double> number_of(std::string_view text) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::string rounded(double value) {
    return std::to_string(static_cast<long>(value));
}

}  // namespace

void CheckDesk::quit_if_interrupted() const {
    if (guide.interrupted()) throw PersonQuits{};
}

std::optional<std::string> CheckDesk::answer() {
    quit_if_interrupted();
    auto typed = guide.next_line();
    if (typed == "q") throw PersonQuits{};
    if (typed == "s") throw StepSkipped{};
    return typed;
}

void CheckDesk::keep_talking() {
    if (falcon.answering()) {
        const Command nothing{.motor = {}, .led = Led::blue, .homing = true};
        (void)falcon.talk().exchange(nothing, kPause);
    } else {
        std::this_thread::sleep_for(kPause);
    }
}

std::optional<std::string> CheckDesk::line() {
    for (;;) {
        if (auto typed = answer()) return typed;
        if (guide.input_ended()) return std::nullopt;
        keep_talking();
    }
}

void CheckDesk::begin(const std::string& question) {
    guide.ask(question);
    (void)line();
}

void CheckDesk::wait_for(const std::string& question) {
    (void)word(question);
}

std::string CheckDesk::word(const std::string& question) {
    guide.ask(question);
    auto typed = line();
    if (!typed) throw StepSkipped{};
    return *typed;
}

std::optional<double> CheckDesk::number(const std::string& question, double lowest,
                                        double highest) {
    for (;;) {
        const std::string typed = word(question);
        if (typed.empty()) return std::nullopt;
        const auto value = number_of(typed);
        if (value && *value >= lowest && *value <= highest) return value;
        guide.say("a number from " + rounded(lowest) + " to " + rounded(highest) +
                  ", please, or Enter alone when there is none");
    }
}

}  // namespace dibhr::falcon
