// The steps of a study.
#include "core/study/study_run.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/error.hpp"

namespace dibhr {

StudyRun::StudyRun(Protocol protocol, int number, std::vector<AnsweredTrial> answered)
    : protocol_(std::move(protocol)), number_(number), answered_(std::move(answered)) {
    const std::span<const AnsweredTrial> all = answered_;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const auto expected = next_trial(protocol_, number_, all.first(k));
        if (!expected || *expected != all[k].trial)
            throw InputError("trial " + std::to_string(k + 1) +
                             " in the study file is not the one that this protocol gives: go on "
                             "with the version of the program that began the study");
    }
    if (answered_.empty() && !protocol_.instructions.empty())
        step_ = StudyStep::instructions;
    else
        find_next_trial();
}

const StudyPage& StudyRun::page() const noexcept {
    if (step_ == StudyStep::instructions) return protocol_.instructions;
    if (step_ == StudyStep::block_instructions) return block().instructions;
    return protocol_.thanks;
}

const Block& StudyRun::block() const noexcept {
    return protocol_.blocks[static_cast<std::size_t>(trial_.block)];
}

double StudyRun::share_done() const noexcept {
    if (step_ == StudyStep::thanks || step_ == StudyStep::finished) return 1.0;
    int done = 0;
    for (int k = 0; k < trial_.block; ++k)
        done += protocol_.blocks[static_cast<std::size_t>(k)].most_trials();
    const int in_block = step_ == StudyStep::feedback ? trial_.position + 1 : trial_.position;
    return static_cast<double>(done + in_block) / std::max(1, protocol_.most_trials());
}

void StudyRun::go_on() {
    switch (step_) {
        case StudyStep::instructions:
            find_next_trial();
            break;
        case StudyStep::block_instructions:
        case StudyStep::pause:
            begin_trial();
            break;
        case StudyStep::interval: {
            const int last = block().intervals() - 1;
            if (trial_.form == TrialForm::adjust) {
                interval_ = last;
                step_ = StudyStep::adjust;
            } else if (felt_all_ || interval_ == last) {
                felt_all_ = true;
                step_ = StudyStep::question;
            } else {
                ++interval_;
            }
            break;
        }
        case StudyStep::feedback:
            leave_trial();
            break;
        case StudyStep::thanks:
            step_ = StudyStep::finished;
            break;
        case StudyStep::adjust:
        case StudyStep::question:
        case StudyStep::finished:
            break;
    }
}

void StudyRun::repeat_interval(int interval) {
    const bool may = step_ == StudyStep::question && block().again;
    if (!may || interval < 0 || interval >= block().intervals()) return;
    interval_ = interval;
    step_ = StudyStep::interval;
}

void StudyRun::compare(int interval) {
    if (step_ == StudyStep::adjust) interval_ = std::clamp(interval, 0, block().intervals() - 1);
}

bool StudyRun::accepts(const StudyAnswer& answer) const noexcept {
    return (step_ == StudyStep::question || step_ == StudyStep::adjust) && would_accept(answer);
}

bool StudyRun::would_accept(const StudyAnswer& answer) const noexcept {
    const Block& now = block();
    const bool none = answer.choice < 0 && !answer.number;
    if (none) return now.answer_s > 0.0;
    switch (now.form) {
        case TrialForm::adjust:
            return answer.choice < 0 && *answer.number >= now.variation.lowest &&
                   *answer.number <= now.variation.highest;
        case TrialForm::rating:
            return answer.choice < 0 && *answer.number >= now.question.lowest &&
                   *answer.number <= now.question.highest &&
                   *answer.number == std::round(*answer.number);
        case TrialForm::explore:
            return !answer.number && answer.choice < static_cast<int>(now.question.answers.size());
        case TrialForm::two_interval:
        case TrialForm::three_interval:
            return !answer.number && answer.choice < now.intervals();
    }
    return false;
}

AnsweredTrial StudyRun::judged(const StudyAnswer& answer, double utc_s) const {
    assert(accepts(answer));
    return {.trial = trial_, .answer = answer, .right = is_right(trial_, answer), .utc_s = utc_s};
}

void StudyRun::accept(const AnsweredTrial& answered) {
    answered_.push_back(answered);
    if (block().feedback && answered.right)
        step_ = StudyStep::feedback;
    else
        leave_trial();
}

void StudyRun::leave_trial() {
    const int left = trial_.block;
    const int every = block().break_after;
    find_next_trial();
    const bool goes_on = step_ != StudyStep::thanks && trial_.block == left;
    if (!goes_on) return;
    if (every > 0 && trial_.position % every == 0)
        step_ = StudyStep::pause;
    else
        begin_trial();
}

void StudyRun::find_next_trial() {
    const auto next = next_trial(protocol_, number_, answered_);
    if (!next) {
        step_ = StudyStep::thanks;
        return;
    }
    trial_ = *next;
    if (block().instructions.empty())
        begin_trial();
    else
        step_ = StudyStep::block_instructions;
}

void StudyRun::begin_trial() {
    interval_ = 0;
    felt_all_ = false;
    step_ = StudyStep::interval;
}

}  // namespace dibhr
