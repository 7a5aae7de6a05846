// Follows a device that is recorded or played.
#include "device/recorded_device.hpp"

#include <chrono>
#include <string>
#include <thread>

namespace dibhr {

namespace {

void print_stages(ForceDevice& device, const PrintLine& print) {
    using Clock = std::chrono::steady_clock;
    std::string printed;
    for (const auto end = Clock::now() + std::chrono::seconds(10); Clock::now() < end;) {
        const DeviceState now = device.state();
        const std::string& name =
            now.full_name.empty() ? device.specification().name : now.full_name;
        const std::string line = name + (now.id.empty() ? "" : " ") + now.id + ": " + now.sentence;
        if (line != printed) print(line);
        printed = line;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
}

}  // namespace

void record_device(ForceDevice& device, const std::filesystem::path& file, const PrintLine& print) {
    print(
        "Move the grip slowly to all sides for 10 seconds, and press every button. There is no "
        "force.");
    print_stages(device, print);
    print("Recorded in " + file.string());
}

void play_device(ForceDevice& device, const std::filesystem::path& record, const char* kind,
                 const PrintLine& print) {
    print_stages(device, print);
    print("To touch with this record, set library = \"" + record.string() + "\" under [" + kind +
          "] in settings.toml.");
}

}  // namespace dibhr
