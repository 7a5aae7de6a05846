// A Wayland compositor without a screen, with a keyboard that types nothing and a pointer.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tests/app/program/desk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::test {

/// The pointer of a wlroots compositor (zwlr_virtual_pointer_manager_v1), by messages on its
/// socket.
class VirtualPointer {
  public:
    explicit VirtualPointer(const std::filesystem::path& socket);
    ~VirtualPointer();
    VirtualPointer(const VirtualPointer&) = delete;
    VirtualPointer& operator=(const VirtualPointer&) = delete;

    /// As shares of the whole screen, in 1/1000.
    void move_to(std::uint32_t x, std::uint32_t y);
    void click();

  private:
    void send(std::uint32_t object, std::uint32_t request, const std::string& body) const;
    void end_event() const;

    int socket_{-1};
};

struct Compositor {
    TemporaryFolder folder{};
    std::vector<std::string> environment{};
    std::unique_ptr<Process> compositor{}, keyboard{};
    std::unique_ptr<VirtualPointer> pointer{};

    /// `output`: of its screen, as sway's configuration has it.
    explicit Compositor(const std::string& output = "resolution 640x480");

    /// Whether a command line succeeds there.
    [[nodiscard]] bool performs(const std::string& command) const;
    /// What starts a program on it.
    [[nodiscard]] std::vector<std::string> host() const;

  private:
    [[nodiscard]] std::string socket() const;
};

}  // namespace dibhr::test
