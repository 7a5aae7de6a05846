// Device descriptions in umockdev's format: P path, N node, E udev property, A attribute, H
// attribute in hexadecimal.
#include "tests/device/falcon/usb_testbed.hpp"

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <stdexcept>

#include "tests/device/falcon/falcon_model.hpp"

namespace dibhr::test::falcon {

namespace {

constexpr const char* kMachine = "/sys/devices/system";
constexpr const char* kBus = "/devices/pci0000:00/0000:00:14.0/usb1";

std::string hexadecimal(const std::vector<std::uint8_t>& bytes) {
    std::ostringstream text;
    text << std::hex << std::uppercase << std::setfill('0');
    for (const std::uint8_t byte : bytes) text << std::setw(2) << int{byte};
    return text.str();
}

std::string path_of(const UsbPlace& place) {
    return std::string(kBus) + "/1-" + std::to_string(place.port);
}

std::string interface_path_of(const UsbPlace& place) {
    return path_of(place) + "/1-" + std::to_string(place.port) + ":1.0";
}

/// As the kernel numbers USB devices.
std::string device_number_of(const UsbPlace& place) {
    return "189:" + std::to_string(place.address - 1);
}

struct Identity {
    std::string vendor{};
    std::string product{};
    std::string release{};
    std::string speed{};
    std::string more{};  // further attributes
};

std::string describe(const std::string& path, const UsbPlace& place, const Identity& identity,
                     const std::vector<std::uint8_t>& descriptors) {
    const std::string number = place.number();
    const std::string minor = std::to_string(place.address - 1);
    std::ostringstream text;
    text << "P: " << path << "\nN: bus/usb/001/" << number << "=" << hexadecimal(descriptors)
         << "\nE: DEVNAME=/dev/bus/usb/001/" << number
         << "\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nE: BUSNUM=001\nE: DEVNUM=" << number
         << "\nE: MAJOR=189\nE: MINOR=" << minor << "\nE: ID_VENDOR_ID=" << identity.vendor
         << "\nE: ID_MODEL_ID=" << identity.product
         << "\nA: busnum=1\\n\nA: devnum=" << place.address << "\\n\nA: speed=" << identity.speed
         << "\\n\nA: bConfigurationValue=1\\n\nA: bNumConfigurations=1\\n\nA: idVendor="
         << identity.vendor << "\\n\nA: idProduct=" << identity.product
         << "\\n\nA: bcdDevice=" << identity.release << "\\n\nA: dev=" << device_number_of(place)
         << "\\n\n"
         << identity.more << "H: descriptors=" << hexadecimal(descriptors) << "\n\n";
    return text.str();
}

void add_to(UMockdevTestbed* testbed, const std::string& description) {
    GError* error = nullptr;
    if (umockdev_testbed_add_from_string(testbed, description.c_str(), &error) != 0) return;
    const std::string reason = error->message;
    g_error_free(error);
    throw std::runtime_error("umockdev: " + reason);
}

std::string folder_of(UMockdevTestbed* testbed) {
    gchar* const folder = umockdev_testbed_get_root_dir(testbed);
    std::string text = folder;
    g_free(folder);
    return text;
}

/// The testbed with its root hub.
struct Bus {
    Bus() : testbed(umockdev_testbed_new()) {
        // The answer is kept by the library, so it may be asked only now.
        if (umockdev_in_mock_environment() == 0) {
            g_object_unref(testbed);
            throw std::runtime_error(
                "libumockdev-preload.so.0 is not linked first, or not preloaded");
        }
        const std::vector<std::uint8_t> hub{18, 1, 0, 2, 9, 0,  1, 64, 0x6B, 0x1D, 2,    0, 0, 6, 3,
                                            2,  1, 1, 9, 2, 25, 0, 1,  1,    0,    0xE0, 0, 9, 4, 0,
                                            0,  1, 9, 0, 0, 0,  7, 5,  0x81, 3,    4,    0, 12};
        add_to(testbed,
               describe(kBus, {.port = 0, .address = 1}, {"1d6b", "0002", "0600", "480", ""}, hub));
        // What drawing and counting processors need of the machine.
        std::filesystem::create_directory_symlink(kMachine, folder_of(testbed) + kMachine);
    }
    ~Bus() {
        unlink((folder_of(testbed) + kMachine).c_str());
        g_object_unref(testbed);
    }
    Bus(const Bus&) = delete;
    Bus& operator=(const Bus&) = delete;

    UMockdevTestbed* testbed;
};

}  // namespace

UsbTestbed::UsbTestbed() {
    static const Bus bus;  // some dozens of files, which are made once a program
    testbed_ = bus.testbed;
}

void UsbTestbed::add_from(const std::string& description) {
    add_to(testbed_, description);
}

void UsbTestbed::add(const UsbPlace& place, const std::string& serial) {
    add_from(describe(path_of(place), place,
                      {"0403", "cb48", "0600", "12",
                       "A: product=FALCON HAPTIC\\n\nA: manufacturer=Simulated\\n\nA: serial=" +
                           serial + "\\n\n"},
                      falcon_descriptors()));
    add_from("P: " + interface_path_of(place) +
             "\nE: DEVTYPE=usb_interface\nE: SUBSYSTEM=usb\n"
             "A: bInterfaceNumber=00\\n\nA: bInterfaceClass=ff\\n\n\n");
}

void UsbTestbed::remove(const UsbPlace& place) {
    // The kernel says that the children are gone first.
    for (const std::string& path : {interface_path_of(place), path_of(place)}) {
        umockdev_testbed_uevent(testbed_, ("/sys" + path).c_str(), "remove");
    }
    for (const std::string& path : {interface_path_of(place), path_of(place)}) {
        umockdev_testbed_remove_device(testbed_, ("/sys" + path).c_str());
    }
    unlink((folder() + place.node()).c_str());
    unlink((folder() + "/sys/dev/char/" + device_number_of(place)).c_str());
}

std::string UsbTestbed::folder() const {
    return folder_of(testbed_);
}

}  // namespace dibhr::test::falcon
