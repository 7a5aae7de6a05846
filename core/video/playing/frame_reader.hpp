// Frames of one media, cleaned, in any order.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/realtime/now.hpp"
#include "core/video/frames/frame_window.hpp"
#include "core/video/playing/decoded_ahead.hpp"
#include "core/video/playing/frame_assembly.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

/// What the last frame cost.
struct FrameCost {
    double decode_ms{0.0};                            ///< waited for
    double clean_ms{0.0};                             ///< on whichever thread
    std::chrono::steady_clock::time_point cleaned{};  ///< when it was ready
};

/// Which of the frames that follow one are wanted, while they play; media time [s].
struct Pace {
    double earliest_s{0.0};  ///< those before are passed over, up to the last
    double apart_s{0.0};     ///< so much after the one that is given out the next one is wanted
};

/// Decodes on a thread of its own, which cleans alone what waits; is called by one thread at a
/// time. Frames are named by their presentation time in the file; those given out have `time_s` 0.
/// Everything that decodes may throw InputError.
class FrameReader {
  public:
    /// Every frame carries `number`, for who needs to know where it came from. `now` is what
    /// decoding and cleaning are measured by.
    explicit FrameReader(std::unique_ptr<Media> media, std::uint32_t number = 0,
                         ReadingHearts hearts = {}, Now now = std::chrono::steady_clock::now);

    /// The frame shown at `media_s`; the first before the beginning, the last after the end.
    std::optional<Frame> at(double media_s);
    /// The frame after the one at exactly `media_s`, or what the pace wants instead; nothing at the
    /// end.
    std::optional<Frame> after(double media_s, const Pace& pace = {});
    /// The frame before the one at exactly `media_s`; nothing at the beginning.
    std::optional<Frame> before(double media_s);

    /// For the eye, while at() would take long: a frame near `media_s` as quickly as one can be
    /// had, cleaned by itself. Nothing where at() is as quick.
    std::optional<Frame> preview(double media_s);

    /// How long the last frame, the one at exactly `media_s`, is shown: as long as the one before,
    /// or, where that was passed over, as long as frames are on average [s].
    [[nodiscard]] double last_interval_s(double media_s);

    /// Tells `from` how it becomes `next`, both given out as they are cleaned now and the one after
    /// the other: its motion and what is between them, where that is wanted and this machine has
    /// time for it. Nothing is known of frames that are not next to each other in the file.
    void connect(Frame& from, const Frame& next);
    /// What connect() finds out from here on.
    void set_motion(const MotionWanted& wanted) { assembly_.set_motion(wanted); }

    /// From here on frames come cleaned so; those given out before are asked for again.
    void set_cleaning(const CleaningOptions& options);

    /// From here on frames carry these; null: none.
    void set_maps(std::shared_ptr<const TouchMaps> maps);

    [[nodiscard]] const MediaDescription& description() const { return media_.description(); }
    [[nodiscard]] const FrameCost& cost() const { return cost_; }
    /// How many frames after() has passed over.
    [[nodiscard]] std::int64_t passed_over() const { return passed_over_; }
    /// How long a frame takes that is passed over, as of late [s]: where it is only decoded that,
    /// else how long one is waited for without what is done to it ahead of time.
    [[nodiscard]] double decoding_s() const { return decoding_s_; }

    /// How long one that is not passed over takes beyond that, on the thread that decodes, as of
    /// late [s]; 0: nothing, or it is not known.
    [[nodiscard]] double making_s() const { return making_s_; }

    /// The sum of all waits, and of what measuring a clip's noise and motion took [s]: the one
    /// happens once, the other rests where there is no time for it.
    [[nodiscard]] double waited_s() const { return waited_s_; }

    /// What is done to them, once a frame has been given out.
    [[nodiscard]] const CleaningPlan& plan() const { return assembly_.plan(); }

