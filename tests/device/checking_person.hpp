// A person who follows the guided check of a simulated arm: moves its grip, and reads a scale.
#pragma once

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "core/files/json.hpp"
#include "core/haptics/vec.hpp"
#include "device/hand/check/console.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::test {

/// The hands of the person, on an arm in its own axes.
struct CheckingHands {
    std::function<void(Vec3 mm)> place;
    std::function<Vec3()> felt_newton;
    Vec3 right, up, towards;  ///< of length 1
};

class CheckingPerson final : public CheckConsole {
  public:
    explicit CheckingPerson(CheckingHands hands) : hands_(std::move(hands)) {}

    Request wish{Request::none};  ///< while a force acts
    std::string received{};
    double most_newton{0.0};
    double newton_at_end{0.0};  ///< the strongest left when a force had ended

    void print(const std::string& text) override { received += text + "\n"; }
    void show(const std::string& state) override { received += state + "\n"; }
    void ask(const std::string& question) override {
        received += question + "\n";
        const auto has = [&question](std::string_view part) {
            return question.find(part) != std::string::npos;
        };
        if (has("every end")) moves_ = 40;
        if (has("centimetres right")) move(30.0 * hands_.right);
        if (has("centimetres up")) move(30.0 * hands_.up);
        if (has("centimetres towards")) move(30.0 * hands_.towards);
        line_ = has("Grams")         ? std::to_string(down_newton_ / 9.80665 * 1000.0)
                : has("F and Enter") ? "f"
                : has("to the end")  ? down_newton_ > 0.1 ? "y" : "n"
                                     : "";
    }
    std::optional<std::string> next_line() override {
        if (moves_ == 0) return std::exchange(line_, std::nullopt);
        move(static_cast<double>(--moves_ % 7) * hands_.towards - at_mm_);
        return {};
    }
    bool input_ended() override { return false; }
    bool interrupted() override { return false; }
    void force_begins() override {}
    void force_ended() noexcept override {
        newton_at_end = std::max(newton_at_end, glm::length(hands_.felt_newton()));
    }
    Request request() override {
        const Vec3 felt = hands_.felt_newton();
        down_newton_ = -glm::dot(felt, hands_.up);
        most_newton = std::max(most_newton, std::abs(down_newton_));
        return wish;
    }

  private:
    void move(Vec3 way_mm) {
        at_mm_ += way_mm;
        hands_.place(at_mm_);
    }

    CheckingHands hands_;
    Vec3 at_mm_{0.0};
    std::optional<std::string> line_{};
    int moves_{0};
    double down_newton_{0.0};
};

/// What a step of the check measured, as its record has it.
inline Json measured_in(const std::filesystem::path& record, const std::string& name) {
    const Json all = Json::parse(std::ifstream(record));
    for (const Json& step : all["steps"])
        if (step["step"] == name) return step["measured"];
    FAIL("no step " << name);
    return {};
}

}  // namespace dibhr::test
