// A brush on the relief: strokes over the touch maps of the open recording; undo; saving.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/panels/viewer_state.hpp"
#include "app/touching/recording.hpp"
#include "app/viewer/painting/map_stroke.hpp"
#include "app/viewer/painting/paint_tint.hpp"
#include "app/viewer/painting/region_stroke.hpp"
#include "app/viewer/task_group.hpp"
#include "core/video/playing/player.hpp"

namespace dibhr {

/// The maps beside a recording, or why they cannot be read: then painting is refused.
struct FoundMaps {
    std::shared_ptr<const TouchMaps> maps{};  ///< null: there are none
    std::string refusal{};
};

/// The named regions beside a recording, or why they cannot be read: then none is painted.
struct FoundRegions {
    std::shared_ptr<const Regions> regions{};  ///< null: there are none
    std::string refusal{};
};

/// Reads files: not for the window's thread.
[[nodiscard]] FoundMaps find_maps(const MediaDescription& media);

class ViewerPainting {
  public:
    /// The task group must outlive it.
    explicit ViewerPainting(TaskGroup& tasks) : writing_(tasks) {}
    ViewerPainting(const ViewerPainting&) = delete;
    ViewerPainting& operator=(const ViewerPainting&) = delete;

    /// A recording was opened. Returns the maps to lay on it. For the same recording, reopened with
    /// other depth options, all is as painted so far.
    [[nodiscard]] std::shared_ptr<const TouchMaps> begin(FoundMaps found, FoundRegions regions,
                                                         const MediaDescription& media,
                                                         bool is_sample);
    /// A session is replayed: painting ends.
    void end(ViewerState& state);

    /// Once a turn, while the brush is on. `under` empty: the pointer is beside the relief.
    void use(bool pressed, const std::optional<Vec3>& under, const DepthBlend& shown,
             ViewerState& state, Player& player);

    void undo(ViewerState& state, Player& player);
    void redo(ViewerState& state, Player& player);
    /// Removes all maps; can be undone.
    void remove_all(ViewerState& state, Player& player);

    /// Once a turn: updates the brush in `state`, and passes new maps to the recording. Throws
    /// InputError, once, when the maps could not be saved.
    void poll(ViewerState& state, TouchRecording& recording);
    /// Before a recording ends: passes it all maps of its ticks. Waits at most `patience`.
    void flush_maps(TouchRecording& recording, std::chrono::milliseconds patience = kPatience);
    /// At the end of the program: saves the unsaved maps. Throws InputError.
    void finish(TouchRecording& recording, std::chrono::milliseconds patience = kPatience);

    /// What is painted; null: nothing.
    [[nodiscard]] const std::shared_ptr<const TouchMaps>& painted() const { return painted_.maps; }
    [[nodiscard]] const std::shared_ptr<const Regions>& regions() const { return painted_.regions; }
    /// The number for other maps that are felt in its place.
    [[nodiscard]] std::uint32_t new_version() { return ++versions_; }
    /// Lays these over the recording in place of what is painted, until that changes.
    void feel(std::shared_ptr<const TouchMaps> maps, Player& player);

    /// The maps to draw, with an unfinished stroke. Null: there are none.
    [[nodiscard]] std::shared_ptr<const TouchMaps> drawn() const;
    /// The frame's colour picture with the paint over it; `frame` itself where there is none.
    [[nodiscard]] const Frame* tinted(const Frame* frame, const ViewerState& state);
    /// A material was kept: its tint may be another.
    void forget_tints();

  private:
    static constexpr std::chrono::milliseconds kPatience{10'000};

    /// What there is to undo and redo.
    struct Painted {
        std::shared_ptr<const TouchMaps> maps{};   // null: nothing is painted
        std::shared_ptr<const Regions> regions{};  // null: there are none
    };
    /// Maps encoded for the recorder, and the result of writing their files.
    struct Written {
        std::uint32_t version{0};
        std::vector<SessionMap> encoded{};
        std::string failure{};  ///< why the files could not be written
    };

    void start_stroke(const DepthBlend& shown, ViewerState& state, Player& player);
    void end_stroke(ViewerState& state, Player& player);
    void keep_stroke(Painted painted, ViewerState& state, Player& player);
    void replace(Painted painted, ViewerState& state, Player& player);
    [[nodiscard]] Painted shown() const;
    void update_brush(ViewerState& state) const;
    [[nodiscard]] std::vector<SessionMap> encoded_as(std::uint32_t version) const;
    void start_writing();
    void take_written(TouchRecording& recording);
    [[nodiscard]] std::shared_ptr<const TouchMaps> numbered(TouchMaps maps);

    std::filesystem::path depth_{};  // depth file of the open recording; empty: none
    int columns_{0}, rows_{0};
    bool is_sample_{false};
    std::string refusal_{}, regions_refusal_{};
    Painted painted_{};
    std::shared_ptr<const TouchMaps> felt_{};  // as the tick uses them
    std::vector<Painted> before_{}, undone_{};
    std::optional<MapStroke> stroke_{};
    std::optional<RegionStroke> region_stroke_{};  // of a region, or beside stroke_: erasing
    Painted drawn_{};                              // of the strokes so far
    std::uint32_t versions_{0};
    // Versions to write, the oldest first: every version that a tick may have used.
    struct ToWrite {
        std::filesystem::path depth{};
        Painted painted{};
        bool maps_to_files{false};
        bool regions_to_files{false};
    };
    std::vector<ToWrite> to_write_{};
    BackgroundTask<Written> writing_;
    std::map<std::uint32_t, std::vector<SessionMap>> encoded_{};  // of maps felt in their place
    std::string failure_{};                                       // for the next poll()
    // What tinted_ was made of.
    std::vector<PaintedMaterial> materials_{};
    Frame tinted_{};
    std::shared_ptr<const void> tinted_of_{};  ///< the colour
    Painted tinted_as_{};
    BrushLayer tinted_layer_{BrushLayer::material};
};

}  // namespace dibhr
