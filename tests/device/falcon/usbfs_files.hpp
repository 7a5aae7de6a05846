// The nodes of simulated units, and who has them open.
#pragma once

#include <sys/types.h>

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "tests/device/falcon/usbfs_unit.hpp"

namespace dibhr::test::falcon {

/// An open file of a unit, which may have been pulled and thrown away meanwhile.
struct OpenUnit {
    explicit OpenUnit(std::weak_ptr<UsbfsUnit> opened) : unit(std::move(opened)) {}
    ~OpenUnit();
    OpenUnit(const OpenUnit&) = delete;
    OpenUnit& operator=(const OpenUnit&) = delete;

    std::weak_ptr<UsbfsUnit> unit;
    UsbfsFile file{};
};

/// Thread-safe. A file is open until the last copy of its descriptor is closed, in any process; one
/// whose unit was pulled stays known.
class UsbfsFiles {
  public:
    /// From now on `node` ("/dev/bus/usb/001/002") is this unit.
    void serve(const std::string& node, std::shared_ptr<UsbfsUnit> unit);
    /// The node is gone; files that are open on it stay so.
    void withdraw(const std::string& node);

    /// The program's descriptor, which is not kept, or a negative errno; nothing: no such node.
    [[nodiscard]] std::optional<int> open(std::string_view node);
    /// The open file behind this pipe, for this request; null when there is none.
    [[nodiscard]] std::shared_ptr<OpenUnit> find(ino_t inode, unsigned long request);
    /// Whether a unit that is plugged in is open.
    [[nodiscard]] bool any_open();

  private:
    void sweep();

    std::mutex mutex_{};
    std::map<std::string, std::shared_ptr<UsbfsUnit>, std::less<>> units_{};
    std::map<ino_t, std::shared_ptr<OpenUnit>> open_{};
};

/// The units of this process for its own open() and ioctl(): to be served here before anyone hears
/// of them.
[[nodiscard]] UsbfsFiles& own_files();

}  // namespace dibhr::test::falcon
