// What every step of the check works on: user, Falcon, options and findings.
#pragma once

#include <chrono>
#include <optional>
#include <thread>

#include "device/falcon/check/check.hpp"
#include "device/falcon/check/falcon.hpp"
#include "device/falcon/check/record.hpp"
#include "device/hand/check/questions.hpp"

namespace dibhr::falcon {

/// While a question is open, the Falcon gets commands without force.
struct CheckContext final : CheckQuestions {
    CheckContext(CheckConsole& person, CheckedFalcon& checked, const CheckOptions& chosen)
        : CheckQuestions(person), falcon(checked), options(chosen) {}

    CheckedFalcon& falcon;
    const CheckOptions& options;
    CheckFindings findings{kOpenQuestions, "falcon"};
    std::optional<double> counts_per_newton_metre{};  ///< once it was measured

  private:
    void keep_alive() override {
        constexpr std::chrono::milliseconds kPause{10};
        if (falcon.answering()) {
            (void)falcon.exchange(no_force(Led::blue), kPause);
        } else {
            std::this_thread::sleep_for(kPause);
        }
    }
};

// The steps, each in the file of its name (check_silence with check_force). They add their results
// to `measured`; they throw StepSkipped, PersonQuits, and DeviceError when the Falcon fails.
void check_identity(CheckContext& context, Json& measured);
void check_upload(CheckContext& context, Json& measured);
void check_rate(CheckContext& context, Json& measured);
void check_homing(CheckContext& context, Json& measured);
void check_stops(CheckContext& context, Json& measured);
void check_silence(CheckContext& context, Json& measured);
void check_force(CheckContext& context, Json& measured);
void check_buttons(CheckContext& context, Json& measured);
void check_plugs(CheckContext& context, Json& measured);

/// Returns when all three axes are homed; guides the user through homing where needed.
void home_with_person(CheckContext& context, Json& measured);

}  // namespace dibhr::falcon
