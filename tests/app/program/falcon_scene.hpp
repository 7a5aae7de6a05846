// The real program in a window of its own, its sample touched with a simulated Falcon, recorded.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "tests/app/program/desk.hpp"
#include "tests/app/program/falcon_on_usb.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::test {

class FalconScene {
  public:
    /// `commands` prepare the Falcon. `settings`: of the settings file; `environment`: entries
    /// "NAME=value" of the program's alone.
    FalconScene(std::vector<std::string> commands, std::vector<std::string> arguments,
                const std::string& settings = {}, std::vector<std::string> environment = {});

    /// What was recorded, after the program has ended well.
    std::vector<Row> finish();

    /// From afar into the relief, until the hand is pushed back.
    void press_in() const;
    void wait_for_force() const;
    /// Until there has been none for a second: a busy machine may take it off for a moment.
    void wait_for_lasting_zero() const;

    /// How long after `moment` the first packet without force came, after which none had any [s].
    [[nodiscard]] double seconds_to_zero(std::chrono::steady_clock::time_point moment) const;

    /// What the program has said on stderr.
    [[nodiscard]] std::string errors() const;

    const Desk desk{};
    const TemporaryFolder folder{};
    const FalconOnUsb falcon;
    Process viewer;
};

/// Of a Falcon that stands before the relief, ready.
inline const std::vector<std::string> kHomedFalcon{"firmware", "home", "place 0 0 140"};

}  // namespace dibhr::test
