// Loads Force Dimension's library and calls its functions with their C types.
#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "device/forcedimension/calls.hpp"
#include "device/forcedimension/record.hpp"
#include "device/makers_library.hpp"

namespace dibhr::forcedimension {

namespace {

using uchar = unsigned char;

/// As the library declares them; `char`: the device's ID.
struct Functions {
    void (*sdk_version)(int*, int*, int*, int*){nullptr};
    int (*device_count)(){nullptr};
    int (*open_index)(char){nullptr};
    int (*open_type)(int){nullptr};
    int (*close)(char){nullptr};
    int (*stop)(char){nullptr};
    int (*type)(char){nullptr};
    int (*serial)(unsigned short*, char){nullptr};
    int (*controller_version)(double*, char){nullptr};
    bool (*has_gripper)(char){nullptr};
    bool (*is_left_handed)(char){nullptr};
    int (*position)(double*, double*, double*, char){nullptr};
    int (*status)(int*, char){nullptr};
    unsigned (*button_mask)(char){nullptr};
    int (*set_force)(double, double, double, double, double, double, double, char){nullptr};
    int (*enable_force)(uchar, char){nullptr};
    int (*set_gravity_compensation)(int, char){nullptr};
    int (*set_max_force)(double, char){nullptr};
    int (*emulate_button)(uchar, char){nullptr};
    int (*enable_expert_mode)(){nullptr};
    int (*set_watchdog)(uchar, char){nullptr};
    int (*get_watchdog)(uchar*, char){nullptr};
    int (*reset)(char){nullptr};
    int (*last_error)(){nullptr};
    // Of libdrd alone:
    bool (*is_supported)(char){nullptr};
    bool (*is_initialised)(char){nullptr};
    int (*auto_initialise)(char){nullptr};
    int (*stop_regulation)(bool, char){nullptr};
};

/// Returns the name of a function that is missing, or nothing.
std::string take_functions(void* library, Functions& f) {
    LibrarySymbols symbols(library);
    symbols.optional(f.is_supported, "drdIsSupported");
    symbols.optional(f.is_initialised, "drdIsInitialized");
    symbols.optional(f.auto_initialise, "drdAutoInit");
    symbols.optional(f.stop_regulation, "drdStop");
    const bool drd = f.is_supported != nullptr && f.is_initialised != nullptr &&
                     f.auto_initialise != nullptr && f.stop_regulation != nullptr;
    if (!drd) f.auto_initialise = nullptr;
    symbols.required(f.open_index, drd ? "drdOpenID" : "dhdOpenID");
    symbols.required(f.close, drd ? "drdClose" : "dhdClose");
    symbols.required(f.sdk_version, "dhdGetSDKVersion");
    symbols.required(f.device_count, "dhdGetDeviceCount");
    symbols.required(f.open_type, "dhdOpenType");
    symbols.required(f.stop, "dhdStop");
    symbols.required(f.type, "dhdGetSystemType");
    symbols.required(f.serial, "dhdGetSerialNumber");
    symbols.required(f.controller_version, "dhdGetVersion");
    symbols.required(f.has_gripper, "dhdHasGripper");
    symbols.required(f.is_left_handed, "dhdIsLeftHanded");
    symbols.required(f.position, "dhdGetPosition");
    symbols.required(f.status, "dhdGetStatus");
    symbols.required(f.button_mask, "dhdGetButtonMask");
    symbols.required(f.set_force, "dhdSetForceAndTorqueAndGripperForce");
    symbols.required(f.enable_force, "dhdEnableForce");
    symbols.required(f.set_gravity_compensation, "dhdSetGravityCompensation");
    symbols.required(f.set_max_force, "dhdSetMaxForce");
    symbols.required(f.emulate_button, "dhdEmulateButton");
    symbols.required(f.enable_expert_mode, "dhdEnableExpertMode");
    symbols.required(f.set_watchdog, "dhdSetWatchdog");
    symbols.required(f.get_watchdog, "dhdGetWatchdog");
    symbols.required(f.reset, "dhdReset");
    symbols.required(f.last_error, "dhdErrorGetLast");
    return symbols.missing();
}

int answer(int result, double value, std::span<double> answered) {
    answered[0] = value;
    return result;
}

class LoadedCalls final : public Calls {
  public:
    LoadedCalls(Functions functions, std::string file)
        : functions_(functions), file_(std::move(file)) {}

    int call(Function function, int id, std::span<const double> given,
             std::span<double> answered) override;
    [[nodiscard]] bool by_hand_only() const noexcept override {
        return functions_.auto_initialise == nullptr;
    }
    [[nodiscard]] const std::string& file() const noexcept override { return file_; }

  private:
    [[nodiscard]] int read(Function function, char id, std::span<double> answered) const;
    [[nodiscard]] int set(Function function, char id, std::span<const double> given) const;

