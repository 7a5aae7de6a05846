// A folder as the system's list of USB devices.
#pragma once

#include <filesystem>
#include <fstream>

namespace dibhr::test {

/// `folder`: of the device, in the list. Its file in /dev does not exist.
inline void add_usb_device(const std::filesystem::path& folder, const char* maker,
                           const char* product) {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "idVendor") << maker << '\n';
    std::ofstream(folder / "idProduct") << product << '\n';
    std::ofstream(folder / "busnum") << "99\n";
    std::ofstream(folder / "devnum") << "9\n";
}

}  // namespace dibhr::test
