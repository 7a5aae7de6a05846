// Answers by a psychometric function, a preference, or chance.
#include "core/study/simulated_participant.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/spelling.hpp"
#include "core/haptics/enum_names.hpp"
#include "core/psychophysics/random.hpp"

namespace dibhr {

namespace {

bool has(const SimulatedParticipant& who, const StudyInterval& interval) {
    return !who.prefers.empty() && interval.condition == who.prefers;
}

int any_of(int count, Random& draws) {
    return static_cast<int>(draws.below(static_cast<std::uint32_t>(count)));
}

int another(int than, int count, Random& draws) {
    return (than + 1 + any_of(count - 1, draws)) % count;
}

/// The target, with the level's probability; below zero the other interval.
int chosen_by_level(const SimulatedParticipant& who, const Trial& trial, Random& draws) {
    const int count = static_cast<int>(trial.intervals.size());
    const double level = *trial.level;
    if (level == 0.0) return any_of(count, draws);
    const bool hit = draws.chance(who.function(1.0 / count).share(std::abs(level)));
    const bool target = hit == (level > 0.0 || trial.form == TrialForm::three_interval);
    return target ? trial.target : another(trial.target, count, draws);
}

int chosen_by_preference(const SimulatedParticipant& who, const Trial& trial, Random& draws) {
    const int count = static_cast<int>(trial.intervals.size());
    // The probability of noticing, with guesses otherwise, at which choices come to `share`; below
    // chance the other one is preferred.
    const double noticing = (who.share - 1.0 / count) / (1.0 - 1.0 / count);
    const bool attends =
        !draws.chance(who.lapse) && (who.share >= 1.0 || draws.chance(std::abs(noticing)));
    const auto& all = trial.intervals;
    const bool noticed = std::any_of(all.begin(), all.end(),
                                     [&](const StudyInterval& one) { return has(who, one); });
    if (!attends || !noticed) return any_of(count, draws);
    if (trial.form == TrialForm::three_interval) return trial.target;
    return has(who, all[0]) == (noticing > 0.0) ? 0 : 1;
}

int chosen_answer(const SimulatedParticipant& who, const StudyRun& run, Random& draws) {
    const Trial& trial = run.trial();
    const int count = static_cast<int>(run.block().question.answers.size());
    if (who.guesses) return any_of(count, draws);
    if (!trial.level) {
        const bool best = has(who, trial.intervals.front()) && !draws.chance(who.lapse);
        return best ? 0 : any_of(count, draws);
    }
    const double share =
        *trial.level > 0.0 ? who.function(who.false_alarm).share(*trial.level) : who.false_alarm;
    return draws.chance(share) ? 0 : another(0, count, draws);
}

double rating(const SimulatedParticipant& who, const StudyRun& run, Random& draws) {
    const Question& question = run.block().question;
    const int steps = question.highest - question.lowest;
    if (who.guesses) return question.lowest + any_of(steps + 1, draws);
    const double middle = question.lowest + 0.5 * steps;
    const double more =
        has(who, run.trial().intervals.front()) ? who.difference.value_or(0.25 * steps) : 0.0;
    const double felt = middle + more + who.noise * draws.normal();
    return std::clamp(std::round(felt), static_cast<double>(question.lowest),
                      static_cast<double>(question.highest));
}

double adjusted(const SimulatedParticipant& who, const StudyRun& run, Random& draws) {
    const Variation& vary = run.block().variation;
    if (who.guesses) return vary.lowest + (vary.highest - vary.lowest) * draws.uniform();
    return std::clamp(vary.reference + who.bias + who.noise * draws.normal(), vary.lowest,
                      vary.highest);
}

/// One person of this kind. The same number gives the same person.
SimulatedParticipant person_of(SimulatedParticipant who, const StudyRun& run) {
    if (!(who.spread > 0.0)) return who;
    constexpr std::uint64_t kPerson = 0x706572736f6eU;
    Random draws = draws_for(run.protocol().seed,
                             {who.seed, static_cast<std::uint64_t>(run.number()), kPerson});
    const double off = who.spread * draws.normal();
    who.threshold *= std::exp(off);
    who.bias += off;
    if (who.share < 1.0) who.share = std::clamp(who.share + off, 0.0, 1.0 - 1e-9);
    if (who.difference) *who.difference += off;
    return who;
}

}  // namespace

PsychometricFunction SimulatedParticipant::function(double guess) const {
    return {.curve = Curve::logistic,
            .threshold = threshold,
            .scale = 0.25 / slope,
            .level = 0.5,
            .guess = guess,
            .lapse = lapse};
}

SimulatedParticipant simulated_participant(const std::string& text) {
    SimulatedParticipant who{.guesses = false};
    double seed = 1.0;
    double difference = std::numeric_limits<double>::quiet_NaN();
    const struct {
        const char* name;
        double& value;
        double lowest, highest;
    } numbers[] = {
        {"threshold", who.threshold, 1e-9, 1e9}, {"slope", who.slope, 1e-9, 1e9},
        {"lapse", who.lapse, 0.0, 0.5},          {"false-alarm", who.false_alarm, 0.0, 0.99},
        {"bias", who.bias, -1e9, 1e9},           {"noise", who.noise, 0.0, 1e9},
        {"share", who.share, 1.0 / 3.0, 1.0},    {"difference", difference, -1e9, 1e9},
        {"spread", who.spread, 0.0, 1e9},        {"seed", seed, 0.0, 1e9}};
    const std::vector<std::string> names = all_names(numbers);
    std::set<std::string> given;
    std::istringstream parts(text);
    for (std::string part; std::getline(parts, part, ',');) {
        const auto equals = part.find('=');
        const std::string name = part.substr(0, equals);
        const std::string value = equals == std::string::npos ? "" : part.substr(equals + 1);
        const auto* const found = std::find_if(std::begin(numbers), std::end(numbers),
                                               [&](const auto& one) { return name == one.name; });
        if (!given.insert(name).second)
            throw InputError("the pilot has " + in_quotes(name) + " twice: leave one out");
        if (part == "guess") {
            who.guesses = true;
            continue;
        }
        if (name == "prefer" && !value.empty()) {
            who.prefers = value;
            continue;
        }
        if (found == std::end(numbers)) {
            std::vector<std::string> words = names;
            words.insert(words.end(), {"guess", "hand", "prefer"});
            throw InputError("a pilot is guess, hand, prefer=CONDITION, or some of " +
                             listed(names) + " as NAME=VALUE, with commas, not " + in_quotes(part) +
                             did_you_mean(name, words));
        }
        const auto number = number_of_text(value);
        if (!number || *number < found->lowest || *number > found->highest)
            throw InputError("the pilot's " + name + " is not a number from " +
                             short_text(found->lowest) + " to " + short_text(found->highest));
        found->value = *number;
    }
    for (const std::string& name : given)
        if (who.guesses && name != "guess" && name != "seed")
            throw InputError("a pilot that guesses feels nothing and has no " + name +
                             ": leave it out, or guess");
    who.seed = static_cast<std::uint64_t>(seed);
    if (std::isfinite(difference)) who.difference = difference;
    return who;
}

StudyAnswer answer_of(const SimulatedParticipant& kind, const StudyRun& run) {
    const SimulatedParticipant who = person_of(kind, run);
    const Trial& trial = run.trial();
    Random draws =
        draws_for(run.protocol().seed, {who.seed, static_cast<std::uint64_t>(run.number()),
                                        static_cast<std::uint64_t>(trial.number)});
    StudyAnswer answer{.reaction_s = 0.4 + 1.2 * draws.uniform()};
    const int intervals = static_cast<int>(trial.intervals.size());
    switch (trial.form) {
        case TrialForm::explore:
            answer.choice = chosen_answer(who, run, draws);
            break;
        case TrialForm::rating:
            answer.number = rating(who, run, draws);
            break;
        case TrialForm::adjust:
            answer.number = adjusted(who, run, draws);
            break;
        case TrialForm::two_interval:
        case TrialForm::three_interval:
            if (who.guesses)
                answer.choice = any_of(intervals, draws);
            else if (trial.level)
                answer.choice = chosen_by_level(who, trial, draws);
            else
                answer.choice = chosen_by_preference(who, trial, draws);
            break;
    }
    return answer;
}

std::vector<AnsweredTrial> answers_of(const SimulatedParticipant& participant,
                                      const Protocol& protocol, int number) {
    StudyRun run(protocol, number);
    while (run.step() != StudyStep::finished) {
        if (run.step() == StudyStep::question || run.step() == StudyStep::adjust)
            run.accept(run.judged(answer_of(participant, run), 0.0));
        else
            run.go_on();
    }
    return run.answered();
}

}  // namespace dibhr
