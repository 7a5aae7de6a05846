// The real program in a window of its own, its surface touched with a simulated Falcon, recorded.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "tests/app/program/desk.hpp"
#include "tests/app/program/falcon_on_usb.hpp"
#include "tests/device/falcon/packet_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::test {

/// Of a Falcon that stands before the relief, ready.
inline const std::vector<std::string> kHomedFalcon{"firmware", "home", "place 0 0 140"};

/// A small slope that costs nothing to decode: a file of every scene's folder.
inline constexpr const char* kSlope = "slope_color.png";
inline constexpr double kSlopePitch_mm = 101.6 / 64.0;  ///< as a picture of its width is fitted

struct FalconSceneOptions {
    std::vector<std::string> commands = kHomedFalcon;  ///< prepare the Falcon
    std::vector<std::string> arguments{kSlope};        ///< of the program; no file: the sample
    std::string device{"falcon"};
    bool records{true};               ///< from the beginning on, into hand.dibhr
    std::string settings{};           ///< of the settings file
    std::string agreed{};             ///< of the record of what was agreed to
    std::vector<std::string> host{};  ///< a program and its own arguments that starts all of it
    bool keeps_packets{false};        ///< FalconOnUsb::packets() is to be read
    Desk desk{};
};

class FalconScene {
  public:
    explicit FalconScene(FalconSceneOptions options = {});

    /// By the key that ends it: what was recorded, after the program has ended well.
    std::vector<Row> finish();
    /// What has been recorded up to now, or in all.
    [[nodiscard]] std::vector<Row> rows() const;
    /// Until what has been recorded is so; the test fails when it never is.
    void wait_until_recorded(const std::function<bool(const std::vector<Row>&)>& is_so) const;

    /// From afar into the relief, until the hand is pushed back.
    void press_in() const;
    void wait_for_force() const;

    /// Of a scene that keeps packets: the test fails unless the last five that the Falcon was sent,
    /// or more, had no force, and one before them had.
    void check_left_without_force() const;

    /// Of a scene that keeps packets: how long after `moment` the first packet without force came,
    /// after which none had any [s].
    [[nodiscard]] double seconds_to_zero(std::chrono::steady_clock::time_point moment) const;

    /// What the program has said on stderr.
    [[nodiscard]] std::string errors() const;

    const Desk desk;
    const TemporaryFolder folder{};
    const FalconOnUsb falcon;
    WindowProgram viewer;
};

}  // namespace dibhr::test
