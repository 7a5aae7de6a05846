// A simulated service, an Inverse3 in a haptic loop, and the forces that the service received.
#pragma once

#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "device/inverse3/inverse3_device.hpp"
#include "device/inverse3/simulated/service.hpp"
#include "tests/device/pressing_device.hpp"

namespace dibhr::test::inverse3 {

using namespace dibhr::inverse3;
using dibhr::test::TickingDevice;
using std::chrono::milliseconds;

inline ConnectionOptions options_for(const simulated::Service& service) {
    ConnectionOptions options;
    options.port = service.port();
    options.older_port = service.older_port();
    options.installed_as = {"/nowhere"};
    return options;
}

/// Of a service of 1 kHz: half of the exchanges with one that answers at once.
inline simulated::Scene usual_scene() {
    simulated::Scene scene;
    scene.behaviour.tick = milliseconds(1);
    return scene;
}

struct RunningService {
    explicit RunningService(simulated::Scene scene) : service(std::move(scene)) {}

    simulated::Service service;
};

class ServiceDesk : public RunningService, public PressingDevice<Inverse3Device> {
  public:
    explicit ServiceDesk(simulated::Scene scene = usual_scene(), const std::string& device = {})
        : RunningService(std::move(scene)), PressingDevice([&] {
              ConnectionOptions options = options_for(service);
              options.device = device;
              return options;
          }()) {}

    bool press() {
        return tick_until([&] { return loop.reading.ready && reaches_full_force(); });
    }
    /// A part of it, which is there sooner.
    bool begins_to_press() {
        return tick_until(
            [&] { return loop.reading.ready && glm::length(loop.force_newton) > 0.3; });
    }
    /// What the simulated motors do.
    [[nodiscard]] Vec3 felt_newton() {
        return service.with([](simulated::Scene& scene) {
            scene.forget_old_forces(simulated::Clock::now());
            return scene.arms.empty() ? Vec3{0.0} : scene.arms.front().force_newton;
        });
    }
    /// The longest force that came more than `grace` after `since`.
    [[nodiscard]] double strongest_after(simulated::Clock::time_point since,
                                         milliseconds grace) const {
        double strongest = 0.0;
        for (const simulated::ReceivedMessage& one : service.received()) {
            if (one.at > since + grace) {
                strongest = std::max(strongest, glm::length(one.force_newton));
            }
        }
        return strongest;
    }

  private:
    [[nodiscard]] bool reaches_full_force() const {
        return glm::length(loop.force_newton) > 0.99 * glm::length(pressed_newton);
    }
};

}  // namespace dibhr::test::inverse3
