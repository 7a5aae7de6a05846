// Reads the system's list of USB devices.
#include "device/hand/usb_list.hpp"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <system_error>

namespace dibhr {

namespace {

namespace fs = std::filesystem;

std::string word_in(const fs::path& file) {
    std::ifstream stream(file);
    std::string word;
    stream >> word;
    return word;
}

std::string node_of(const fs::path& device) {
    std::array<char, 64> node{};
    std::snprintf(node.data(), node.size(), "/dev/bus/usb/%03d/%03d",
                  std::atoi(word_in(device / "busnum").c_str()),
                  std::atoi(word_in(device / "devnum").c_str()));
    return node.data();
}

}  // namespace

bool UsbDevice::may_open() const {
    return access(node.c_str(), R_OK | W_OK) == 0;
}

std::vector<UsbDevice> listed_usb_devices(const fs::path& devices) {
    std::vector<UsbDevice> listed;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(devices, ignored)) {
        std::string maker = word_in(entry.path() / "idVendor");
        if (maker.empty()) continue;  // an interface
        listed.push_back(
            {std::move(maker), word_in(entry.path() / "idProduct"), node_of(entry.path())});
    }
    return listed;
}

}  // namespace dibhr
