// Commands of panels and keys, which the viewer carries out after the picture, in their order.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "app/settings/folder.hpp"
#include "app/settings/keys.hpp"
#include "app/touching/touch_state.hpp"
#include "core/video/depth/depth_meaning.hpp"

namespace dibhr {

/// Commands on the offer to make depth for a video of colour alone.
enum class DepthOfferCommand { make, agree, cancel, open, close };

/// A text entered in the Open dialog, to be resolved.
struct TypedFile {
    std::string typed{};
    std::optional<FolderEntry> chosen{};  ///< used if `typed` is no file
};

struct SaveSidecar {};
struct LoadBump {
    std::filesystem::path file{};  ///< empty: no bump map
};
struct UseMaterial {
    std::string name{};  ///< as material_named() takes it
};
struct KeepMaterial {
    std::string name{};  ///< for the current material
};
struct UseFirmware {
    std::filesystem::path file{};
};
struct AgreeToDevice {
    std::size_t kind{0};     ///< index in force_device_kinds()
    std::uint64_t offer{0};  ///< DeviceOffer::number
};
struct AnswerUnsafeSettings {
    bool agreed{false};  ///< to UiState::unsafe_settings
};
struct AnswerDepth {
    std::optional<std::size_t> alternative{};  ///< of UiState::depth_question; nothing: not sure
};
struct RemovePaint {};
struct MarkMoment {
    std::chrono::steady_clock::time_point at{};
};
struct ReplayAsRecorded {};  ///< back to the recorded parameters
struct LeaveReplay {};       ///< to touch its video
struct ReadFolder {
    std::filesystem::path folder{};  ///< for the Open dialog
};
struct CompleteTyped {
    std::string typed{};  ///< in the Open dialog
};
struct SkipLead {};  ///< the person needs none
enum class KioskCommand { next, say_again };
struct MakeReport {
    std::filesystem::path session{};
};
struct PrepareRecording {};  ///< the shown one; or cancels it

/// An Action does the same as its key, and also the work that a key defers until after the picture.
/// A DepthStatement is a person's statement on the open depth.
using WindowCommand =
    std::variant<Action, OpenRequest, DepthStatement, DepthOfferCommand, TypedFile, SaveSidecar,
                 LoadBump, UseMaterial, KeepMaterial, UseFirmware, AgreeToDevice,
                 AnswerUnsafeSettings, AnswerDepth, RemovePaint, MarkMoment, ReplayAsRecorded,
                 LeaveReplay, ReadFolder, CompleteTyped, KioskCommand, MakeReport, PrepareRecording,
                 SkipLead>;

/// A visitor of lambdas.
template <typename... Visit>
struct Overloaded : Visit... {
    using Visit::operator()...;
};
template <typename... Visit>
Overloaded(Visit...) -> Overloaded<Visit...>;

class CommandQueue {
  public:
    /// A command replaces a queued one of its kind. But each Action and each MarkMoment is kept: of
    /// two quick presses of a key none is lost.
    void push(WindowCommand command) {
        const bool each =
            std::holds_alternative<Action>(command) || std::holds_alternative<MarkMoment>(command);
        const auto same = std::find_if(
            queue_.begin(), queue_.end(),
            [&command](const WindowCommand& queued) { return queued.index() == command.index(); });
        if (each || same == queue_.end())
            queue_.push_back(std::move(command));
        else
            *same = std::move(command);
    }
    /// Empties the queue.
    [[nodiscard]] std::vector<WindowCommand> take() { return std::exchange(queue_, {}); }
    [[nodiscard]] bool empty() const noexcept { return queue_.empty(); }

  private:
    std::vector<WindowCommand> queue_{};
};

}  // namespace dibhr
