// The checks of one block.
#include "core/study/protocol_validation.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

std::string form_text(TrialForm form) {
    return std::string("the form ") + name_of(form);
}

/// The numbers of a condition that a varied parameter replaces.
std::vector<std::string> overridden_names(const std::string& parameter) {
    if (parameter == "friction") return {"friction", "static-friction", "dynamic-friction"};
    return {parameter};
}

/// Refuses a condition's own number of the varied parameter, which would never be rendered.
void require_no_other_value(const PageTable& table, const Condition& condition,
                            const TouchValues& base, const Variation& vary) {
    const auto& numbers = condition.values.numbers;
    for (const std::string& name : overridden_names(vary.parameter)) {
        const auto own = numbers.find(name);
        if (own == numbers.end() || own->second == vary.reference) continue;
        const auto of_all = base.numbers.find(name);
        if (of_all != base.numbers.end() && of_all->second == own->second) continue;
        table.refuse("vary", vary.parameter + " is varied by the block, around " +
                                 short_text(vary.reference) + ": leave " + name + " (" +
                                 short_text(own->second) + ") out of the condition " +
                                 in_quotes(condition.name));
    }
}

/// Checks every value that an interval of the block can have.
void require_interval_values(PageTable& table, const Protocol& protocol, const Block& block,
                             const StudyChecks& checks) {
    const Variation& vary = block.variation;
    const auto require_at = [&](const PageTable& page, const std::string& key, double value,
                                std::size_t StudyItem::*side) {
        for (const StudyItem& item : block.items) {
            const Condition& condition = protocol.conditions[item.*side];
            require_values(checks, interval_values(condition, vary, value), page, key,
                           vary.parameter + " " + short_text(value) + " in the condition " +
                               in_quotes(condition.name));
        }
    };
    require_at(table, "reference", vary.reference, &StudyItem::reference);
    for (const double level : vary.levels)
        require_at(table, "levels", vary.reference + level, &StudyItem::comparison);
    if (const auto stairs = table.table("staircase", "[block.staircase]")) {
        const StaircaseRule& rule = *vary.staircase;
        require_at(*stairs, "lowest", vary.reference + rule.low, &StudyItem::comparison);
        require_at(*stairs, "start", vary.reference + rule.start, &StudyItem::comparison);
        require_at(*stairs, "highest", vary.reference + rule.high, &StudyItem::comparison);
    }
    if (const auto adjust = table.table("adjust", "[block.adjust]")) {
        require_at(*adjust, "lowest", vary.lowest, &StudyItem::comparison);
        require_at(*adjust, "highest", vary.highest, &StudyItem::comparison);
    }
}

void require_answerable_levels(const PageTable& table, const Block& block) {
    const Variation& vary = block.variation;
    if (block.form == TrialForm::explore && !vary.levels.empty() &&
        block.question.answers.size() != 2)
        table.refuse("answers", "levels have two answers, the first of which is yes");
    if (block.intervals() == 1) return;
    for (std::size_t k = 0; k < vary.levels.size(); ++k) {
        if (vary.reference + vary.levels[k] != vary.reference) continue;
        refuse_at(table.file(), *table.raw().get_as<toml::array>("levels")->get(k),
                  "at a level of 0 no interval is the right one: leave it out (only " +
                      form_text(TrialForm::explore) + ", yes or no, may have it)");
    }
}

/// Refuses explicit feedback where no answer is right; the default of practice may stay.
void require_right_answer(const PageTable& table, const Block& block) {
    const bool judged = block.form == TrialForm::three_interval ||
                        (block.variation.any() && block.form != TrialForm::adjust);
    if (!judged && table.raw()["feedback"].value_or(false))
        table.refuse(
            "feedback",
            "nothing is right or wrong here: leave feedback out, or give vary and levels to " +
                form_text(TrialForm::explore) + " or two-interval");
}

}  // namespace

