// One opened arm: prepared for forces, and left without force however it is left.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "device/forcedimension/library.hpp"
#include "device/forcedimension/status.hpp"
#include "device/forcedimension/usb_bus.hpp"

namespace dibhr::forcedimension {

/// Open during its lifetime. The destructor stops the arm and closes it: it brakes, and its force
/// is off. No other call of the library comes after the stop.
class Arm {
  public:
    Arm(std::shared_ptr<Library> library, int id) : library_(std::move(library)), id_(id) {}
    ~Arm();
    Arm(const Arm&) = delete;
    Arm& operator=(const Arm&) = delete;

    [[nodiscard]] Library& library() const noexcept { return *library_; }
    [[nodiscard]] const std::shared_ptr<Library>& shared_library() const noexcept {
        return library_;
    }
    [[nodiscard]] int id() const noexcept { return id_; }

    /// Type, serial and versions.
    void identify(Status& status) const;
    /// Sets the watchdog, the library's own limit of the force, and the gripper as a button.
    void prepare(Status& status) const;
    /// Gravity compensation, a zero force, and the motors on; false: an error.
    [[nodiscard]] bool switch_force_on() const;

  private:
    std::shared_ptr<Library> library_;
    int id_;
};

/// The arms that may be opened, as the functions that open them ask for them: indices, or, where a
/// Novint Falcon is attached, types. A Falcon is type 60, and belongs to dibhr's own driver.
class ArmSearch {
  public:
    ArmSearch(std::shared_ptr<Library> library, const UsbBus& bus)
        : library_(std::move(library)), by_type_(bus.has_falcon), count_(library_->count()) {}

    /// Attached devices, as the library counts them.
    [[nodiscard]] int count() const noexcept { return count_; }
    /// Opens the next arm; null: there is none left. Skips what cannot be opened; last_error() has
    /// the library's number for it.
    [[nodiscard]] std::unique_ptr<Arm> next();
    [[nodiscard]] int last_error() const noexcept { return last_error_; }

  private:
    [[nodiscard]] bool has_next() const noexcept;

    std::shared_ptr<Library> library_;
    bool by_type_;
    int count_;
    int place_{0};
    int last_error_{0};
};

/// Why there is no arm to use: stage and sentence.
struct NoArm {
    Stage stage{Stage::looking};
    std::string sentence{};
};
[[nodiscard]] NoArm why_no_arm(const ArmSearch& search, const UsbBus& bus,
                               const std::string& serial);

/// Why the library is missing; empty: it is not needed, because no arm is attached.
[[nodiscard]] std::string why_no_library(const UsbBus& bus);

}  // namespace dibhr::forcedimension
