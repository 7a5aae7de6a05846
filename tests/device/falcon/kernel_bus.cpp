// The bus of a real kernel: a simulated unit is a USB/IP device on its virtual host controller, so
// that the real usbfs, hub code and udev see it. Needs root and the module vhci_hcd.
#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/device/falcon/usb_bench.hpp"
#include "tests/device/falcon/usb_bus.hpp"

namespace dibhr::test::falcon {

namespace {

namespace fs = std::filesystem;

// The kernel's Documentation/usb/usbip_protocol.rst; all numbers are big endian.
enum Message : std::uint32_t { submit = 1, unlink_request = 2, submitted = 3, unlinked = 4 };

struct Header {
    std::uint32_t message{0};
    std::uint32_t number{0};
    std::uint32_t device{0};
    std::uint32_t to_host{0};
    std::uint32_t endpoint{0};
    std::array<std::uint32_t, 5> words{};  // flags and length; victim; status and actual length
    std::array<std::uint8_t, 8> setup{};
};
static_assert(sizeof(Header) == 48);

constexpr std::size_t kSetupBytes = 8;

bool receive_all(int socket, void* data, std::size_t size) {
    return size == 0 || ::recv(socket, data, size, MSG_WAITALL) == static_cast<ssize_t>(size);
}

std::string text_of(const fs::path& file) {
    std::string text;
    std::getline(std::ifstream(file), text);
    return text;
}

/// A unit on a port of the virtual controller.
class PluggedUnit {
  public:
    PluggedUnit(std::shared_ptr<UsbfsUnit> unit, int port) : unit_(std::move(unit)) {
        std::array<int, 2> ends{};
        if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) != 0) {
            throw std::runtime_error("no socket pair");
        }
        socket_ = ends[0];
        unit_->wire().open(file_);
        reader_ = std::thread([this] { read_requests(); });
        writer_ = std::thread([this] { write_answers(); });
        constexpr int kFullSpeed = 2;
        std::ofstream attach("/sys/devices/platform/vhci_hcd.0/attach");
        attach << port << ' ' << ends[1] << ' ' << 0x10002 + port << ' ' << kFullSpeed
               << std::flush;
        if (!attach) throw std::runtime_error("vhci_hcd refuses the unit: is it loaded?");
        ::close(ends[1]);  // the kernel has it
    }
    ~PluggedUnit() {
        ::shutdown(socket_, SHUT_RDWR);
        unit_->wire().unplug();
        reader_.join();
        writer_.join();
        unit_->wire().forget(file_);
        ::close(socket_);
        ::close(file_.pipe.descriptor());
    }
    PluggedUnit(const PluggedUnit&) = delete;
    PluggedUnit& operator=(const PluggedUnit&) = delete;

  private:
    struct Request {
        std::uint32_t number{0};
        bool to_host{false};
        std::vector<std::uint8_t> bytes{};  // setup and data
        usbdevfs_urb urb{};
    };

    void read_requests() {
        Header header;
        while (receive_all(socket_, &header, sizeof header)) {
            if (ntohl(header.message) == unlink_request) {
                cancel(header);
            } else if (!take(header)) {
                return;
            }
        }
    }

    bool take(const Header& header) {
        const std::lock_guard lock(mutex_);
        Request& request = requests_.emplace_back();
        request.number = header.number;
        request.to_host = ntohl(header.to_host) != 0;
        const auto length = static_cast<std::size_t>(ntohl(header.words[1]));
        request.bytes.resize(kSetupBytes + length);
        std::ranges::copy(header.setup, request.bytes.begin());
        if (!request.to_host && !receive_all(socket_, request.bytes.data() + kSetupBytes, length)) {
            return false;
        }
        const auto endpoint = static_cast<std::uint8_t>(ntohl(header.endpoint));
        usbdevfs_urb& urb = request.urb;
        const std::size_t skipped = endpoint == 0 ? 0 : kSetupBytes;
        urb.type = endpoint == 0 ? USBDEVFS_URB_TYPE_CONTROL : USBDEVFS_URB_TYPE_BULK;
        urb.endpoint = static_cast<std::uint8_t>(endpoint | (request.to_host ? 0x80U : 0U));
        urb.buffer = request.bytes.data() + skipped;
        urb.buffer_length = static_cast<int>(request.bytes.size() - skipped);
        urb.usercontext = &request;
        const int refused = unit_->wire().submit(file_, &urb);
        if (refused != 0) {
            urb.status = refused;
            answer(request);
        }
        return true;
    }

