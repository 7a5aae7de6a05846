// The interface of every force device, as data: the program outside device/ names no device.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/loop/device.hpp"
#include "device/hand/device_settings.hpp"
#include "device/hand/pose_ages.hpp"
#include "device/hand/state_board.hpp"

namespace dibhr {

class CheckConsole;
struct CheckResult;

/// Names and values that a session and its reports keep: "serial", "SIM00001".
using DeviceFacts = std::vector<std::pair<std::string, std::string>>;

/// A line of the Device panel.
struct DeviceLine {
    const char* label{""};  ///< "Replies"; empty: `text` is a remark
    std::string text{};
    const char* help{""};
};

/// A lamp on the device, as the driver lights it.
struct DeviceLamp {
    enum class Colour : std::uint8_t { red, green, blue };

    const char* label;  ///< "Logo"
    Colour colour;
    const char* text;  ///< "red: to be homed"
};

/// Progress of a step that the user waits for.
struct DeviceProgress {
    double part;       ///< 0 .. 1
    std::string text;  ///< "40 %, try 2"
};

/// An axis that the user homes by pulling the grip all the way out and pushing it in.
struct HomedAxis {
    const char* name;
    bool homed;
    int counts;  ///< of its encoder
};

/// The firmware that the user gives to a device.
struct DeviceFirmware {
    std::string name{};     ///< of the file that is loaded when it is needed; empty: none
    std::string trouble{};  ///< why the kept file cannot be used
    bool needed{false};     ///< the user has to give it now
};

/// What the device can do next only if the user agrees, because the arm then moves by itself, or
/// its force returns.
struct DeviceOffer {
    /// A new number for every offer: an agreement is valid for this offer alone, never for another
    /// start, another device or another library.
    std::uint64_t number{0};
    std::string label{};    ///< "Initialise the arm"
    std::string warning{};  ///< what happens then, and what the user does first; empty: nothing
};

/// The stage of a device, and what the panel shows of it.
struct DeviceState : DeviceStatus {
    int stage{0};              ///< a number per stage; 0: the first one
    bool absent{true};         ///< no such device is attached
    bool needs_person{false};  ///< the device waits for an action of the user
    bool may_be_ready{false};  ///< the device may become ready before the next picture
    bool ready{false};         ///< poses and forces
    std::string id{};          ///< serial or ID; empty: not known
    std::string full_name{};   ///< for the session; empty: the specification's name
    DeviceFacts facts{};       ///< valid only once the device has been found

    // On the panel, in this order:
    DeviceLine name_line{};                    ///< "Falcon", and its serial
    std::optional<DeviceFirmware> firmware{};  ///< nothing: the device takes none
    std::optional<DeviceOffer> offer{};
    std::optional<DeviceProgress> progress{};
    std::vector<HomedAxis> homing{};           ///< empty: no axis needs to be homed
    std::optional<DeviceLamp> lamp{};          ///< without a force
    std::optional<DeviceLamp> pushing_lamp{};  ///< while a force is sent
    std::vector<DeviceLine> lines{};

    /// Pose ages of all ticks in which this device touched, since the start; nothing: not counted.
    std::optional<PoseAges> ages{};
};

/// Searches for its device from construction on, and again whenever the device is lost, on a
/// thread of its own.
class ForceDevice : public Device {
  public:
    /// For the haptic thread, as of the last read(): this device can touch, even if it is clutched
    /// now or its pose is too old.
    [[nodiscard]] virtual bool can_touch() const noexcept = 0;

    // For the window thread; `settings` are of the device's own kind:

