// Checks the states of an arm over time.
#include "device/inverse3/arm_watch.hpp"

#include <glm/geometric.hpp>

namespace dibhr::inverse3 {

namespace {

using std::chrono::milliseconds;

// README.md, Safety numbers.
constexpr milliseconds kOwnUseWindow{1000};  // `in_use` so soon after our first force is our use
constexpr milliseconds kOwnPushWindow{100};  // likewise after each rise of the force from zero
constexpr double kLeastChecked_newton = 0.3;
constexpr double kEchoShare = 0.05;  // small, because filters in the service reduce a force
constexpr milliseconds kNoEchoLimit{250};

bool is_permuted(const ArmConfig& config) noexcept {
    return !config.basis.empty() && config.basis.view() != "XYZ";
}

}  // namespace

void ArmWatch::begin() noexcept {
    const PoseTrust trust = trust_;
    *this = ArmWatch{};
    trust_ = trust;
    trust_.begin();
}

void ArmWatch::add(const Arm& arm, Time at) noexcept {
    const bool other_config = arm.config && config_ && !(*arm.config == *config_);
    if (arm.config) config_ = arm.config;
    follow_use(arm.in_use, at);
    stage_ = stage_of(arm);
    if (stands_still(arm, at) && stage_ == Stage::ready) stage_ = Stage::not_understood;
    trust_.add(arm.position_m, at, stage_ == Stage::ready && !other_config);
}

void ArmWatch::add_gap() noexcept {
    trust_.add_gap();
}

void ArmWatch::force_sent(Time at, bool pushes) noexcept {
    if (!driven_since_) driven_since_ = at;
    if (pushes && !pushes_) pushed_since_ = at;
    pushes_ = pushes;
}

Stage ArmWatch::stage_of(const Arm& arm) const noexcept {
    if (!arm.powered) return Stage::no_power;
    if (!arm.calibrated) return Stage::not_calibrated;
    if (arm.in_use && !used_by_us_) return Stage::in_use;
    if (arm.locked) return Stage::locked;
    if (config_ && is_permuted(*config_)) return Stage::other_frame;
    return arm.position_m ? Stage::ready : Stage::not_understood;
}

void ArmWatch::follow_use(bool in_use, Time at) noexcept {
    // It is not known whether `in_use` includes us: a use that begins with our force is ours.
    if (!in_use) used_by_us_ = false;
    if (in_use && !was_in_use_) {
        used_by_us_ = (driven_since_ && at - *driven_since_ < kOwnUseWindow) ||
                      (pushed_since_ && at - *pushed_since_ < kOwnPushWindow);
    }
    was_in_use_ = in_use;
}

bool ArmWatch::stands_still(const Arm& arm, Time at) noexcept {
    return arm.position_m && arm.velocity_m_per_s &&
           still_.add(*arm.position_m, glm::length(*arm.velocity_m_per_s), at);
}

void ForceEchoWatch::begin() noexcept {
    *this = ForceEchoWatch{};
}

void ForceEchoWatch::add(Vec3 sent_newton, const std::optional<Vec3>& reported_newton,
                         Time at) noexcept {
    const double sent = glm::length(sent_newton);
    if (!reported_newton || sent < kLeastChecked_newton) {
        no_echo_since_.reset();
        return;
    }
    if (glm::length(*reported_newton) >= kEchoShare * sent) {
        obeys_ = Obeys::yes;
        no_echo_since_.reset();
        return;
    }
    if (!no_echo_since_) no_echo_since_ = at;
    if (at - *no_echo_since_ >= kNoEchoLimit) obeys_ = Obeys::no;
}

}  // namespace dibhr::inverse3
