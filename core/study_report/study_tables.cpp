// Trials and intervals as tables for R and Python.
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/files/csv_table.hpp"
#include "core/files/plain_text.hpp"
#include "core/study_report/study_report.hpp"

namespace dibhr {

namespace {

/// A line of cells.
class CsvLine {
  public:
    void text(std::string_view cell) {
        next();
        line_ += csv_cell(cell);
    }
    void number(double value) {
        next();
        append_number(line_, value);
    }
    void whole(std::int64_t value) {
        next();
        line_ += std::to_string(value);
    }
    template <typename Value>
    void maybe(bool known, Value value) {
        if (!known)
            next();
        else if constexpr (std::is_floating_point_v<Value>)
            number(value);
        else
            whole(value);
    }
    [[nodiscard]] std::string finish() { return line_ + '\n'; }

  private:
    void next() {
        if (begun_) line_ += ',';
        begun_ = true;
    }

    std::string line_{};
    bool begun_{false};
};

/// The condition, or of free exploration the answer.
std::string chosen_text(const Block& block, const AnsweredTrial& one) {
    if (block.form == TrialForm::explore && one.answer.choice >= 0)
        return block.question.answers[static_cast<std::size_t>(one.answer.choice)];
    return chosen_condition(one);
}

std::string trial_line(const Protocol& protocol, const StudyIdentity& who,
                       const AnsweredTrial& one) {
    const Trial& trial = one.trial;
    const Block& block = protocol.blocks[static_cast<std::size_t>(trial.block)];
    const StudyItem& item = block.items[static_cast<std::size_t>(trial.item)];
    CsvLine line;
    line.text(who.participant);
    line.whole(who.number);
    line.text(who.pilot);
    line.whole(trial.number + 1);
    line.text(block.name);
    line.whole(trial.position + 1);
    line.whole(trial.practice ? 1 : 0);
    line.text(name_of(block.form));
    line.text(protocol.conditions[item.reference].name);
    line.text(protocol.conditions[item.comparison].name);
    line.whole(trial.repetition + 1);
    line.maybe(trial.target >= 0, std::int64_t{trial.target} + 1);
    line.maybe(trial.track >= 0, std::int64_t{trial.track} + 1);
    line.text(block.variation.parameter);
    line.maybe(trial.level.has_value(), trial.level.value_or(0.0));
    line.maybe(one.answer.choice >= 0, std::int64_t{one.answer.choice} + 1);
    line.text(chosen_text(block, one));
    line.maybe(one.answer.number.has_value(), one.answer.number.value_or(0.0));
    line.maybe(one.right.has_value(), std::int64_t{one.right.value_or(false) ? 1 : 0});
    line.number(one.answer.reaction_s);
    line.number(one.utc_s);
    line.maybe(one.answer.early.has_value(), std::int64_t{one.answer.early.value_or(0)});
    return line.finish();
}

}  // namespace

std::string trials_csv(const Study& study) {
    std::string text =
        "participant,number,pilot,trial,block,position,practice,form,reference,comparison,"
        "repetition,target,track,parameter,level,choice,chosen,answer,right,reaction_s,utc_s,"
        "early\n";
    for (const StudyRecord& record : study.participants)
        for (const AnsweredTrial& one : record.answered)
            text += trial_line(study.protocol, record.identity, one);
    return text;
}

std::string intervals_csv(const Study& study, const std::vector<IntervalRow>& rows) {
    std::string text =
        "participant,trial,interval,condition,practice,duration_s,contact_s,updates,"
        "contact_updates,moves,sent_newton,sent_peak_newton,spring_newton,spring_peak_newton,"
        "path_mm,speed_mm_per_s,turning_mean_deg,turning_sd_deg,turning_pairs,value\n";
    for (const IntervalRow& row : rows) {
        const IntervalMotion& motion = row.motion;
        CsvLine line;
        line.text(study.participants[row.participant].identity.participant);
        line.whole(row.trial + 1);
        line.whole(row.interval + 1);
        line.text(row.condition);
        line.whole(row.practice ? 1 : 0);
        line.number(motion.duration_s);
        line.number(motion.contact_s);
        line.whole(motion.updates);
        line.whole(motion.contact_updates);
        line.whole(motion.moves);
        line.number(motion.sent_newton);
        line.number(motion.sent_peak_newton);
        line.number(motion.spring_newton);
        line.number(motion.spring_peak_newton);
        line.number(motion.path_mm);
        line.number(motion.speed_mm_per_s());
        line.number(motion.turning.mean_deg);
        line.number(motion.turning.sd_deg);
        line.whole(static_cast<std::int64_t>(motion.turning.pairs));
        line.maybe(row.value.has_value(), row.value.value_or(0.0));
        text += line.finish();
    }
    return text;
}

}  // namespace dibhr
