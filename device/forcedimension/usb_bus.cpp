// Reads the system's list of USB devices.
#include "device/forcedimension/usb_bus.hpp"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <system_error>

namespace dibhr::forcedimension {

namespace {

namespace fs = std::filesystem;

constexpr const char* kMaker = "1451";
constexpr const char* kFalconMaker = "0403";
constexpr const char* kFalconProduct = "cb48";

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

UsbBus read_usb_bus(const fs::path& devices) {
    UsbBus bus;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(devices, ignored)) {
        const std::string maker = word_in(entry.path() / "idVendor");
        if (maker == kFalconMaker && word_in(entry.path() / "idProduct") == kFalconProduct)
            bus.has_falcon = true;
        if (maker != kMaker) continue;
        bus.has_arm = true;
        const std::string node = node_of(entry.path());
        if (access(node.c_str(), R_OK | W_OK) != 0) bus.refused_node = node;
    }
    return bus;
}

}  // namespace dibhr::forcedimension
