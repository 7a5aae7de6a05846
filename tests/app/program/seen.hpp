// What a window under test has shown last: written by the tests' build of the program after each
// turn of its loop, read by the test through memory that both have mapped.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <ostream>
#include <string>
#include <string_view>
#include <type_traits>

namespace dibhr::test {

/// Text in shared memory, cut where it is too long.
struct SeenText {
    std::array<char, 512> characters{};

    void set(std::string_view text) {
        const std::size_t length = std::min(text.size(), characters.size() - 1);
        std::copy_n(text.data(), length, characters.data());
        characters[length] = '\0';
    }
    [[nodiscard]] std::string str() const { return characters.data(); }
};

/// The newest turn of the window's loop, and the picture that is on the screen after it.
struct Seen {
    std::uint64_t turn{0};     ///< its number, from 1
    std::uint64_t picture{0};  ///< that picture's number, from 1; 0: none has been shown yet

    SeenText file{};      ///< the path of the colour, or of the session that is replayed
    bool open{false};     ///< there is media, or a session
    bool opening{false};  ///< further files are being opened
    bool surface{false};  ///< something to touch is drawn
    bool playing{false};
    bool looping{false};
    double part_from_s{-1.0}, part_to_s{-1.0};  ///< only that is played; -1: all of it
    bool replays{false};                        ///< a session is shown
    double speed{1.0};
    double media_s{0.0};  ///< the player's time; of a replay since the session's begin [s]
    double duration_s{0.0};
    double drawn_middle{0.0};  ///< depth in the middle of what is drawn, from 0, far, to 1, near
    double drawn_s{0.0};       ///< presentation time of the frame that is drawn [s]
    std::int64_t drawn_frame{-1};
    std::uint32_t drawn_media{0};  ///< another number with all that is opened
    std::int64_t tick{-1};         ///< of a replay, as people count: from 0

    bool in_front{false};
    int columns{0}, rows{0};  ///< of the window [px]
    bool panels{false};
    bool help{false};
    bool dialog{false};
    std::uint64_t dialog_entries{0};
    bool dialog_reads{false};
    bool dialog_typing{false};   ///< its line has the keyboard
    bool dialog_refuses{false};  ///< what was typed is no file
    SeenText dialog_folder{}, dialog_chosen{};
    std::uint64_t dialog_recordings{0};  ///< folders that are marked so
    SeenText preview_text{};
    bool preview_depth{false};                      ///< a picture of the depth is shown
    SeenText focus{}, focus_kind{}, focus_value{};  ///< of the item that has the keyboard
    bool keys_move_hand{false};
    bool statistics{false};
    bool ruler{false};
    int ruler_points{0};
    bool brush{false}, painted{false}, can_undo{false};
    SeenText region{};        ///< the named region under the finger
    bool region_text{false};  ///< with its text
    SeenText caption{};
    std::uint64_t regions{0};  ///< named ones of the recording
    int lead{0};               ///< the step that a person is led through, from 1; 0: none
    bool lead_done{false};     ///< the person has done it
    bool as_recorded{false};
    bool explained{false};
    std::uint64_t explained_steps{0};  ///< taken
    std::uint64_t unsafe_settings{0};  ///< of the settings, about which a person is asked
    bool asks_command{false};          ///< whether to run it
    std::uint64_t depth_answers{0};    ///< to the question on the depth; 0: it is not asked
    std::uint64_t depth_reliefs{0};    ///< of them drawn
    bool depth_for_folder{false};      ///< the answer holds for other files, too
    bool depth_offered{false};
    bool depth_in_work{false};                  ///< it is being made
    bool depth_made{false};                     ///< while something else was opened
    float pointed_column{-1}, pointed_row{-1};  ///< the pixel under the pointer; -1: beside
    SeenText message{};                         ///< of the box
    SeenText notice{};                          ///< the newest, also after it has faded

    std::uint64_t ticks{0};
    bool touchable{false};
    bool contact{false};
    bool ready{false};           ///< the hand gives poses
    bool mouse_fallback{false};  ///< the mouse stands in for a device
    bool force_enabled{false};
    std::uint8_t buttons{0};
    int cut{0};                 ///< a SafetyCut
    double spring_newton{0.0};  ///< before the safety stage
    double sent_newton{0.0};    ///< after it
    std::uint64_t standstills{0};

    bool records{false};
    std::uint64_t recorded_rows{0};  ///< safely in the file
    std::uint64_t marks{0};
    bool clip{false};
    bool clip_finishing{false};
    double clip_s{0.0};
    int sound{0};  ///< a SoundOutput::State

    bool study{false};
    int study_step{-1};  ///< a StudyStep
    int trial{-1}, interval{-1};
    bool waits{false};  ///< for the surface of an interval
    bool asks_consent{
        false};           ///< whoever leads the study is asked whether it may protect the hand less
    bool leaving{false};  ///< the participant is asked whether to leave
    double asked_s{0.0};  ///< by the steady clock: what is asked is on the screen; 0: not yet
    /// By the same clock, the newest question was on the screen; and its trial, -1: none was.
    double question_seen_s{0.0};
    int question_trial{-1};
};
static_assert(std::is_trivially_copyable_v<Seen>);

/// For the message of a test that waited in vain.
std::ostream& operator<<(std::ostream& out, const Seen& seen);

/// The memory: one writer, any readers; a reader never sees half of a turn.
struct SeenBoard {
    static constexpr const char* kVariable = "DIBHR_SEEN_BOARD";  ///< names its file

    /// The writer's.
    void write(const Seen& seen) {
        turn_.fetch_add(1, std::memory_order_acq_rel);
        std::memcpy(&seen_, &seen, sizeof seen);
        turn_.fetch_add(1, std::memory_order_release);
    }
    [[nodiscard]] Seen read() {
        for (;;) {
            const std::uint64_t before = turn_.load(std::memory_order_acquire);
            Seen seen;
            std::memcpy(&seen, &seen_, sizeof seen);
            // Adds 0 in place of a fence, which the thread sanitizer does not support.
            if (turn_.fetch_add(0, std::memory_order_acq_rel) == before && before % 2 == 0)
                return seen;
        }
    }

    /// While it is true the window's thread loops after its next turn.
    std::atomic<bool> hangs{false};
    std::atomic<bool> is_hanging{false};  ///< it does

  private:
    std::atomic<std::uint64_t> turn_{0};  // odd: being written
    Seen seen_{};
};

/// Maps a board from its file; made there when it is not. Throws std::system_error.
class MappedBoard {
  public:
    explicit MappedBoard(const std::filesystem::path& file);
    ~MappedBoard();
    MappedBoard(const MappedBoard&) = delete;
    MappedBoard& operator=(const MappedBoard&) = delete;

    [[nodiscard]] SeenBoard& operator*() const { return *board_; }
    [[nodiscard]] SeenBoard* operator->() const { return board_; }

  private:
    SeenBoard* board_{nullptr};
};

}  // namespace dibhr::test
