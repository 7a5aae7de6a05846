// Nodes by path, open files by the inode of their pipe.
#include "tests/device/falcon/usbfs_files.hpp"

#include <linux/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "tests/device/falcon/usbfs.hpp"

namespace dibhr::test::falcon {

OpenUnit::~OpenUnit() {
    if (const auto alive = unit.lock()) alive->close(file);
}

void UsbfsFiles::serve(const std::string& node, std::shared_ptr<UsbfsUnit> unit) {
    const std::lock_guard lock(mutex_);
    units_[node] = std::move(unit);
}

void UsbfsFiles::withdraw(const std::string& node) {
    const std::lock_guard lock(mutex_);
    sweep();
    units_.erase(node);
}

std::optional<int> UsbfsFiles::open(std::string_view node) {
    const std::lock_guard lock(mutex_);
    sweep();
    const auto found = units_.find(node);
    if (found == units_.end()) return std::nullopt;
    auto opened = std::make_shared<OpenUnit>(found->second);
    const PollPipe& pipe = opened->file.on_bus.pipe;
    if (pipe.descriptor() < 0) return -EMFILE;
    if (const int refused = found->second->open(opened->file); refused != 0) {
        syscall(SYS_close, pipe.descriptor());
        return refused;
    }
    open_[pipe.inode()] = opened;
    return pipe.descriptor();
}

std::shared_ptr<OpenUnit> UsbfsFiles::find(ino_t inode, unsigned long request) {
    const std::lock_guard lock(mutex_);
    // A kernel's close() has done its work before the next call; transfers ask nothing of others.
    if (request != USBDEVFS_SUBMITURB && request != USBDEVFS_REAPURBNDELAY) sweep();
    const auto found = open_.find(inode);
    return found == open_.end() ? nullptr : found->second;
}

bool UsbfsFiles::any_open() {
    const std::lock_guard lock(mutex_);
    sweep();
    return std::ranges::any_of(open_, [](const auto& each) {
        const auto unit = each.second->unit.lock();
        return unit && !unit->wire().gone(each.second->file.on_bus);
    });
}

void UsbfsFiles::sweep() {
    std::erase_if(open_, [](const auto& each) {
        const auto unit = each.second->unit.lock();
        UsbFile& file = each.second->file.on_bus;
        return unit ? unit->wire().abandoned(file) : file.pipe.abandoned();
    });
}

namespace {

/// What a program's own memory gets of a transfer that has ended.
void give_back(const UsbfsUrb& ended) {
    auto* const urb = reinterpret_cast<usbdevfs_urb*>(ended.id);
    urb->status = ended.urb.status;
    urb->actual_length = ended.urb.actual_length;
    std::copy_n(ended.bytes.begin(), ended.bytes_back(), static_cast<std::uint8_t*>(urb->buffer));
}

int perform(UsbfsUnit& unit, UsbfsFile& file, unsigned long request, void* argument) {
    switch (request) {
        case USBDEVFS_SUBMITURB:
            return unit.submit(file, *static_cast<usbdevfs_urb*>(argument),
                               reinterpret_cast<std::uintptr_t>(argument));
        case USBDEVFS_DISCARDURB:
            return unit.discard(file, reinterpret_cast<std::uintptr_t>(argument));
        case USBDEVFS_REAPURBNDELAY: {
            UsbfsUrb ended;
            const int result = unit.reap(file, ended);
            if (result != 0) return result;
            give_back(ended);
            *static_cast<void**>(argument) = reinterpret_cast<void*>(ended.id);
            return 0;
        }
        case USBDEVFS_BULK:
            return unit.bulk(file, *static_cast<usbdevfs_bulktransfer*>(argument));
        default:
            return unit.ioctl(file, request, argument);
    }
}

/// A process that was forked from this one has copies of the units, which nobody plays, and of
/// their locks.
class OwnUsbfs final : public Usbfs {
  public:
    std::optional<int> open(const char* path) override {
        if (getpid() != process_) return std::nullopt;
        return files_.open(path);
    }
    std::optional<int> ioctl(int, ino_t inode, unsigned long request, void* argument) override {
        if (getpid() != process_) return -ENODEV;
        const auto opened = files_.find(inode, request);
        if (opened == nullptr) return std::nullopt;
        const auto unit = opened->unit.lock();
        if (unit == nullptr) return -ENODEV;
        return perform(*unit, opened->file, request, argument);
    }
    [[nodiscard]] UsbfsFiles& files() noexcept { return files_; }

  private:
    const pid_t process_{getpid()};
    UsbfsFiles files_{};
};

}  // namespace

UsbfsFiles& own_files() {
    static OwnUsbfs* const usbfs = [] {
        auto* const made = new OwnUsbfs;  // outlives every other destructor that asks it
        answer_with(*made);
        return made;
    }();
    return usbfs->files();
}

}  // namespace dibhr::test::falcon
