// What it means for the window that a force device goes from one stage to another.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "app/panels/viewer_state.hpp"
#include "app/touching/device_state.hpp"

namespace dibhr {

/// Of one device; `Stage` is its own, with `looking` and `ready` among them.
template <typename Stage>
class StageNews {
  public:
    /// Once a picture, with the stage it is at; `device`: what people call it. Brings the Device
    /// panel into sight once for each need of its person. A short notice when it begins to touch,
    /// of which `was_ready` tells whether it did before.
    [[nodiscard]] std::optional<std::string> take(Stage stage, const std::string& device,
                                                  bool& was_ready, ViewerState& state) {
        if (std::exchange(stage_, stage) == stage) return {};
        // One that comes again and again must not keep moving the panels.
        if (needs_its_person(stage) && shown_ != stage) {
            state.touch.needs_person = true;
            shown_ = stage;
        }
        if (stage != Stage::ready) return {};
        shown_ = stage;
        return "The " + device + " touches" + (std::exchange(was_ready, true) ? " again" : "");
    }

  private:
    Stage stage_{Stage::looking};  // as told
    Stage shown_{Stage::looking};  // for which the panel was brought into sight
};

}  // namespace dibhr