    [[nodiscard]] virtual DeviceState state() = 0;
    /// Whether the settings differ from the published ones.
    [[nodiscard]] virtual bool has_new_tuning(const DeviceSettings& settings,
                                              const HandTuning& hand) const = 0;
    /// Publishes the settings to the next tick. Call it after the haptic loop was set to ramp.
    virtual void publish(const DeviceSettings& settings, const HandTuning& hand) = 0;
    /// Keeps a copy of the file, and loads it when the device next needs firmware. Returns the name
    /// of the firmware; empty: the device takes none. Throws InputError.
    virtual std::string use_firmware(const std::filesystem::path& /*file*/) { return {}; }
    /// The user agrees to DeviceState::offer. Ignored unless it is the present offer.
    virtual void agree_to(std::uint64_t /*offer*/) {}
};

/// What the command line gives for one start of the program.
struct DeviceArguments {
    std::string which{};           ///< of several: a serial, an ID; empty: as in the settings
    std::filesystem::path file{};  ///< --firmware; empty: the kept file
};

/// Result of a survey of the devices of one kind.
struct DevicesFound {
    bool usable{false};     ///< one can be used
    std::string refusal{};  ///< why no attached device can be used; empty: none is attached
};

/// Where the record of a check is written, and what its head contains.
struct CheckRecordOptions {
    std::filesystem::path record{};  ///< empty: KIND-check-NAME-DATE.json in the current folder
    DeviceFacts facts{};             ///< more entries, such as the program's version
};

/// Prints a line for the user; the line has no newline at its end.
using PrintLine = std::function<void(const std::string&)>;

/// ForceDeviceKind::make_settings of a kind with these `Settings`.
template <typename Settings>
[[nodiscard]] std::unique_ptr<DeviceSettings> make_settings() {
    return std::make_unique<Settings>();
}

/// One kind of force device. All functions but make() throw DeviceError where they cannot search.
struct ForceDeviceKind {
    /// On the command line, in the settings file, in facts and in records of a check: "falcon".
    const char* name;
    const char* title;       ///< "Novint Falcon"
    const char* short_name;  ///< behind "the": "Falcon"
    const char* article;     ///< "a Falcon"
    const char* which;       ///< placeholder of the ID on the command line: "SERIAL"
    const char* known{""};   ///< appended to a sentence where its dynamics are assumed; else empty
    const char* no_pose_advice;  ///< shown while the device touches and has no pose: what to do
    /// Its check relies on settings that protect a hand: only consented values are used in it.
    bool check_needs_consent{false};

    std::unique_ptr<DeviceSettings> (*make_settings)();
    std::unique_ptr<ForceDevice> (*make)(const DeviceSettings& settings,
                                         const DeviceArguments& given);
    /// Keeps a copy of a firmware file and returns its name. Throws InputError. Null: this kind
    /// takes no firmware.
    std::string (*keep_firmware)(const std::filesystem::path& file) = nullptr;
    /// Settings of the device `id` that its service keeps for all programs. Takes a second or two.
    /// Null: there are none.
    std::vector<DeviceLine> (*read_kept_settings)(const DeviceSettings& settings,
                                                  const std::string& id) = nullptr;

    // About the devices that are attached now:

    /// Why the requested device cannot be opened; empty: it can, though the user may have to do
    /// something before it is ready.
    std::string (*why_none)(const DeviceSettings& settings, const DeviceArguments& given);
    /// One is attached, whether or not it can be used.
    bool (*attached)(const DeviceSettings& settings);
    /// Prints all of them, and what each lacks.
    DevicesFound (*survey)(const DeviceSettings& settings, const PrintLine& print);
    /// Prints which devices are attached, without changing their state. True: one can be used, or
    /// may be usable.
    bool (*print_attached)(const DeviceSettings& settings, const PrintLine& print);
    /// Guides the user through the measurements of a check. Throws InputError, too. Null: this kind
    /// has no check.
    CheckResult (*check)(const DeviceSettings& settings, const CheckRecordOptions& record_options,
                         const PrintLine& print, CheckConsole& console) = nullptr;
    /// Lets the arm of a device initialise itself, after the user agreed. Null: none does.
    void (*initialise)(const DeviceSettings& settings, const PrintLine& print,
                       CheckConsole& console) = nullptr;
    /// Records in a text file what the device's library is asked and answers, for 10 s. Throws
    /// InputError, too. Null: it has no library.
    void (*record)(const DeviceSettings& settings, const std::filesystem::path& file,
                   const PrintLine& print) = nullptr;
    /// Plays such a file as a device, and prints its stages. False: it is not of this kind. Null:
    /// as of `record`.
    bool (*play)(const std::filesystem::path& file, const PrintLine& print) = nullptr;
    /// Simulates a device, commanded line by line, until the stream ends. Null: no simulation.
    void (*simulate)(const DeviceSettings& settings, std::istream& input,
                     const PrintLine& print) = nullptr;
};

}  // namespace dibhr
