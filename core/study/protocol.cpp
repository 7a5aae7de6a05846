// Functions on the data of a protocol.
#include "core/study/protocol.hpp"

#include <algorithm>

#include "core/files/plain_text.hpp"
#include "core/haptics/parameters.hpp"

namespace dibhr {

static_assert(has_all_in_order(kTrialForms, TrialForm::rating));
static_assert(has_all_in_order(kTrialOrders, TrialOrder::listed));
static_assert(has_all_in_order(kStudyViews, StudyView::touch));

std::string in_words(const TouchValues& values) {
    std::vector<std::string> all;
    for (const auto& [name, word] : values.words) all.push_back(name + " " + word);
    for (const auto& [name, number] : values.numbers)
        all.push_back(name + " " + number_text(number));
    return all.empty() ? "the program's defaults" : listed(all);
}

TouchValues with_overrides(const TouchValues& base, const TouchValues& overrides) {
    TouchValues all = base;
    if (overrides.numbers.contains("friction")) {
        all.numbers.erase("static-friction");
        all.numbers.erase("dynamic-friction");
    }
    for (const auto& [name, number] : overrides.numbers) all.numbers[name] = number;
    for (const auto& [name, word] : overrides.words) all.words[name] = word;
    return all;
}

TouchValues interval_values(const Condition& condition, const Variation& vary, double value) {
    return with_overrides(condition.values, {.numbers = {{vary.parameter, value}}});
}

int Block::intervals() const noexcept {
    switch (form) {
        case TrialForm::explore:
        case TrialForm::rating:
            return 1;
        case TrialForm::two_interval:
        case TrialForm::adjust:
            return 2;
        case TrialForm::three_interval:
            return 3;
    }
    return 1;
}

int Block::most_trials() const noexcept {
    const int count = static_cast<int>(items.size());
    if (variation.staircase) return count * variation.tracks * variation.staircase->most_trials;
    const int levels = std::max(1, static_cast<int>(variation.levels.size()));
    return count * levels * repetitions;
}

int Protocol::most_trials() const noexcept {
    int count = 0;
    for (const Block& block : blocks) count += block.most_trials();
    return count;
}

const Condition* Protocol::condition_named(const std::string& name) const noexcept {
    for (const Condition& condition : conditions)
        if (condition.name == name) return &condition;
    return nullptr;
}

}  // namespace dibhr
