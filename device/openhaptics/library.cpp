// Loads 3D Systems' HD library, and keeps what a call of it does to the program in bounds.
#include "device/openhaptics/library.hpp"

#include <fcntl.h>
#include <locale.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <thread>
#include <utility>

#include "device/makers_library.hpp"
#include "device/openhaptics/record.hpp"

namespace dibhr::openhaptics {

namespace {

constexpr std::chrono::seconds kLongestAside{1};

const MakersLibrarySearch& usual_places() {
    static const MakersLibrarySearch search{
        .names = {"libHD.so.3.4", "libHD.so.3.0", "libHD.so"},
        .variables = {"OH_SDK_BASE"},
        .sub_folders = {"lib", "usr/lib", "lib64", "usr/lib64"},
        .folders = {"/usr/lib64", "/usr/local/lib", "/opt/OpenHaptics/Developer/*"},
        .packages = {{"libncurses.so.5",
                      "libncurses5 and libtinfo5, which Debian 13 and Ubuntu "
                      "24.04 no longer have: install those of Debian 12"},
                     {"libtinfo.so.5",
                      "libtinfo5, which Debian 13 and Ubuntu 24.04 no longer "
                      "have: install that of Debian 12"},
                     {"libPhantomIOLib42.so", "3D Systems' Touch Device Driver"},
                     {"libPHANToMIO.so.4", "the PHANTOM Device Drivers"},
                     {"libusb-1.0.so.0", "libusb-1.0-0"}}};
    return search;
}

std::string functions_in(const MakersLibrary& library, HdLibrary& functions) {
    LibrarySymbols symbols(library.handle);
    symbols.required(functions.init_device, "hdInitDevice");
    symbols.required(functions.disable_device, "hdDisableDevice");
    symbols.required(functions.make_current, "hdMakeCurrentDevice");
    symbols.required(functions.begin_frame, "hdBeginFrame");
    symbols.required(functions.end_frame, "hdEndFrame");
    symbols.required(functions.get_error, "hdGetError");
    symbols.required(functions.enable, "hdEnable");
    symbols.required(functions.disable, "hdDisable");
    symbols.required(functions.get_booleans, "hdGetBooleanv");
    symbols.required(functions.get_integers, "hdGetIntegerv");
    symbols.required(functions.get_doubles, "hdGetDoublev");
    symbols.required(functions.get_longs, "hdGetLongv");
    symbols.required(functions.set_doubles, "hdSetDoublev");
    symbols.required(functions.get_string, "hdGetString");
    symbols.required(functions.check_calibration, "hdCheckCalibration");
    symbols.required(functions.update_calibration, "hdUpdateCalibration");
    symbols.required(functions.start_scheduler, "hdStartScheduler");
    symbols.required(functions.stop_scheduler, "hdStopScheduler");
    symbols.required(functions.schedule, "hdScheduleAsynchronous");
    symbols.required(functions.unschedule, "hdUnschedule");
    if (symbols.missing().empty()) return {};
    return library.file.string() + " has no function " + symbols.missing() +
           ": it is not the HD library of OpenHaptics, install OpenHaptics 3.4";
}

}  // namespace

LoadedLibrary load_hd_library(const std::string& chosen) {
    if (is_record(chosen)) return play_record(chosen);
    MakersLibrarySearch search = usual_places();
    search.chosen = chosen;
    LoadedLibrary loaded;
    const MakersLibrary found = load_makers_library(search, [&](const MakersLibrary& library) {
        return functions_in(library, loaded.functions);
    });
    loaded.loaded = found.handle != nullptr;
    loaded.file = found.file.string();
    loaded.trouble = found.trouble;
    return loaded;
}

/// The calling thread's own locale. Where the library sets the program's, that is undone.
class OpeningCall::DecimalPoint {
  public:
    DecimalPoint() : own_(newlocale(LC_ALL_MASK, "C", nullptr)), thread_(uselocale(own_)) {}
    ~DecimalPoint() {
        const std::string now = setlocale(LC_NUMERIC, nullptr);
        if (now != program_) setlocale(LC_NUMERIC, program_.c_str());
        uselocale(thread_);
        if (own_ != nullptr) freelocale(own_);
    }
    DecimalPoint(const DecimalPoint&) = delete;
    DecimalPoint& operator=(const DecimalPoint&) = delete;

  private:
    const std::string program_{setlocale(LC_NUMERIC, nullptr)};
    locale_t own_;
    locale_t thread_;
};

/// Leads standard output into memory. A thread of its own ends this where the call does not return.
class OpeningCall::Output {
  public:
    explicit Output(std::string& printed) : printed_(printed) {
        memory_ = memfd_create("printed", MFD_CLOEXEC);
        standard_ = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
        if (memory_ < 0 || standard_ < 0) return;
        std::fflush(stdout);
        aside_ = dup2(memory_, STDOUT_FILENO) >= 0;
        watch_ = std::jthread([this](const std::stop_token& stop) {
            std::unique_lock lock(mutex_);
            ended_.wait_for(lock, stop, kLongestAside, [] { return false; });
            restore();
        });
    }
    ~Output() {
        watch_ = {};  // restores standard output
        if (memory_ >= 0) close(memory_);
        if (standard_ >= 0) close(standard_);
    }
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;

  private:
    void restore() {
        if (!aside_) return;
        std::fflush(stdout);
        dup2(standard_, STDOUT_FILENO);
        const off_t size = lseek(memory_, 0, SEEK_END);
        std::string text(static_cast<std::size_t>(std::max(size, off_t{0})), '\0');
        const ssize_t read = pread(memory_, text.data(), text.size(), 0);
        text.resize(static_cast<std::size_t>(std::max(read, ssize_t{0})));
        if (text.empty() || text == printed_) return;
        std::fputs(text.c_str(), stderr);
        printed_ = std::move(text);
    }

    std::string& printed_;
    int memory_{-1};
    int standard_{-1};
    bool aside_{false};
    std::mutex mutex_{};
    std::condition_variable_any ended_{};
    std::jthread watch_{};
};

OpeningCall::OpeningCall(std::string& printed)
    : point_(std::make_unique<DecimalPoint>()), output_(std::make_unique<Output>(printed)) {}
OpeningCall::~OpeningCall() = default;

}  // namespace dibhr::openhaptics
