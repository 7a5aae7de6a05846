// What every force device gives as data, so that the program knows none of them by name.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/loop/device.hpp"
#include "device/hand/buttons.hpp"
#include "device/hand/device_settings.hpp"

namespace dibhr {

class CheckGuide;
struct CheckResult;

/// Names and what they are, as a session and its reports keep them: "serial", "SIM00001".
using DeviceFacts = std::vector<std::pair<std::string, std::string>>;

/// How far a device has come, and what people are told of it.
struct DeviceState {
    int stage{0};              ///< another number at each of its stages
    std::string sentence{};    ///< what is, and what to do next
    bool trouble{false};       ///< the sentence tells of something that went wrong
    bool absent{false};        ///< none is there
    bool needs_person{false};  ///< it waits for something that a person has to do
    bool may_be_ready{false};  ///< before the next picture
    bool ready{false};         ///< poses and forces
    std::string unguarded{};   ///< why nobody sends zero if the program is killed
    ButtonPresses presses{};
    ButtonPressTimes pressed_at{};
    DeviceFacts facts{};  ///< known only once it has been found
};

/// Looks for its device from construction on, and again whenever it is lost, on a thread of its
/// own.
class ForceDevice : public Device {
  public:
    /// The haptic thread's, of the last read(): this hand touches, though it may be clutched, or
    /// its pose too old.
    [[nodiscard]] virtual bool in_hand() const noexcept = 0;
    /// Any thread's but the haptic one.
    [[nodiscard]] virtual DeviceState state() const = 0;
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

/// One kind of force device. All functions but make() throw DeviceError where they cannot look.
struct ForceDeviceKind {
    /// On the command line; of its table in the settings, its facts and the records of its check.
    const char* name;
    const char* title;    ///< "Novint Falcon"
    const char* article;  ///< "a Falcon"
    const char* which;    ///< what tells several apart, on the command line: "SERIAL"
    const char* known;    ///< how well it is known how it moves, behind a sentence; empty: well
    /// Its check counts on settings that protect a hand: only what a person has agreed to holds.
    bool check_needs_consent;

    std::unique_ptr<DeviceSettings> (*make_settings)();
    std::unique_ptr<ForceDevice> (*make)(const DeviceSettings& settings, const DeviceGiven& given);
    /// Keeps what a person gives for it. Throws InputError. Null: there is no such file.
    void (*keep_file)(const std::filesystem::path& file);

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
    /// Leads a person through what is to be measured. Throws InputError, too.
    CheckResult (*check)(const DeviceSettings& settings, const CheckPaper& paper,
                         const TellLine& tell, CheckGuide& guide);
    /// Stands in for one until `orders` end. Null: nothing can.
    void (*simulate)(const DeviceSettings& settings, std::istream& orders, const TellLine& tell);
};

}  // namespace dibhr
