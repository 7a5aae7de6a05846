// What panels and keys ask the viewer to do after the picture, in the order in which they ask.
#pragma once

#include <algorithm>
#include <chrono>
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

/// What a person wants of depth that can be made for a video of colour alone.
enum class DepthWish { make, agree, cancel, open, close };

/// What was entered in the Open dialog, to be looked up.
struct TypedFile {
    std::string typed{};
    std::optional<FolderEntry> chosen{};  ///< where that is no file
};

struct SaveSidecar {};
struct LoadBump {
    std::filesystem::path file{};  ///< empty: no bump map
};
struct UseMaterial {
    std::string name{};  ///< as material_called() takes it
};
struct KeepMaterial {
    std::string name{};  ///< of what is felt
};
struct UseFirmware {
    std::filesystem::path file{};
};
struct AnswerDoubts {
    bool agreed{false};  ///< to UiState::doubts
};
struct RemovePaint {};
struct MarkMoment {
    std::chrono::steady_clock::time_point at{};
};
struct ReplayAsRecorded {};  ///< with no other parameters any more
struct LeaveReplay {};       ///< its video is to be touched
struct ReadFolder {
    std::filesystem::path folder{};  ///< for the Open dialog
};
struct CompleteTyped {
    std::string typed{};  ///< in the Open dialog
};
struct MakeReport {
    std::filesystem::path session{};
};

/// An Action: as its key, but that what a key leaves for after the picture is done then. A
/// DepthStatement: what a person says of the depth that is open.
using WindowCommand =
    std::variant<Action, OpenRequest, DepthStatement, DepthWish, TypedFile, SaveSidecar, LoadBump,
                 UseMaterial, KeepMaterial, UseFirmware, AnswerDoubts, RemovePaint, MarkMoment,
                 ReplayAsRecorded, LeaveReplay, ReadFolder, CompleteTyped, MakeReport>;

/// A visitor of lambdas.
template <typename... Visit>
struct Overloaded : Visit... {
    using Visit::operator()...;
};
template <typename... Visit>
Overloaded(Visit...) -> Overloaded<Visit...>;

class CommandQueue {
  public:
    /// What is asked for again before it was done is done once, as it was asked for last; but each
    /// moment is marked.
    void push(WindowCommand command) {
        const auto again = [&command](const WindowCommand& queued) {
            if (queued.index() != command.index()) return false;
            const Action* const action = std::get_if<Action>(&command);
            return action == nullptr || *action == std::get<Action>(queued);
        };
        const auto same = std::find_if(queue_.begin(), queue_.end(), again);
        if (same == queue_.end() || std::holds_alternative<MarkMoment>(command))
            queue_.push_back(std::move(command));
        else
            *same = std::move(command);
    }
    /// All of them, once.
    [[nodiscard]] std::vector<WindowCommand> take() { return std::exchange(queue_, {}); }
    [[nodiscard]] bool empty() const noexcept { return queue_.empty(); }

  private:
    std::vector<WindowCommand> queue_{};
};

}  // namespace dibhr
