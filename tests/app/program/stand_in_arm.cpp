// The stand-ins for Force Dimension's and 3D Systems' library.
#include "tests/app/program/stand_in_arm.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/device/forcedimension/stand_in_page.hpp"
#include "tests/device/openhaptics/arm_page.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/shared_page.hpp"

namespace dibhr::test {

namespace {

constexpr std::chrono::seconds kPatience{60};  // only reached by a failure
constexpr double kMillimetre = 1e-3;
constexpr double kRest_mm = 30.0;  // before the relief

std::int64_t now_ns() {
    return std::chrono::steady_clock::now().time_since_epoch().count();
}

class Omega final : public StandInArm {
  public:
    explicit Omega(const std::filesystem::path& file) : page_(file, forcedimension::kPageVariable) {
        unit().plugged = true;
        unit().serial = 1234;
    }

    [[nodiscard]] const char* kind() const override { return "forcedimension"; }
    void place(double right_mm, double out_mm) override {
        unit().position_m[1] = right_mm * kMillimetre;
        unit().position_m[0] = out_mm * kMillimetre;
    }
    void press_buttons(unsigned bits) override { unit().buttons = bits; }
    [[nodiscard]] double newton() const override {
        return std::sqrt(unit().square_newton(now_ns()));
    }
    [[nodiscard]] double strongest_newton() const override { return unit().strongest_newton; }
    [[nodiscard]] std::int64_t set_at_ns() const override { return unit().newton_at_ns; }
    [[nodiscard]] bool is_open() const override { return unit().open; }
    [[nodiscard]] bool force_is_on() const override { return unit().force_on; }
    [[nodiscard]] int wrong_calls() const override { return page_->wrong_calls; }
    void set_watchdog(bool on) override { unit().has_watchdog = on; }
    void unplug() override { unit().plugged = false; }
    void occupy() override { unit().in_use = true; }
    void lose_position() override { unit().initialised = false; }
    void age_library() override { page_->version[1] = 2; }

  private:
    [[nodiscard]] forcedimension::Unit& unit() const { return page_->units[0]; }

    SharedPage<forcedimension::Page> page_;
};

class Touch final : public StandInArm {
  public:
    explicit Touch(const std::filesystem::path& file) : page_(file, openhaptics::kPageVariable) {
        set_watchdog(true);
    }

    [[nodiscard]] const char* kind() const override { return "openhaptics"; }
    void place(double right_mm, double out_mm) override {
        arm().position_mm[0] = right_mm;
        arm().position_mm[2] = out_mm;
    }
    void press_buttons(unsigned bits) override { arm().buttons = static_cast<int>(bits); }
    [[nodiscard]] double newton() const override { return arm().newton(now_ns()); }
    [[nodiscard]] double strongest_newton() const override { return arm().strongest_newton; }
    [[nodiscard]] std::int64_t set_at_ns() const override { return arm().framed_at_ns; }
    [[nodiscard]] bool is_open() const override { return arm().open; }
    [[nodiscard]] bool force_is_on() const override { return arm().output; }
    [[nodiscard]] int wrong_calls() const override { return page_->wrong_calls; }
    void set_watchdog(bool on) override { arm().watchdog_ms = on ? 20 : 0; }
    void unplug() override { arm().attached = false; }
    void occupy() override { arm().in_use_error = 0x301; }
    void lose_position() override { arm().calibration = 0x5002; }

  private:
    [[nodiscard]] openhaptics::SimulatedArm& arm() const { return page_->arms[0]; }

    SharedPage<openhaptics::ArmPage> page_;
};

}  // namespace

void StandInArm::move_hand(double right_mm, double in_mm, int steps) {
    for (int k = 1; k <= steps; ++k) {
        const double part = static_cast<double>(k) / steps;
        place(right_mm_ + part * (right_mm - right_mm_), -(in_mm_ + part * (in_mm - in_mm_)));
        const std::int64_t set_at = set_at_ns();
        REQUIRE(eventually([&] { return set_at_ns() > set_at + 1'000'000; }, kPatience));
    }
    right_mm_ = right_mm;
    in_mm_ = in_mm;
}

void StandInArm::press() {
    move_hand(0.0, 7.0, 100);
    REQUIRE(eventually([this] { return newton() > 0.6; }, kPatience));
}

std::unique_ptr<StandInArm> make_stand_in(const std::string& kind, const TemporaryFolder& folder,
                                          const std::string& library) {
    const bool omega = kind == "forcedimension";
    const std::string used = !library.empty() ? library : omega ? STAND_IN_DRD : STAND_IN_HD;
    for (const char* const settings : {"dibhr", "config/dibhr"}) {
        std::filesystem::create_directories(folder / settings);
        std::ofstream(folder / settings / "settings.toml", std::ios::app)
            << '[' << kind << "]\nlibrary = \"" << used << "\"\n";
    }
    std::unique_ptr<StandInArm> arm;
    if (omega) arm = std::make_unique<Omega>(folder / "omega");
    if (!omega) arm = std::make_unique<Touch>(folder / "touch");
    arm->place(0.0, kRest_mm);
    return arm;
}

}  // namespace dibhr::test
