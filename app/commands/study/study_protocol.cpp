// Prints the summary of a study.
#include "app/commands/study/study_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <string>

#include "core/files/plain_text.hpp"
#include "core/psychophysics/staircase.hpp"
#include "core/report/report_sentences.hpp"
#include "core/study/study_run.hpp"

namespace dibhr {

namespace {

/// Upper bound; with usual times where the block sets none.
double minutes_of(const Block& block) {
    constexpr double kInterval_s = 6.0;
    constexpr double kAnswer_s = 3.0;
    const double interval_s = block.interval_s > 0.0 ? block.interval_s : kInterval_s;
    return block.most_trials() * (block.intervals() * interval_s + kAnswer_s) / 60.0;
}

std::string levels_text(const Variation& vary) {
    if (!vary.any()) return {};
    std::string text = "; varies " + vary.parameter + " around " + number_text(vary.reference);
    if (!vary.levels.empty()) text += ", " + counted(static_cast<int>(vary.levels.size()), "level");
    if (vary.staircase)
        text += ", staircase 1-up/" + std::to_string(vary.staircase->down_after) + "-down from " +
                number_text(vary.staircase->start) + ", within " +
                number_text(vary.staircase->low) + " to " + number_text(vary.staircase->high) +
                ", that ends near " + short_text(100.0 * convergence_share(*vary.staircase), 3) +
                " % right";
    return text;
}

/// The number of participants (or a multiple) that completes a Latin square.
std::string balance_text(const Block& block) {
    if (block.order != TrialOrder::latin) return {};
    const std::size_t levels = std::max<std::size_t>(1, block.variation.levels.size());
    const int rows = williams_rows(static_cast<int>(block.items.size() * levels));
    return ", balanced over every " + counted(rows, "participant");
}

void print_summary(const Protocol& protocol) {
    std::cout << protocol.title << '\n'
              << counted(static_cast<int>(protocol.conditions.size()), "condition") << '\n';
    for (const Condition& condition : protocol.conditions)
        std::cout << "  " << condition.name << ": " << in_words(condition.values) << '\n';
    std::cout << counted(static_cast<int>(protocol.blocks.size()), "block") << '\n';
    double minutes = 0.0;
    bool adapts = false;
    for (const Block& block : protocol.blocks) {
        minutes += minutes_of(block);
        adapts = adapts || block.variation.staircase;
        std::cout << "  " << block.name << ": " << name_of(block.form) << ", "
                  << (block.variation.staircase ? "at most " : "")
                  << counted(block.most_trials(), "trial") << ", order " << name_of(block.order)
                  << balance_text(block) << (block.practice ? ", practice" : "")
                  << levels_text(block.variation) << '\n';
    }
    std::cout << (adapts ? "at most " : "") << counted(protocol.most_trials(), "trial")
              << ", about " << counted(static_cast<int>(std::ceil(minutes)), "minute")
              << " a participant\n";
}

/// Equal conditions may be intended, to measure choices by chance.
void print_same_conditions(const Protocol& protocol) {
    const auto& all = protocol.conditions;
    for (auto one = all.begin(); one != all.end(); ++one) {
        const auto before = std::ranges::find(all.begin(), one, one->values, &Condition::values);
        if (before != one)
            std::cout << before->name << " and " << one->name
                      << " have the same values: nobody can tell them apart\n";
    }
}

/// Blocks of yes and no without level 0, which would measure the guess rate.
void print_unknown_guess_rate(const Block& block) {
    const Variation& vary = block.variation;
    const bool has_nothing = std::ranges::find(vary.levels, 0.0) != vary.levels.end();
    if (block.form != TrialForm::explore || !vary.any() || has_nothing) return;
    std::cout << block.name
              << ": without a level 0 nobody knows how often people say yes when there is no "
                 "difference; the guess rate is then taken as 0\n";
}

}  // namespace

void print_protocol(const Protocol& protocol) {
    print_summary(protocol);
    print_same_conditions(protocol);
    for (const Block& block : protocol.blocks) print_unknown_guess_rate(block);
    if (std::ranges::all_of(protocol.blocks, &Block::practice))
        std::cout << "all of it is practice: no answer will count\n";
}

}  // namespace dibhr
