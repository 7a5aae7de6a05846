// The interposed system calls. Symbols defined here win over libumockdev-preload's, which still
// serves sysfs, udev and uevents, and over libc's: in a program that links this file, and in one
// that it is preloaded into.
#undef _FORTIFY_SOURCE  // else libc's headers define open() themselves
#include <dlfcn.h>
#include <fcntl.h>
#include <linux/ioctl.h>
#include <sys/types.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <optional>
#include <string_view>

#include "tests/device/falcon/poll_pipe.hpp"
#include "tests/device/falcon/usbfs.hpp"

namespace dibhr::test::falcon {

namespace {

constexpr std::string_view kUsbFolder = "/dev/bus/usb/";
constexpr unsigned kUsbfsRequests = 'U';

// A program has one open(), which is called before any constructor has run: hence variables of the
// whole program, ready from the start. After a fork nothing of them is locked.
std::atomic<Usbfs*> answering{nullptr};
thread_local bool in_call __attribute__((tls_model("initial-exec"))) = false;

template <typename Call>
std::optional<int> answered(Call call) {
    in_call = true;
    const std::optional<int> result = call();
    in_call = false;
    if (!result || *result >= 0) return result;
    errno = -*result;
    return -1;
}

std::optional<int> opened(const char* path) {
    Usbfs* const usbfs = answering;
    if (usbfs == nullptr || path == nullptr || !std::string_view(path).starts_with(kUsbFolder)) {
        return std::nullopt;
    }
    return answered([&] { return usbfs->open(path); });
}

std::optional<int> controlled(int descriptor, unsigned long request, void* argument) {
    Usbfs* const usbfs = answering;
    if (usbfs == nullptr || _IOC_TYPE(request) != kUsbfsRequests) return std::nullopt;
    const ino_t inode = inode_of_pipe(descriptor);
    if (inode == 0) return std::nullopt;
    return answered([&] { return usbfs->ioctl(descriptor, inode, request, argument); });
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

void answer_with(Usbfs& usbfs) noexcept {
    answering = &usbfs;
}

bool in_simulated_kernel() noexcept {
    return in_call;
}

}  // namespace dibhr::test::falcon

namespace bench = dibhr::test::falcon;

// A race that the thread sanitizer saw in them it would report through them, and wait for itself.
#define SEEN_BY_LIBRARIES __attribute__((visibility("default"), no_sanitize("thread")))

extern "C" {

SEEN_BY_LIBRARIES int open(const char* path, int flags, ...) {
    if (const auto answer = bench::opened(path)) return *answer;
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = bench::mode_among(flags, arguments);
    va_end(arguments);
    static const auto next = bench::next_in_line<int (*)(const char*, int, ...)>("open");
    return next(path, flags, mode);
}

SEEN_BY_LIBRARIES int open64(const char* path, int flags, ...) {
    if (const auto answer = bench::opened(path)) return *answer;
    va_list arguments;
    va_start(arguments, flags);
    const mode_t mode = bench::mode_among(flags, arguments);
    va_end(arguments);
    static const auto next = bench::next_in_line<int (*)(const char*, int, ...)>("open64");
    return next(path, flags, mode);
}

// Debian's libusb is built with _FORTIFY_SOURCE: its usbfs open() is a call to one of these.
SEEN_BY_LIBRARIES int __open_2(const char* path, int flags) {  // NOLINT: its name
    if (const auto answer = bench::opened(path)) return *answer;
    static const auto next = bench::next_in_line<int (*)(const char*, int)>("__open_2");
    return next(path, flags);
}

SEEN_BY_LIBRARIES int __open64_2(const char* path, int flags) {  // NOLINT: its name
    if (const auto answer = bench::opened(path)) return *answer;
    static const auto next = bench::next_in_line<int (*)(const char*, int)>("__open64_2");
    return next(path, flags);
}

SEEN_BY_LIBRARIES int ioctl(int descriptor, unsigned long request, ...) noexcept {
    va_list arguments;
    va_start(arguments, request);
    void* const argument = va_arg(arguments, void*);
    va_end(arguments);
    if (const auto answer = bench::controlled(descriptor, request, argument)) return *answer;
    static const auto next = bench::next_in_line<int (*)(int, unsigned long, void*)>("ioctl");
    return next(descriptor, request, argument);
}

}  // extern "C"
