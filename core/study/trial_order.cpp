// Which trial comes next, a pure function of protocol, participant and answers; and whether an
// answer is right.
#include <algorithm>
#include <cstddef>
#include <numeric>

#include "core/files/plain_text.hpp"
#include "core/psychophysics/random.hpp"
#include "core/psychophysics/staircase.hpp"
#include "core/study/study_run.hpp"

namespace dibhr {

namespace {

/// What is drawn at random, each from its own random numbers.
enum class Draw : std::uint64_t { order, target, odd_ones, track, start };

/// Random numbers for use number `time` of one `thing` in a participant's block.
Random draws_of(const Protocol& protocol, int number, int block, Draw what, int thing = 0,
                int time = 0) {
    const auto plain = [](int one) { return static_cast<std::uint64_t>(one); };
    return draws_for(protocol.seed, {plain(number), plain(block), static_cast<std::uint64_t>(what),
                                     plain(thing), plain(time)});
}

const Block& block_at(const Protocol& protocol, int block) {
    return protocol.blocks[static_cast<std::size_t>(block)];
}

int levels_of(const Block& block) {
    return std::max(1, static_cast<int>(block.variation.levels.size()));
}

/// One of `kinds` for use number `n`. Every `chunk` has each kind equally often, in random order;
/// if `chunk` is no multiple of `kinds`, `turn` selects the kinds that come once more.
int balanced_kind(int kinds, int n, int chunk, int turn, Random draws) {
    std::vector<int> all(static_cast<std::size_t>(chunk));
    for (int k = 0; k < chunk; ++k) all[static_cast<std::size_t>(k)] = (k + turn) % kinds;
    draws.shuffle(std::span<int>(all));
    return all[static_cast<std::size_t>(n % chunk)];
}

/// The plan of a trial; with constant stimuli a cell of the order.
struct TrialPlan {
    int item{0};
    int repetition{0};  ///< how often that task came before
    int track{-1};
    int chunk{1};  ///< of repetitions in which its kinds are balanced
    int cell{0};   ///< of item and level, or item and track
    std::optional<double> level{};
};

TrialPlan constant_trial(const Protocol& protocol, int block_number, int number, int position) {
    const Block& block = block_at(protocol, block_number);
    const std::vector<int> order = order_of(protocol, block_number, number);
    const auto here = order.begin() + position;
    const int levels = levels_of(block);
    TrialPlan plan{.item = *here / levels, .chunk = block.repetitions, .cell = *here};
    plan.repetition = static_cast<int>(std::count(order.begin(), here, *here));
    if (!block.variation.levels.empty())
        plan.level = block.variation.levels[static_cast<std::size_t>(*here % levels)];
    return plan;
}

/// Removes rounding errors of steps (0.1 + 0.2 is not 0.3): equal levels are equal numbers.
double without_rounding_error(const StaircaseRule& rule, double level) {
    constexpr int kDigits = 12;
    const double clean = number_of_text(short_text(level, kDigits)).value_or(level);
    return std::clamp(clean, rule.low, rule.high);
}

/// A trial of a track with the fewest trials, drawn at random; nothing: all have ended.
std::optional<TrialPlan> adaptive_trial(const Protocol& protocol, int block_number, int number,
                                        std::span<const AnsweredTrial> in_block) {
    const Block& block = block_at(protocol, block_number);
    const int tracks = block.variation.tracks;
    std::vector<Staircase> runs(block.items.size() * static_cast<std::size_t>(tracks),
                                Staircase(*block.variation.staircase));
    for (const AnsweredTrial& one : in_block) {
        const int cell = one.trial.item * tracks + one.trial.track;
        runs[static_cast<std::size_t>(cell)].answer(one.right.value_or(false));
    }
    std::vector<int> behind;
    std::size_t fewest = ~std::size_t{0};
    for (std::size_t k = 0; k < runs.size(); ++k) {
        const std::size_t trials = runs[k].trials().size();
        if (runs[k].finished() || trials > fewest) continue;
        if (trials < fewest) behind.clear();
        fewest = trials;
        behind.push_back(static_cast<int>(k));
    }
    if (behind.empty()) return std::nullopt;
    Random draws =
        draws_of(protocol, number, block_number, Draw::track, static_cast<int>(in_block.size()));
    const auto drawn = block.order == TrialOrder::listed
                           ? 0U
                           : draws.below(static_cast<std::uint32_t>(behind.size()));
    const int cell = behind[drawn];
    constexpr int kChunk = 12;  // a multiple of two and of three intervals, too long to predict
    return TrialPlan{.item = cell / tracks,
                     .repetition = static_cast<int>(fewest),
                     .track = cell % tracks,
                     .chunk = kChunk,
                     .cell = cell,
                     .level = without_rounding_error(*block.variation.staircase,
                                                     runs[static_cast<std::size_t>(cell)].level())};
}

StudyInterval interval_of(const Protocol& protocol, const Block& block, std::size_t condition,
                          std::optional<double> value) {
    const Condition& one = protocol.conditions[condition];
    StudyInterval interval{.condition = one.name, .values = one.values, .value = value};
    if (value) interval.values = interval_values(one, block.variation, *value);
    return interval;
}

/// The intervals, and which of them is the target.
void fill_intervals(const Protocol& protocol, int number, const TrialPlan& plan, Trial& trial) {
    const Block& block = block_at(protocol, trial.block);
    const StudyItem& item = block.items[static_cast<std::size_t>(plan.item)];
    const Variation& vary = block.variation;
    const auto reference = vary.any() ? std::optional(vary.reference) : std::nullopt;
    std::optional<double> value = reference;
    if (plan.level) value = vary.reference + *plan.level;
    if (trial.form == TrialForm::adjust) {
        Random draws = draws_of(protocol, number, trial.block, Draw::start, trial.position);
        value = vary.lowest + (vary.highest - vary.lowest) * draws.uniform();
    }
    const StudyInterval plain = interval_of(protocol, block, item.reference, reference);
    const StudyInterval compared = interval_of(protocol, block, item.comparison, value);
    const auto kind = [&](int kinds, Draw what) {
        return balanced_kind(
            kinds, plan.repetition, plan.chunk, number + plan.cell,
            draws_of(protocol, number, trial.block, what, plan.cell, plan.repetition / plan.chunk));
    };
    trial.intervals.assign(static_cast<std::size_t>(block.intervals()), plain);
    if (block.intervals() == 1) {
        trial.intervals[0] = compared;
        return;
    }
    const bool turned = trial.form == TrialForm::adjust;
    trial.target = turned ? 1 : kind(block.intervals(), Draw::target);
    trial.intervals[static_cast<std::size_t>(trial.target)] = compared;
    // Where the surfaces differ without a level, either may be the odd one.
    const bool either = trial.form == TrialForm::three_interval && !plan.level;
    if (either && kind(2, Draw::odd_ones) == 1)
        for (StudyInterval& one : trial.intervals) one = one == plain ? compared : plain;
}

}  // namespace

int williams_rows(int count) noexcept {
    return count % 2 == 0 ? std::max(count, 1) : 2 * count;
}

std::vector<int> williams_row(int count, int row) {
    std::vector<int> items;
    const int turn = row % williams_rows(count);
    for (int k = 0; k < count; ++k) {
        const int zigzag = k % 2 == 1 ? (k + 1) / 2 : count - k / 2;  // 0, 1, n - 1, 2, n - 2 ...
        items.push_back((zigzag + turn) % count);
    }
    // Of an odd count the rows of the second half are those of the first backwards.
    if (count % 2 == 1 && turn >= count) std::reverse(items.begin(), items.end());
    return items;
}

std::vector<int> order_of(const Protocol& protocol, int block_number, int number) {
    const Block& block = block_at(protocol, block_number);
    const int cells = static_cast<int>(block.items.size()) * levels_of(block);
    std::vector<int> order;
    for (int repetition = 0; repetition < block.repetitions; ++repetition) {
        std::vector<int> once(static_cast<std::size_t>(cells));
        std::iota(once.begin(), once.end(), 0);
        if (block.order == TrialOrder::latin) once = williams_row(cells, number - 1 + repetition);
        order.insert(order.end(), once.begin(), once.end());
    }
    if (block.order == TrialOrder::random)
        draws_of(protocol, number, block_number, Draw::order).shuffle(std::span<int>(order));
    return order;
}

std::optional<Trial> next_trial(const Protocol& protocol, int number,
                                std::span<const AnsweredTrial> answered) {
    int block_number = answered.empty() ? 0 : answered.back().trial.block;
    for (; block_number < static_cast<int>(protocol.blocks.size()); ++block_number) {
        const Block& block = block_at(protocol, block_number);
        const auto first = std::ranges::find(
            answered, block_number, [](const AnsweredTrial& one) { return one.trial.block; });
        const auto in_block = answered.subspan(static_cast<std::size_t>(first - answered.begin()));
        const int position = static_cast<int>(in_block.size());
        std::optional<TrialPlan> plan;
        if (block.variation.staircase)
            plan = adaptive_trial(protocol, block_number, number, in_block);
        else if (position < block.most_trials())
            plan = constant_trial(protocol, block_number, number, position);
        if (!plan) continue;
        Trial trial{.number = static_cast<int>(answered.size()),
                    .block = block_number,
                    .position = position,
                    .practice = block.practice,
                    .form = block.form,
                    .item = plan->item,
                    .repetition = plan->repetition,
                    .track = plan->track,
                    .level = plan->level};
        fill_intervals(protocol, number, *plan, trial);
        return trial;
    }
    return std::nullopt;
}

std::optional<bool> is_right(const Trial& trial, const StudyAnswer& answer) {
    switch (trial.form) {
        case TrialForm::explore:
            if (!trial.level) return std::nullopt;
            if (answer.choice < 0) return false;
            return (answer.choice == 0) == (*trial.level > 0.0);
        case TrialForm::two_interval:
            if (!trial.level || *trial.level == 0.0) return std::nullopt;
            if (answer.choice < 0) return false;
            return (answer.choice == trial.target) == (*trial.level > 0.0);
        case TrialForm::three_interval:
            if (trial.level && *trial.level == 0.0) return std::nullopt;
            return answer.choice == trial.target;
        case TrialForm::adjust:
        case TrialForm::rating:
            break;
    }
    return std::nullopt;
}

std::string chosen_condition(const AnsweredTrial& answered) {
    const auto choice = static_cast<std::size_t>(answered.answer.choice);
    const auto& intervals = answered.trial.intervals;
    const bool of_intervals = answered.trial.form == TrialForm::two_interval ||
                              answered.trial.form == TrialForm::three_interval;
    if (!of_intervals || answered.answer.choice < 0 || choice >= intervals.size()) return {};
    return intervals[choice].condition;
}

}  // namespace dibhr
