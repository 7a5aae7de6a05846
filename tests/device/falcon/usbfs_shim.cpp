// The interposed system calls. Symbols defined here win over libumockdev-preload's, which still
// serves sysfs, udev and uevents, and over libc's: in a program that links this file, and in one
// that it is preloaded into.
#undef _FORTIFY_SOURCE  // else libc's headers define open() themselves
#include "tests/device/falcon/usbfs_shim.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/types.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <map>
#include <string_view>
#include <utility>

namespace dibhr::test::falcon {

namespace {

constexpr std::string_view kUsbFolder = "/dev/bus/usb/";

/// What stands behind a file descriptor.
struct OpenUnit {
    explicit OpenUnit(std::shared_ptr<UsbfsUnit> opened) : unit(std::move(opened)) {}
    std::shared_ptr<UsbfsUnit> unit;
    UsbFile file{};
};

// A program has one open() and one table of file descriptors, and these are called before any
// constructor has run: hence variables of the whole program, ready from the start.
struct Nodes {
    std::mutex mutex{};
    std::map<std::string, std::shared_ptr<UsbfsUnit>, std::less<>> units{};
};
std::atomic<int> served_nodes{0};
std::array<std::atomic<OpenUnit*>, 1024> open_units{};
thread_local bool in_ioctl = false;

Nodes& nodes() {
    static Nodes* const all = new Nodes;  // outlives every other destructor that closes a file
    return *all;
}

std::shared_ptr<UsbfsUnit> unit_at(const char* path) {
    if (served_nodes == 0 || path == nullptr || !std::string_view(path).starts_with(kUsbFolder)) {
        return nullptr;
    }
    const std::lock_guard lock(nodes().mutex);
    const auto found = nodes().units.find(std::string_view(path));
    return found == nodes().units.end() ? nullptr : found->second;
}

OpenUnit* opened_at(int descriptor) {
    const auto index = static_cast<std::size_t>(descriptor);
    if (descriptor < 0 || index >= open_units.size()) return nullptr;
    return open_units.at(index).load(std::memory_order_acquire);
}

int failed(int error) {
    errno = error;
    return -1;
}

int open_unit(std::shared_ptr<UsbfsUnit> unit) {
    if (const int refused = unit->access().open_errno; refused != 0) return failed(refused);
    if (unit->wire().gone()) return failed(ENODEV);
    auto opened = std::make_unique<OpenUnit>(std::move(unit));
    const int descriptor = opened->file.pipe.descriptor();
    const auto index = static_cast<std::size_t>(descriptor);
    if (descriptor < 0 || index >= open_units.size()) return failed(EMFILE);
    opened->unit->wire().open(opened->file);
    open_units.at(index).store(opened.release(), std::memory_order_release);
    return descriptor;
}

void close_unit(int descriptor) {
    OpenUnit* const opened = open_units.at(static_cast<std::size_t>(descriptor)).exchange(nullptr);
    if (opened == nullptr) return;
    opened->unit->close(opened->file);
    delete opened;
}

int ioctl_unit(OpenUnit& opened, unsigned long request, void* argument) {
    in_ioctl = true;
    const int result = opened.unit->ioctl(opened.file, request, argument);
    in_ioctl = false;
    return result < 0 ? failed(-result) : result;
}

template <typename Function>
Function next_in_line(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

/// open()'s third argument, where there is one.
mode_t mode_among(int flags, va_list arguments) {
    const bool given = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
    return given ? va_arg(arguments, mode_t) : 0;
}

}  // namespace

void serve_node(const std::string& node, std::shared_ptr<UsbfsUnit> unit) {
    const std::lock_guard lock(nodes().mutex);
    nodes().units[node] = std::move(unit);
    served_nodes = static_cast<int>(nodes().units.size());
}

void withdraw_node(const std::string& node) {
    const std::lock_guard lock(nodes().mutex);
    nodes().units.erase(node);
    served_nodes = static_cast<int>(nodes().units.size());
}

bool in_simulated_kernel() noexcept {
    return in_ioctl;
}

}  // namespace dibhr::test::falcon

namespace bench = dibhr::test::falcon;

// A race that the thread sanitizer saw in them it would report through them, and wait for itself.
#define SEEN_BY_LIBRARIES __attribute__((visibility("default"), no_sanitize("thread")))

extern "C" {

SEEN_BY_LIBRARIES int open(const char* path, int flags, ...) {
    if (auto unit = bench::unit_at(path)) return bench::open_unit(std::move(unit));
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = bench::mode_among(flags, arguments);
    va_end(arguments);
    static const auto next = bench::next_in_line<int (*)(const char*, int, ...)>("open");
    return next(path, flags, mode);
}

SEEN_BY_LIBRARIES int open64(const char* path, int flags, ...) {
    if (auto unit = bench::unit_at(path)) return bench::open_unit(std::move(unit));
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = bench::mode_among(flags, arguments);
    va_end(arguments);
    static const auto next = bench::next_in_line<int (*)(const char*, int, ...)>("open64");
    return next(path, flags, mode);
}

// Debian's libusb is built with _FORTIFY_SOURCE: its usbfs open() is a call to one of these.
SEEN_BY_LIBRARIES int __open_2(const char* path, int flags) {  // NOLINT: its name
    if (auto unit = bench::unit_at(path)) return bench::open_unit(std::move(unit));
    static const auto next = bench::next_in_line<int (*)(const char*, int)>("__open_2");
    return next(path, flags);
}

SEEN_BY_LIBRARIES int __open64_2(const char* path, int flags) {  // NOLINT: its name
    if (auto unit = bench::unit_at(path)) return bench::open_unit(std::move(unit));
    static const auto next = bench::next_in_line<int (*)(const char*, int)>("__open64_2");
    return next(path, flags);
}

SEEN_BY_LIBRARIES int ioctl(int descriptor, unsigned long request, ...) noexcept {
    va_list arguments;
    va_start(arguments, request);
    void* const argument = va_arg(arguments, void*);
    va_end(arguments);
    if (bench::OpenUnit* const opened = bench::opened_at(descriptor)) {
        return bench::ioctl_unit(*opened, request, argument);
    }
    static const auto next = bench::next_in_line<int (*)(int, unsigned long, void*)>("ioctl");
    return next(descriptor, request, argument);
}

SEEN_BY_LIBRARIES int close(int descriptor) {
    if (bench::opened_at(descriptor) != nullptr) bench::close_unit(descriptor);
    static const auto next = bench::next_in_line<int (*)(int)>("close");
    return next(descriptor);
}

}  // extern "C"
