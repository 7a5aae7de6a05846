// A brush on the relief: strokes over the touch maps of the recording that is open, undone and
// kept.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/panels/viewer_state.hpp"
#include "app/touching/recording.hpp"
#include "app/viewer/errand.hpp"
#include "app/viewer/map_stroke.hpp"
#include "core/video/playing/player.hpp"

namespace dibhr {

/// The maps beside a recording, or why they cannot be had: then nothing is painted over them.
struct FoundMaps {
    std::shared_ptr<const TouchMaps> maps{};  ///< null: there are none
    std::string refusal{};
};

/// For a thread that may wait.
[[nodiscard]] FoundMaps find_maps(const MediaDescription& media);

class ViewerPainting {
  public:
    /// `errands` outlive it.
    explicit ViewerPainting(Errands& errands) : writing_(errands) {}
    ViewerPainting(const ViewerPainting&) = delete;
    ViewerPainting& operator=(const ViewerPainting&) = delete;

    /// A recording was opened. Gives the maps that are to lie on it; those of the same recording,
    /// opened with other words, are the ones that are painted already.
    [[nodiscard]] std::shared_ptr<const TouchMaps> begin(FoundMaps found,
                                                         const MediaDescription& media,
                                                         bool is_sample);
    /// A session is replayed: nothing can be painted.
    void end(ViewerState& state);

    /// Once a picture, while the brush is on. `under`: nothing: the pointer is beside the relief.
    void use(bool pressed, const std::optional<Vec3>& under, const DepthBlend& shown,
             ViewerState& state, Player& player);

    void undo(ViewerState& state, Player& player);
    void redo(ViewerState& state, Player& player);
    /// All maps; can be undone.
    void remove_all(ViewerState& state, Player& player);

    /// Once a picture: how it is, into `state`; what is felt, into the recording. Throws InputError
    /// when the maps could not be saved, once.
    void take_news(ViewerState& state, TouchRecording& recording);
    /// Before a recording ends: it gets the maps that it refers to. Waits for the disk so long.
    void hand_over(TouchRecording& recording, std::chrono::milliseconds patience = kPatience);
    /// At the end of the program: saves what is not saved. Throws InputError.
    void finish(TouchRecording& recording, std::chrono::milliseconds patience = kPatience);

    /// What is drawn: also a stroke that has not ended. Null: nothing is painted.
    [[nodiscard]] std::shared_ptr<const TouchMaps> drawn() const;
    /// The colour picture of a frame with what is painted over it; null: as it is.
    [[nodiscard]] const Frame* tinted(const Frame* frame, const ViewerState& state);

  private:
    static constexpr std::chrono::milliseconds kPatience{10'000};

    /// Maps as a recorder and the folder take them.
    struct Written {
        std::uint32_t version{0};
        std::vector<SessionMap> encoded{};
        std::string failure{};  ///< why the files could not be written
    };

    void start_stroke(const DepthBlend& shown, ViewerState& state, Player& player);
    void end_stroke(ViewerState& state, Player& player);
    void become(std::shared_ptr<const TouchMaps> maps, ViewerState& state, Player& player);
    void show_news(ViewerState& state) const;
    void start_writing();
    void take_written(TouchRecording& recording);
    [[nodiscard]] std::shared_ptr<const TouchMaps> numbered(TouchMaps maps);

    std::filesystem::path depth_{};  // of the recording that is open; empty: none
    int columns_{0}, rows_{0};
    bool is_sample_{false};
    std::string refusal_{};
    std::shared_ptr<const TouchMaps> maps_{};  // as they are felt; null: nothing is painted
    std::vector<std::shared_ptr<const TouchMaps>> before_{}, undone_{};
    std::optional<MapStroke> stroke_{};
    std::shared_ptr<const TouchMaps> drawn_{};
    std::uint32_t versions_{0};
    // What is still to be written, the oldest first: every version that a tick may have felt.
    struct ToWrite {
        std::filesystem::path depth{};
        std::shared_ptr<const TouchMaps> maps{};
        bool to_files{false};
    };
    std::vector<ToWrite> to_write_{};
    Errand<Written> writing_;
    std::string failure_{};  // to be told
    // What the tint was made of.
    Frame tinted_{};
    std::shared_ptr<const ColourImage> tinted_colour_{};
    std::shared_ptr<const TouchMaps> tinted_maps_{};
    BrushLays tinted_lays_{BrushLays::material};
};

}  // namespace dibhr
