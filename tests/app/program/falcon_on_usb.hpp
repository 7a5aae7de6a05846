// A simulated Falcon below the libusb of the real program, as the tests of the program see it.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/haptics/vec.hpp"

namespace dibhr::test {

/// Writes a synthetic firmware image.
void write_firmware(const std::filesystem::path& file);

/// One Falcon in a program that is started with its host().
class FalconOnUsb {
  public:
    /// `folder`: where its socket is; `commands`: performed before the program begins.
    FalconOnUsb(const std::filesystem::path& folder, std::vector<std::string> commands,
                bool keeps_packets = false);
    /// Every command it has been sent (tests/device/falcon/packet_file.hpp), where it keeps them.
    [[nodiscard]] const std::filesystem::path& packets() const noexcept { return packets_; }

    /// What starts the program.
    [[nodiscard]] std::vector<std::string> host() const;

    /// One of the commands of the simulated unit, or `unplug`, `replug`; the test fails unless it
    /// is performed.
    void tell(const std::string& command) const;
    /// The same; false: the program has ended.
    [[nodiscard]] bool try_to_tell(const std::string& command) const;
    /// A number, or the first of three, of its state; the test fails when there is none.
    [[nodiscard]] double number(const std::string& name) const;
    [[nodiscard]] Vec3 vector(const std::string& name) const;
    /// The hand goes there, mm, and has arrived.
    void move_hand(Vec3 to_mm, double seconds) const;
    /// Pulls the grip out and pushes it in, until all three axes are homed.
    void home() const;
    /// Until it has been sent so many more commands with a force; without one in between, so many
    /// in a row; of any kind.
    void wait_for_forces(double count) const;
    void wait_for_zeros(double count) const;
    void wait_for_commands(double count) const;
    /// Until `is_so`; fails the test when it never is.
    static void wait_until(const std::function<bool()>& is_so);

  private:
    [[nodiscard]] std::string state() const;
    void wait_for_more(const std::string& counter, double count) const;

    std::string socket_;
    std::filesystem::path packets_;
    std::vector<std::string> commands_;
    bool keeps_packets_;
};

}  // namespace dibhr::test
