// A system call on a unit of falcon_host, as it goes through the host's socket: a call and its
// answer are one message each, and bytes of a transfer follow them.
#pragma once

#include <linux/usbdevice_fs.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace dibhr::test::falcon {

/// The largest argument that holds no pointers.
inline constexpr std::size_t kArgumentBytes = sizeof(usbdevfs_disconnect_claim);
/// Of one transfer; libusb cuts longer ones.
inline constexpr std::size_t kMostTransferBytes = 16384 + 8;

struct UsbfsCall {
    std::uint64_t inode{0};    ///< of the open file's pipe; 0: open() of the path in `argument`
    std::uint64_t request{0};  ///< USBDEVFS_...
    std::uint64_t urb{0};      ///< where the program has its usbdevfs_urb
    std::array<std::uint8_t, kArgumentBytes> argument{};
};

/// With the descriptor that an open() gives.
struct UsbfsAnswer {
    static constexpr std::int32_t kNotHere = -10000;  ///< no simulated unit's node or file

    std::int32_t result{0};  ///< 0 or more, or a negative errno
    std::int32_t status{0};  ///< of a transfer that was reaped
    std::int32_t length{0};  ///< of the same: as usbdevfs_urb has it
    std::uint64_t urb{0};    ///< of the same
    std::array<std::uint8_t, kArgumentBytes> argument{};
};

}  // namespace dibhr::test::falcon
