// What answers open() and ioctl() of /dev/bus/usb in this program: its own simulated units, or
// those of falcon_host.
#pragma once

#include <sys/types.h>

#include <optional>

namespace dibhr::test::falcon {

/// Behind the interposed system calls (usbfs_shim.cpp). Their values: 0 or more, or a negative
/// errno; nothing: the file is no simulated unit's.
class Usbfs {
  public:
    Usbfs() = default;
    virtual ~Usbfs() = default;
    Usbfs(const Usbfs&) = delete;
    Usbfs& operator=(const Usbfs&) = delete;

    /// `path` begins with /dev/bus/usb/.
    virtual std::optional<int> open(const char* path) = 0;
    /// `inode`: of the pipe behind `descriptor`; the file may have been inherited, or sent.
    virtual std::optional<int> ioctl(int descriptor, ino_t inode, unsigned long request,
                                     void* argument) = 0;
};

/// From now on, to the end of the process, `usbfs` answers.
void answer_with(Usbfs& usbfs) noexcept;
/// Whether this thread is inside a system call that is answered here: what it does now would be the
/// kernel's work.
[[nodiscard]] bool in_simulated_kernel() noexcept;

}  // namespace dibhr::test::falcon
