// The steps of a study: what is shown next, and what follows from an answer. No clock, window or
// file, so that a window, a pilot and a resumed study run alike.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/study/protocol.hpp"
#include "core/study/trial.hpp"

namespace dibhr {

/// The current step: what is shown and expected.
enum class StudyStep : std::uint8_t {
    instructions,        ///< the study's page; go_on()
    block_instructions,  ///< a block's page; go_on()
    interval,            ///< something is felt; go_on()
    adjust,              ///< felt and changed until equal; accept() with a number
    question,            ///< accept(); with Block::again also repeat_interval()
    feedback,            ///< whether it was right; go_on()
    pause,               ///< a break; go_on()
    thanks,              ///< the end page; go_on()
    finished             ///< nothing is left
};

/// What comes next depends on protocol, number and answers alone.
class StudyRun {
  public:
    /// `number`: the participant's, from 1. `answered`: what was answered before, in order: the run
    /// goes on after it. Throws InputError when those are not trials of this protocol, number and
    /// order. The protocol is kept.
    StudyRun(Protocol protocol, int number, std::vector<AnsweredTrial> answered = {});

    [[nodiscard]] const Protocol& protocol() const noexcept { return protocol_; }
    [[nodiscard]] int number() const noexcept { return number_; }
    [[nodiscard]] StudyStep step() const noexcept { return step_; }
    /// What instructions, block_instructions and thanks show.
    [[nodiscard]] const StudyPage& page() const noexcept;
    /// The running trial's block; on pages and breaks the next trial's. Valid until `thanks`.
    [[nodiscard]] const Block& block() const noexcept;
    /// Of interval, adjust, question and feedback.
    [[nodiscard]] const Trial& trial() const noexcept { return trial_; }
    /// Which of the trial's intervals is felt, from 0.
    [[nodiscard]] int interval() const noexcept { return interval_; }
    /// Of feedback: the answer that it is about.
    [[nodiscard]] const AnsweredTrial& last() const noexcept { return answered_.back(); }
    [[nodiscard]] const std::vector<AnsweredTrial>& answered() const noexcept { return answered_; }
    /// From 0 to 1; with staircases a guess that never falls.
    [[nodiscard]] double share_done() const noexcept;

    /// Leaves a page, an interval, feedback or a break. After the last interval comes the question.
    /// Does nothing at a question, at an adjustment and at the end.
    void go_on();
    /// At a question with Block::again: back to that interval, and from there to the question.
    void repeat_interval(int interval);
    /// At an adjustment: feels the reference (0) or what is turned (1).
    void compare(int interval);
    /// The running trial with that answer, and whether it is right: to be stored before accept().
    /// Changes nothing. accepts() must be true for the answer.
    [[nodiscard]] AnsweredTrial judged(const StudyAnswer& answer, double utc_s) const;
    /// Goes on from a judged answer once it is safely stored.
    void accept(const AnsweredTrial& answered);
    /// Whether the trial's question takes that answer once it is asked: an existing choice, a
    /// rating in its range, a value in the range of the adjustment, or (with a time limit) none.
    [[nodiscard]] bool would_accept(const StudyAnswer& answer) const noexcept;
    /// The same, and the question is asked now.
    [[nodiscard]] bool accepts(const StudyAnswer& answer) const noexcept;

  private:
    /// The trial after those answered: its block's page first, or thanks.
    void find_next_trial();
    void begin_trial();
    void leave_trial();

    Protocol protocol_;
    int number_;
    std::vector<AnsweredTrial> answered_{};
    StudyStep step_{StudyStep::instructions};
    Trial trial_{};
    int interval_{0};
    bool felt_all_{false};  ///< an interval that is felt again leads back to the question
};

/// The trial that follows those answers (of all blocks, in order); nothing: the study is over. A
/// pure function of its arguments.
[[nodiscard]] std::optional<Trial> next_trial(const Protocol& protocol, int number,
                                              std::span<const AnsweredTrial> answered);

/// The order in which participant `number` (from 1) meets the block's items: indices, repetition
/// after repetition, of constant stimuli item * levels + level. Not for staircases.
[[nodiscard]] std::vector<int> order_of(const Protocol& protocol, int block, int number);

/// Row `row` of the balanced Latin square of `count` items (Williams 1949): of an even count
/// `count` rows, of an odd one twice as many, after which it begins again. Over all rows each item
/// is at each position equally often, and follows each other one equally often.
[[nodiscard]] std::vector<int> williams_row(int count, int row);
[[nodiscard]] int williams_rows(int count) noexcept;

}  // namespace dibhr