  private:
    static constexpr int kLongestRest = 20'000;  ///< frames without motion
    /// Of a kept frame: to give it out, or to clean others with it.
    enum class Needs { surface, depth };
    /// A decoded frame and its neighbours, as far as they were read one after the other. Cleaned by
    /// itself and then with those around it when that is asked for; what was made of it last may be
    /// all that is left.
    struct Kept {
        Frame frame{};   ///< without its depth until that is cleaned
        RawFrame raw{};  ///< without its colour; its lone_ms until they are told
        std::optional<double> previous_s{}, next_s{};
        bool first{false}, last{false};  ///< of the media

        [[nodiscard]] bool is_cleaned() const { return frame.depth != nullptr; }
        void forget_cleaned();
        [[nodiscard]] bool can_be_cleaned() const { return raw.lone || !raw.depth.levels.empty(); }
        [[nodiscard]] bool has(Needs needs) const {
            if (needs == Needs::depth) return can_be_cleaned();
            return frame.colour && (is_cleaned() || can_be_cleaned());
        }
        [[nodiscard]] std::size_t bytes() const;
    };
    /// Of the last decoded frame. Gapless: those that follow it come one by one.
    struct Position {
        double media_s{0.0};
        bool gapless{true};
    };
    /// Where the next decoded frame is, and after which one those begin that are not kept.
    struct Heading {
        double from_s{0.0}, kept_to_s{0.0};
    };
    struct Around {
        std::vector<std::shared_ptr<const LoneDepth>> frames{};
        std::size_t now{0};
    };

    // Null: it is not kept. What is found stays where it is until the next frame is read.
    Kept* find(double media_s);        ///< at exactly that time
    Kept* find_shown(double media_s);  ///< shown then, and can be given out
    /// Decodes the next frame that the pace wants and keeps it; null at the end.
    Kept* read(const Pace& pace = {});
    void tell_wait(const RawFrame& raw, std::int64_t frames, double waited_s);
    Kept* keep(RawFrame raw);
    const std::shared_ptr<const LoneDepth>& lone_of(Kept& kept);
    Kept* kept_after(const Kept& kept, Needs needs);
    Kept* next_of(double media_s, Needs needs);  ///< of one at exactly that time; null at the end
    Kept* looked_ahead(double media_s);
    Kept* looked_back(double media_s);
    Kept* previous_of(double media_s, Needs needs);  ///< null at the beginning
    void jump_to(double media_s);
    [[nodiscard]] bool heads_for(double media_s) const;
    [[nodiscard]] bool goes_on_after(double media_s) const;
    const Kept* next_wanted(double media_s, const Pace& pace);
    void go_on_from_kept(double media_s);
    void let_go();
    [[nodiscard]] std::size_t reach() const;
    void make_plan();
    void clean_ahead();
    void keep_pace(std::int64_t passed_over);
    [[nodiscard]] static DepthNoise noise_of(Media& media);
    Around around(double media_s);
    Frame cleaned(double media_s);  ///< of a kept frame at exactly that time
    [[nodiscard]] double seconds_since(std::chrono::steady_clock::time_point begin) const;

    Now now_;
    FrameAssembly assembly_;
    DecodedAhead media_;  // after what its thread uses
    CleaningOptions options_{};
    std::optional<DepthNoise> noise_{};  ///< of the clip, once it is needed
    /// A file that broke off after a frame, which was noticed ahead of time.
    struct Broken {
        double after_s{0.0};
        std::exception_ptr why{};
    };
    std::optional<Broken> broken_{};
    bool planned_{false};                 ///< the assembly has what the options mean for it
    std::map<double, Kept> kept_{};       ///< by presentation time
    double wanted_s_{0.0};                ///< the frame that is, or was last, given out
    bool at_beginning_{true};             ///< the next frame is the first one
    std::optional<Position> position_{};  ///< if the next decoded frame comes after it
    std::optional<Heading> heading_{};    ///< the decoder's, until it is read
    int in_a_row_{0};                     ///< frames that after() gave out since a jump or a step
    double decoding_s_{0.0};
    double making_s_{0.0};
    double waited_s_{0.0};
    double jump_s_;  ///< how long the last one took, to a frame that was not kept
    std::int64_t passed_over_{0};
    int in_time_{0};  ///< frames since one was passed over
    FrameCost cost_{};
};

}  // namespace dibhr