    const Functions functions_;
    const std::string file_;
};

int LoadedCalls::call(Function function, int id, std::span<const double> given,
                      std::span<double> answered) {
    const auto device = static_cast<char>(id);
    return given.empty() ? read(function, device, answered) : set(function, device, given);
}

int LoadedCalls::read(Function function, char id, std::span<double> answered) const {
    const Functions& f = functions_;
    switch (function) {
        case Function::sdk_version: {
            std::array<int, 4> part{};
            f.sdk_version(&part[0], &part[1], &part[2], &part[3]);
            std::copy(part.begin(), part.end(), answered.begin());
            return 0;
        }
        case Function::serial: {
            unsigned short serial = 0;
            const int result = f.serial(&serial, id);
            return answer(result, serial, answered);
        }
        case Function::controller_version:
            return f.controller_version(answered.data(), id);
        case Function::position:
            return f.position(&answered[0], &answered[1], &answered[2], id);
        case Function::status: {
            std::array<int, kMostNumbers> values{};
            const int result = f.status(values.data(), id);
            std::copy(values.begin(), values.end(), answered.begin());
            return result;
        }
        case Function::get_watchdog: {
            uchar periods = 0;
            const int result = f.get_watchdog(&periods, id);
            return answer(result, periods, answered);
        }
        case Function::device_count:
            return f.device_count();
        case Function::close:
            return f.close(id);
        case Function::stop:
            return f.stop(id);
        case Function::type:
            return f.type(id);
        case Function::has_gripper:
            return f.has_gripper(id) ? 1 : 0;
        case Function::is_left_handed:
            return f.is_left_handed(id) ? 1 : 0;
        case Function::button_mask:
            return static_cast<int>(f.button_mask(id) & 0xFU);
        case Function::enable_expert_mode:
            return f.enable_expert_mode();
        case Function::reset:
            return f.reset(id);
        case Function::last_error:
            return f.last_error();
        case Function::is_supported:
            return f.is_supported != nullptr && f.is_supported(id) ? 1 : 0;
        case Function::is_initialised:
            return f.is_initialised != nullptr && f.is_initialised(id) ? 1 : 0;
        case Function::auto_initialise:
            return f.auto_initialise != nullptr ? f.auto_initialise(id) : -1;
        default:
            return -1;
    }
}

int LoadedCalls::set(Function function, char id, std::span<const double> given) const {
    const Functions& f = functions_;
    const double value = given[0];
    switch (function) {
        case Function::open_index:
            return f.open_index(static_cast<char>(value));
        case Function::open_type:
            return f.open_type(static_cast<int>(value));
        case Function::set_force:
            return f.set_force(given[0], given[1], given[2], 0.0, 0.0, 0.0, 0.0, id);
        case Function::enable_force:
            return f.enable_force(static_cast<uchar>(value), id);
        case Function::set_gravity_compensation:
            return f.set_gravity_compensation(static_cast<int>(value), id);
        case Function::set_max_force:
            return f.set_max_force(value, id);
        case Function::emulate_button:
            return f.emulate_button(static_cast<uchar>(value), id);
        case Function::set_watchdog:
            return f.set_watchdog(static_cast<uchar>(value), id);
        case Function::stop_regulation:
            return f.stop_regulation != nullptr ? f.stop_regulation(value != 0.0, id) : -1;
        default:
            return -1;
    }
}

// README.md, Where it is looked for.
MakersLibrarySearch search(const std::string& name, const std::string& chosen) {
    utsname machine{};
    uname(&machine);
    MakersLibrarySearch all;
    all.names = {name + ".so.3", name + ".so"};
    all.chosen = chosen;
    all.variables = {"FDSDK", "FORCEDIM_SDK", "FD_SDK_DIR"};
    all.sub_folders = {std::string("lib/release/lin-") + machine.machine + "-gcc", "lib"};
    all.folders = {"~/.local/lib", "/usr/local/lib", "/opt/forcedimension/sdk-*"};
    all.packages = {{"libusb-1.0.so.0", "libusb-1.0-0"}};
    return all;
}

constexpr std::array<int, 2> kOldest{3, 16};

/// Why the library cannot be used; else `functions` are its functions.
std::string why_not(const MakersLibrary& library, Functions& functions) {
    const std::string file = library.file.string();
    const std::string advice = ": install Force Dimension's SDK 3.16 or newer";
    if (const std::string missing = take_functions(library.handle, functions); !missing.empty())
        return file + " has no function " + missing + advice;
    std::array<int, 4> version{};
    functions.sdk_version(&version[0], &version[1], &version[2], &version[3]);
    if (std::lexicographical_compare(version.begin(), version.begin() + 2, kOldest.begin(),
                                     kOldest.end()))
        return file + " is version " + std::to_string(version[0]) + "." +
               std::to_string(version[1]) + "." + std::to_string(version[2]) +
               ", which is too old" + advice;
    return {};
}

}  // namespace

FoundCalls load_calls(const std::string& chosen) {
    if (is_record(chosen)) return play_record(chosen);
    FoundCalls refused;
    // All functions of libdhd are in libdrd, too.
    for (const char* const name : {"libdrd", "libdhd"}) {
        Functions functions;
        const MakersLibrary library =
            load_makers_library(search(name, chosen), [&functions](const MakersLibrary& loaded) {
                functions = {};
                return why_not(loaded, functions);
            });
        if (library.handle != nullptr)
            return {std::make_shared<LoadedCalls>(functions, library.file.string()), {}};
        if (refused.trouble.empty()) refused.trouble = library.trouble;
    }
    return refused;
}

}  // namespace dibhr::forcedimension