    void cancel(const Header& header) {
        const std::lock_guard lock(mutex_);
        int status = 0;
        for (Request& request : requests_) {
            if (request.number != header.words[0]) continue;
            if (unit_->wire().discard(file_, &request.urb) == 0) status = -ECONNRESET;
        }
        Header reply;
        reply.message = htonl(unlinked);
        reply.number = header.number;
        reply.words[0] = htonl(static_cast<std::uint32_t>(status));
        static_cast<void>(::send(socket_, &reply, sizeof reply, MSG_NOSIGNAL));
    }

    void write_answers() {
        for (;;) {
            pollfd ready{file_.pipe.descriptor(), POLLOUT, 0};
            ::poll(&ready, 1, -1);
            const std::lock_guard lock(mutex_);
            usbdevfs_urb* urb = nullptr;
            while (unit_->wire().reap(file_, urb) == 0) {
                auto& request = *static_cast<Request*>(urb->usercontext);
                // One that was cancelled is answered as unlinked only.
                if (urb->status == -ENOENT) {
                    forget(request);
                } else {
                    answer(request);
                }
            }
            if ((ready.revents & POLLERR) != 0) break;
        }
        ::shutdown(socket_, SHUT_RDWR);  // the cable is out
    }

    void answer(Request& request) {
        const usbdevfs_urb& urb = request.urb;
        Header reply;
        reply.message = htonl(submitted);
        reply.number = request.number;
        reply.words[0] = htonl(static_cast<std::uint32_t>(urb.status));
        reply.words[1] = htonl(static_cast<std::uint32_t>(urb.actual_length));
        const auto* const head = reinterpret_cast<const std::uint8_t*>(&reply);
        std::vector<std::uint8_t> bytes(head, head + sizeof reply);
        if (request.to_host) {
            const auto data = request.bytes.begin() + kSetupBytes;
            bytes.insert(bytes.end(), data, data + urb.actual_length);
        }
        static_cast<void>(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL));
        forget(request);
    }

    void forget(const Request& request) {
        requests_.remove_if([&](const Request& each) { return &each == &request; });
    }

    std::shared_ptr<UsbfsUnit> unit_;
    UsbFile file_{};
    int socket_{-1};
    std::mutex mutex_{};
    std::list<Request> requests_{};
    std::thread reader_{};
    std::thread writer_{};
};

/// The address the kernel gave to the unit; 0 while it has none.
int address_of(const std::string& serial) {
    for (const auto& device : fs::directory_iterator("/sys/bus/usb/devices")) {
        if (text_of(device.path() / "serial") != serial) continue;
        const std::string number = text_of(device.path() / "devnum");
        const std::string configuration = text_of(device.path() / "bConfigurationValue");
        if (!number.empty() && !configuration.empty()) return std::stoi(number);
    }
    return 0;
}

}  // namespace

struct UsbBus::Implementation {
    struct Plugged {
        std::string serial{};
        std::unique_ptr<PluggedUnit> unit{};
    };
    std::map<int, Plugged> by_port{};
};

UsbBus::UsbBus() : implementation_(std::make_unique<Implementation>()) {}
UsbBus::~UsbBus() = default;

void UsbBus::plug(UsbPlace& place, const std::shared_ptr<UsbfsUnit>& unit) {
    const int port = place.port - 1;
    implementation_->by_port[place.port] = {unit->serial(),
                                            std::make_unique<PluggedUnit>(unit, port)};
    if (!eventually([&] { return (place.address = address_of(unit->serial())) != 0; })) {
        throw std::runtime_error("the kernel does not take the unit");
    }
}

void UsbBus::remove(const UsbPlace& place) {
    const auto found = implementation_->by_port.find(place.port);
    const std::string serial = found->second.serial;
    implementation_->by_port.erase(found);
    constexpr const char* kFree = " 004 ";  // in the column of the port's state
    static_cast<void>(eventually([&] {
        std::ifstream status("/sys/devices/platform/vhci_hcd.0/status");
        std::string line;
        for (int i = 0; i <= place.port && std::getline(status, line); ++i) {
        }
        return address_of(serial) == 0 && line.find(kFree) != std::string::npos;
    }));
}

}  // namespace dibhr::test::falcon
