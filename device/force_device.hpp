// What every force device gives as data, so that the program knows none of them by name.
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

class CheckGuide;
struct CheckResult;

/// Names and what they are, as a session and its reports keep them: "serial", "SIM00001".
using DeviceFacts = std::vector<std::pair<std::string, std::string>>;

/// A line of the panel.
struct DeviceLine {
    const char* label{""};  ///< "Replies"; empty: a remark
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

/// What a person waits for.
struct DeviceProgress {
    double part;       ///< 0 .. 1
    std::string text;  ///< "40 %, try 2"
};

/// An axis that is homed by pulling the grip all the way out and pushing it in.
struct HomedAxis {
    const char* name;
    bool homed;
    int counts;  ///< of its encoder
};

/// The firmware that a device takes from a person.
struct DeviceFirmware {
    std::string name{};     ///< of the file that is loaded when it is needed; empty: none
    std::string trouble{};  ///< why the kept file cannot be used
    bool wanted{false};     ///< it is the next step
};

/// How far a device has come, and what people are told of it.
struct DeviceState : DeviceStatus {
    int stage{0};              ///< another number at each of its stages; 0: the first one
    bool absent{true};         ///< none is there
    bool needs_person{false};  ///< it waits for something that a person has to do
    bool may_be_ready{false};  ///< before the next picture
    bool ready{false};         ///< poses and forces
    std::string id{};          ///< that tells it from others of its kind; empty: not known
    std::string full_name{};   ///< in a session that it touched; empty: its specification's
    DeviceFacts facts{};       ///< known only once it has been found

    // On the panel, in this order:
    DeviceLine who{};                          ///< "Falcon", and its serial
    std::optional<DeviceFirmware> firmware{};  ///< nothing: it takes none
    std::optional<DeviceProgress> progress{};
    std::vector<HomedAxis> homing{};           ///< empty: none needs to be homed
    std::optional<DeviceLamp> lamp{};          ///< without a force
    std::optional<DeviceLamp> pushing_lamp{};  ///< while a force is sent
    std::vector<DeviceLine> lines{};

    /// Of the poses in the ticks in which this hand touched, since the start; nothing: not counted.
    std::optional<PoseAges> ages{};
};

/// Looks for its device from construction on, and again whenever it is lost, on a thread of its
/// own.
class ForceDevice : public Device {
  public:
    /// The haptic thread's, of the last read(): this hand touches, though it may be clutched, or
    /// its pose too old.
    [[nodiscard]] virtual bool in_hand() const noexcept = 0;

    // The window thread's; `settings` are of its own kind:

    [[nodiscard]] virtual DeviceState state() = 0;
    /// Whether publish() has something new.
    [[nodiscard]] virtual bool is_retuned(const DeviceSettings& settings,
                                          const HandTuning& hand) const = 0;
    /// To the next tick; to be called after the haptic loop was told to ramp.
    virtual void publish(const DeviceSettings& settings, const HandTuning& hand) = 0;
    /// Keeps what a person gives for it, and uses it at the next need. Its name; empty: it takes
    /// none. Throws InputError.
    virtual std::string use_firmware(const std::filesystem::path& /*file*/) { return {}; }
};

/// What a person gave for one start.
struct DeviceGiven {
    std::string which{};           ///< of several: a serial, an id; empty: as the settings have it
    std::filesystem::path file{};  ///< --firmware; empty: the kept one
};

/// What became of looking for devices of one kind.
struct DevicesFound {
    bool usable{false};     ///< one can be used
    std::string refusal{};  ///< why none of those that are there can be; empty: none is there
};

/// What the record of a check begins with.
struct CheckPaper {
    std::filesystem::path record{};  ///< empty: KIND-check-NAME-DATE.json in the current folder
    DeviceFacts facts{};             ///< what else belongs into it, such as the program's version
};

/// Takes a line for people, without its end.
using TellLine = std::function<void(const std::string&)>;

/// Of a kind whose settings are `Settings`.
template <typename Settings>
[[nodiscard]] std::unique_ptr<DeviceSettings> make_settings() {
    return std::make_unique<Settings>();
}

/// One kind of force device. All functions but make() throw DeviceError where they cannot look.
struct ForceDeviceKind {
    /// On the command line; of its table in the settings, its facts and the records of its check.
    const char* name;
    const char* title;      ///< "Novint Falcon"
    const char* called;     ///< behind "the": "Falcon"
    const char* article;    ///< "a Falcon"
    const char* which;      ///< what tells several apart, on the command line: "SERIAL"
    const char* known{""};  ///< how well it is known how it moves, behind a sentence; empty: well
    const char* no_pose;    ///< what to do when it touches and has no pose
    /// Its check counts on settings that protect a hand: only what a person has agreed to holds.
    bool check_needs_consent{false};

    std::unique_ptr<DeviceSettings> (*make_settings)();
    std::unique_ptr<ForceDevice> (*make)(const DeviceSettings& settings, const DeviceGiven& given);
    /// Keeps the firmware that a person gives for it. Its name. Throws InputError. Null: it takes
    /// none.
    std::string (*keep_firmware)(const std::filesystem::path& file) = nullptr;
    /// What a service keeps of the device with that id for all programs: for a second or two. Null:
    /// nothing.
    std::vector<DeviceLine> (*ask_kept)(const DeviceSettings& settings,
                                        const std::string& id) = nullptr;

    // Of those that are there now:

    /// Why the one that is meant cannot be had; empty: it can, though it may want something of its
    /// person.
    std::string (*why_none)(const DeviceSettings& settings, const DeviceGiven& given);
    /// One is attached, whether or not it can be used.
    bool (*attached)(const DeviceSettings& settings);
    /// Tells of all of them, and what each lacks.
    DevicesFound (*survey)(const DeviceSettings& settings, const TellLine& tell);
    /// Tells a person who is about to touch what there is, and changes nothing of it. True: one can
    /// be used, or may be.
    bool (*glance)(const DeviceSettings& settings, const TellLine& tell);
    /// Leads a person through what is to be measured. Throws InputError, too. Null: nothing is.
    CheckResult (*check)(const DeviceSettings& settings, const CheckPaper& paper,
                         const TellLine& tell, CheckGuide& guide) = nullptr;
    /// Stands in for one until `orders` end. Null: nothing can.
    void (*simulate)(const DeviceSettings& settings, std::istream& orders,
                     const TellLine& tell) = nullptr;
};

}  // namespace dibhr
