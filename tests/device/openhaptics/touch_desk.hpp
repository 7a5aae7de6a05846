// A simulated arm below the stand-in library, a Touch in a haptic loop, and the forces that the arm
// got.
#pragma once

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <new>
#include <string>
#include <vector>

#include "device/openhaptics/openhaptics_device.hpp"
#include "tests/device/openhaptics/arm_page.hpp"
#include "tests/device/pressing_device.hpp"
#include "tests/support/environment_variable.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::test::openhaptics {

using namespace dibhr::openhaptics;
using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

/// A page in a file of its own, which the stand-in library finds.
class ArmBench {
  public:
    ArmBench() {
        std::ofstream(file()).close();
        std::filesystem::resize_file(file(), sizeof(ArmPage));
        page_ = new (map_arm_page(file().c_str())) ArmPage;
    }
    ~ArmBench() { ::munmap(page_, sizeof(ArmPage)); }
    ArmBench(const ArmBench&) = delete;
    ArmBench& operator=(const ArmBench&) = delete;

    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    [[nodiscard]] ArmPage& page() noexcept { return *page_; }
    [[nodiscard]] SimulatedArm& arm(std::size_t k = 0) noexcept { return page_->arms[k]; }
    void move_to(Vec3 mm) noexcept {
        for (int axis = 0; axis < 3; ++axis)
            arm().position_mm[static_cast<std::size_t>(axis)] = mm[axis];
    }
    /// What the motors hold.
    [[nodiscard]] Vec3 felt_newton(std::size_t k = 0) noexcept {
        const Axes& force = arm(k).force_newton;
        return {force[0].load(), force[1].load(), force[2].load()};
    }
    /// The forces of all frames since then.
    [[nodiscard]] std::vector<SentForce> sent_since(Clock::time_point since) const {
        const double t_s = std::chrono::duration<double>(since.time_since_epoch()).count();
        std::vector<SentForce> sent;
        const std::uint64_t count = page_->sent_count;
        const std::uint64_t kept = std::min<std::uint64_t>(count, ArmPage::kMostSent);
        for (std::uint64_t k = count - kept; k < count; ++k) {
            const SentForce& one = page_->sent[k % ArmPage::kMostSent];
            if (one.t_s > t_s) sent.push_back(one);
        }
        return sent;
    }

  private:
    TemporaryFolder folder_{};
    std::filesystem::path file_{folder_ / "arms"};
    ArmPage* page_{nullptr};
};

inline double length_of(const SentForce& sent) {
    return glm::length(Vec3{sent.newton[0], sent.newton[1], sent.newton[2]});
}

/// The strongest of these forces.
inline double strongest(const std::vector<SentForce>& sent) {
    double most = 0.0;
    for (const SentForce& one : sent) most = std::max(most, length_of(one));
    return most;
}

inline ConnectionOptions options_for(const std::string& name = {}) {
    return {.name = name, .library = STAND_IN_LIBRARY};
}

/// The arm, where the library finds it.
struct FoundArm {
    /// `prepare` changes the page before the device is searched for.
    explicit FoundArm(const std::function<void(ArmPage&)>& prepare) {
        if (prepare) prepare(bench.page());
    }

    ArmBench bench{};
    EnvironmentVariable page_variable{kPageVariable, bench.file().c_str()};
};

class TouchDesk : public FoundArm, public PressingDevice<OpenhapticsDevice> {
  public:
    explicit TouchDesk(const std::string& name = {},
                       const std::function<void(ArmPage&)>& prepare = {})
        : FoundArm(prepare), PressingDevice(options_for(name)) {
        pressed_newton = {0.0, 0.0, 0.6};
    }

    bool press() {
        return tick_until([&] {
            return loop.reading.ready &&
                   glm::length(bench.felt_newton()) > 0.99 * glm::length(pressed_newton);
        });
    }
    /// A part of it, which is there sooner.
    bool begins_to_press() {
        return tick_until(
            [&] { return loop.reading.ready && glm::length(bench.felt_newton()) > 0.1; });
    }
};

}  // namespace dibhr::test::openhaptics