void require_values(const StudyChecks& checks, const TouchValues& values, const PageTable& table,
                    const std::string& key, const std::string& of) {
    if (!checks.values) return;
    try {
        checks.values(values);
    } catch (const Error& error) {
        const std::string words = error.what();
        const std::string number = words.substr(0, words.find(' '));
        table.refuse(table.raw().contains(number) ? number : key, of + ": " + words);
    }
}

void require_keys_of_form(const PageTable& table, TrialForm form) {
    const bool adjusts = form == TrialForm::adjust;
    if (!adjusts && table.raw().contains("adjust"))
        table.refuse("adjust", "only the form adjust has [block.adjust]");
    if (!adjusts && form != TrialForm::rating) return;
    for (const char* const key : {"staircase", "levels"})
        if (table.raw().contains(key))
            table.refuse(key, form_text(form) + " has neither levels nor a staircase");
    if (!adjusts && table.raw().contains("vary"))
        table.refuse("vary", form_text(form) + " varies nothing: list conditions instead");
}

void require_valid_block(const PageTable& table, const Block& block) {
    const Variation& vary = block.variation;
    const bool adjusts = block.form == TrialForm::adjust;
    if (adjusts && (!vary.any() || !(vary.lowest < vary.highest)))
        table.refuse("adjust",
                     "the form adjust turns a parameter: add vary = \"friction\", "
                     "reference and [block.adjust]");
    if (vary.staircase && !vary.levels.empty())
        table.refuse("levels", "a block has levels or a staircase, not both");
    if (vary.any() && !adjusts && !vary.staircase && vary.levels.empty())
        table.refuse("vary", "vary needs levels = [...] or [block.staircase]");
    if (vary.staircase && table.raw().contains("repetitions"))
        table.refuse("repetitions",
                     "a staircase ends by itself: give it trials and reversals "
                     "instead of repetitions");
    if (vary.staircase && block.order == TrialOrder::latin)
        table.refuse("order", "staircases follow each other at random or as listed");
    if (block.form == TrialForm::explore && vary.staircase && block.question.answers.size() != 2)
        table.refuse("answers", "a staircase has two answers: yes and no");
    for (const StudyItem& item : block.items)
        if (block.intervals() > 1 && item.reference == item.comparison && !vary.any())
            table.refuse("form", form_text(block.form) +
                                     " compares two: give pairs = [[\"a\", \"b\"]], or vary");
    if (block.most_trials() > kMostTrials)
        table.refuse("repetitions",
                     "the block has more than " + std::to_string(kMostTrials) + " trials");
}

void require_useful_block(PageTable& table, const Protocol& protocol, const TouchValues& base,
                          const Block& block, const StudyChecks& checks) {
    if (std::ranges::find(protocol.blocks, block.name, &Block::name) != protocol.blocks.end())
        table.refuse("name", "there are two blocks " + in_quotes(block.name));
    require_right_answer(table, block);
    require_answerable_levels(table, block);
    const Variation& vary = block.variation;
    const std::size_t cells = block.items.size() * std::max<std::size_t>(1, vary.levels.size());
    if (block.order == TrialOrder::latin && cells < 2)
        table.refuse("order",
                     "order = \"latin\" balances two or more conditions, pairs or levels: here is "
                     "only one, leave order out");
    if (!vary.any()) return;
    const bool adjusts = block.form == TrialForm::adjust;
    if (adjusts && (vary.reference < vary.lowest || vary.reference > vary.highest))
        table.refuse("reference", "reference is not in the range of [block.adjust], from " +
                                      short_text(vary.lowest) + " to " + short_text(vary.highest) +
                                      ": nobody could turn it equal");
    for (const StudyItem& item : block.items)
        for (const std::size_t one : {item.reference, item.comparison})
            require_no_other_value(table, protocol.conditions[one], base, vary);
    require_interval_values(table, protocol, block, checks);
}

}  // namespace dibhr
