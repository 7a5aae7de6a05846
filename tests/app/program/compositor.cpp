// sway, and the few messages of Wayland's protocol that make a pointer.
#include "tests/app/program/compositor.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <stdexcept>

#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

namespace dibhr::test {

namespace {

constexpr const char* kManager = "zwlr_virtual_pointer_manager_v1";
// Objects: 1 is the display; the others are named here.
constexpr std::uint32_t kDisplay = 1;
constexpr std::uint32_t kRegistry = 2;
constexpr std::uint32_t kDone = 3;
constexpr std::uint32_t kPointers = 4;
constexpr std::uint32_t kPointer = 5;
constexpr std::uint32_t kMade = 6;
constexpr std::uint32_t kWhole = 1000;

std::string words(std::initializer_list<std::uint32_t> numbers) {
    std::string bytes;
    for (const std::uint32_t number : numbers)
        bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    return bytes;
}

std::string text(const std::string& letters) {
    std::string bytes = words({static_cast<std::uint32_t>(letters.size() + 1)}) + letters + '\0';
    bytes.resize((bytes.size() + 3) / 4 * 4);
    return bytes;
}

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
    std::uint32_t number = 0;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
}

/// Reads until that request is done. The number under which the registry has the manager of
/// pointers, if it tells that meanwhile.
std::uint32_t read_until(std::uint32_t done, int socket) {
    constexpr std::size_t kHead = 8;
    std::uint32_t manager = 0;
    std::string bytes;
    for (;;) {
        char part[4096];
        const ssize_t count = ::read(socket, part, sizeof part);
        if (count <= 0) throw std::runtime_error("the compositor has closed its socket");
        bytes.append(part, static_cast<std::size_t>(count));
        while (bytes.size() >= kHead && bytes.size() >= (word_at(bytes, 4) >> 16U)) {
            const std::size_t size = word_at(bytes, 4) >> 16U;
            const std::uint32_t object = word_at(bytes, 0);
            if (object == done) return manager;
            const bool is_name = object == kRegistry && (word_at(bytes, 4) & 0xFFFFU) == 0;
            if (is_name && std::string(bytes.data() + kHead + 8) == kManager)
                manager = word_at(bytes, kHead);
            bytes.erase(0, size);
        }
    }
}

}  // namespace

VirtualPointer::VirtualPointer(const std::filesystem::path& socket)
    : socket_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, socket.c_str(), sizeof address.sun_path - 1);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        throw std::runtime_error("no compositor at " + socket.string());
    send(kDisplay, 1, words({kRegistry}));
    send(kDisplay, 0, words({kDone}));
    const std::uint32_t manager = read_until(kDone, socket_);
    if (manager == 0) throw std::runtime_error("the compositor has no virtual pointers");
    send(kRegistry, 0, words({manager}) + text(kManager) + words({1, kPointers}));
    send(kPointers, 0, words({0, kPointer}));
    send(kDisplay, 0, words({kMade}));
    static_cast<void>(read_until(kMade, socket_));
}

VirtualPointer::~VirtualPointer() {
    ::close(socket_);
}

void VirtualPointer::send(std::uint32_t object, std::uint32_t request,
                          const std::string& body) const {
    const auto size = static_cast<std::uint32_t>(body.size() + 8);
    const std::string bytes = words({object, (size << 16U) | request}) + body;
    if (::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) !=
        static_cast<ssize_t>(bytes.size()))
        throw std::runtime_error("the compositor takes no message");
}

void VirtualPointer::end_event() const {
    send(kPointer, 4, {});
}

void VirtualPointer::move_to(std::uint32_t x, std::uint32_t y) {
    send(kPointer, 1, words({0, x, y, kWhole, kWhole}));
    end_event();
}

void VirtualPointer::click() {
    constexpr std::uint32_t kLeftButton = 0x110;
    for (const std::uint32_t down : {1U, 0U}) {
        send(kPointer, 2, words({0, kLeftButton, down}));
        end_event();
    }
}

Compositor::Compositor(const std::string& output) {
    write_text(folder / "sway.conf", "output HEADLESS-1 " + output + "\ndefault_border none\n");
    environment = {"XDG_RUNTIME_DIR=" + folder.path().string(), "WLR_BACKENDS=headless",
                   "WLR_RENDERER=pixman", "WLR_LIBINPUT_NO_DEVICES=1",
                   "SWAYSOCK=" + (folder / "ipc").string()};
    std::vector<std::string> command{"sway", "-c", (folder / "sway.conf").string()};
    if (::geteuid() == 0) {  // which sway refuses
        run_shell("chown nobody '" + folder.path().string() + "'");
        command.insert(command.begin(),
                       {"setpriv", "--reuid=nobody", "--regid=nogroup", "--clear-groups"});
    }
    compositor = std::make_unique<Process>(command, environment, folder / "sway.txt");
    REQUIRE(eventually([this] { return performs("swaymsg workspace 1"); }));
    REQUIRE(eventually([this] { return !socket().empty(); }));
    environment.push_back("WAYLAND_DISPLAY=" + socket());
    keyboard = std::make_unique<Process>(std::vector<std::string>{"wtype", "-s", "3600000"},
                                         environment, folder / "keyboard.txt");
    // Without one GLFW 3.3 has no cursors, and crashes.
    pointer = std::make_unique<VirtualPointer>(folder / socket());
}

std::string Compositor::socket() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("wayland-") && !name.ends_with(".lock")) return name;
    }
    return {};
}

bool Compositor::performs(const std::string& command) const {
    std::string line = "exec > /dev/null 2>&1; ";
    for (const std::string& entry : environment) line += "export '" + entry + "'; ";
    return std::system((line + command).c_str()) == 0;  // NOLINT: of this test
}

std::vector<std::string> Compositor::host() const {
    std::vector<std::string> command{"env", "-u", "DISPLAY"};
    command.insert(command.end(), environment.begin(), environment.end());
    return command;
}

}  // namespace dibhr::test
