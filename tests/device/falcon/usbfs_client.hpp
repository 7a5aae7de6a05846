// /dev/bus/usb of a program whose units falcon_host plays.
#pragma once

#include <sys/types.h>
#include <sys/un.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "tests/device/falcon/usbfs.hpp"

namespace dibhr::test::falcon {

/// Asks the host about everything, and keeps nothing but idle connections: a forked child, which
/// makes its own, and a signal handler may ask as well. No call takes memory or a lock.
class UsbfsClient final : public Usbfs {
  public:
    /// `socket`: the host's UsbfsHost. Throws std::invalid_argument when that is no path for one.
    explicit UsbfsClient(const std::string& socket);

    std::optional<int> open(const char* path) override;
    std::optional<int> ioctl(int descriptor, ino_t inode, unsigned long request,
                             void* argument) override;

  private:
    class Connection;

    sockaddr_un host_{};
    std::array<std::atomic<std::uint64_t>, 16> idle_{};  // process and descriptor; 0: none
};

}  // namespace dibhr::test::falcon
