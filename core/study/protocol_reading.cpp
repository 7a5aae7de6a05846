// Reads study.toml.
#include <algorithm>
#include <limits>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/content_hash.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/spelling.hpp"
#include "core/files/text_file.hpp"
#include "core/haptics/parameters.hpp"
#include "core/study/protocol.hpp"
#include "core/study/protocol_validation.hpp"
#include "core/study/toml_page.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMostConditions = 1000;
constexpr double kLargestNumber = 1e9;

/// The range of a number by its name; nothing: there is none.
std::optional<std::pair<double, double>> range_of(const std::string& name,
                                                  const AllowedNames& names) {
    if (name == "finger") return std::pair(0.0, names.thickest_finger_mm);
    const TouchNumber* const number = touch_number(name == "friction" ? "static-friction" : name);
    if (number == nullptr) return std::nullopt;
    return std::pair(number->lowest, number->highest);
}

std::vector<std::string> number_names() {
    std::vector<std::string> all{"friction", "finger"};
    for (const TouchNumber& number : touch_numbers()) all.emplace_back(number.name);
    return all;
}

std::vector<std::string> switch_names() {
    std::vector<std::string> all = all_names(touch_switches());
    all.insert(all.end(), {"in-betweens", "stability"});
    return all;
}

/// Fills in a protocol from its page.
class ProtocolReading {
  public:
    ProtocolReading(PageTable& page, const AllowedNames& names, Protocol& protocol)
        : page_(page), names_(names), to_(protocol) {}

    void read() {
        to_.title = page_.required_name("title");
        to_.version = page_.integer("version", 1, 1).value_or(1);
        to_.seed = static_cast<std::uint64_t>(
            page_.integer("seed", 0, std::numeric_limits<int>::max()).value_or(1));
        to_.instructions = read_page(page_, "instructions");
        to_.thanks = read_page(page_, "thanks");
        read_media();
        if (auto base = page_.table("base", "[base]")) {
            base_ = read_values(*base);
            base->refuse_unknown_keys();
        }
        read_conditions();
        for (PageTable& block : page_.tables("block", "a block")) read_block(block);
        if (to_.blocks.empty())
            page_.refuse("block", "there is no block: add [[block]] with form and question");
        page_.refuse_unknown_keys();
    }

  private:
    fs::path beside(const std::string& name) const {
        return fs::absolute(page_.file()).parent_path() / name;
    }

    StudyPage read_page(PageTable& table, const std::string& key) const {
        StudyPage page{.text = table.text(key).value_or("")};
        if (const auto picture = table.text(key + "-picture")) {
            page.picture = beside(*picture);
            require_usable(names_.checks.picture, page.picture, table, key + "-picture");
        }
        return page;
    }

    void read_media() {
        to_.media.push_back({.name = kSampleMedia});
        for (PageTable& table : page_.tables("media", "[[media]]")) {
            StudyMedia media{.name = table.required_name("name"),
                             .colour = beside(table.required_text("colour"))};
            if (const auto depth = table.text("depth")) media.depth = beside(*depth);
            if (std::ranges::find(to_.media, media.name, &StudyMedia::name) != to_.media.end())
                table.refuse("name", "there are two media of that name");
            require_usable(names_.checks.media, media, table, "colour");
            to_.media.push_back(std::move(media));
            table.refuse_unknown_keys();
        }
    }

    void read_choice(PageTable& table, const std::string& key,
                     const std::vector<std::string>& words, TouchValues& values) const {
        if (const auto place = table.choice_index(key, words)) values.words[key] = words[*place];
    }

    TouchValues read_values(PageTable& table) const {
        TouchValues values;
        for (const std::string& name : number_names()) {
            const auto range = *range_of(name, names_);
            if (const auto number = table.number(name, range.first, range.second))
                values.numbers[name] = *number;
        }
        for (const TouchChoice& choice : touch_choices())
            read_choice(table, std::string(choice.name), choice.names(), values);
        read_choice(table, "cleaning", names_.cleanings, values);
        read_choice(table, "media", all_names(to_.media), values);
        if (names_.materials)
            read_choice(table, "material", *names_.materials, values);
        else if (const auto material = table.text("material"))
            values.words["material"] = *material;
        if (const auto bump = table.text("bump")) {
            values.words["bump"] = beside(*bump).string();
            require_usable(names_.checks.bump, beside(*bump), table, "bump");
        }
        for (const std::string& name : switch_names())
            if (table.node(name) != nullptr)
                values.words[name] = table.boolean(name, false) ? "on" : "off";
        require_friction(table, with_overrides(base_, values));
        return values;
    }

    static void require_friction(const PageTable& table, const TouchValues& values) {
        const auto fixed = values.numbers.find("static-friction");
        const auto moving = values.numbers.find("dynamic-friction");
        if (fixed == values.numbers.end() || moving == values.numbers.end()) return;
        if (moving->second > fixed->second)
            table.refuse("dynamic-friction", "dynamic-friction is above static-friction (" +
                                                 short_text(fixed->second) + ")");
    }

    void add_condition(const PageTable& table, Condition condition) {
        if (to_.condition_named(condition.name) != nullptr)
            table.refuse("name", "there are two conditions " + in_quotes(condition.name));
        condition.values = with_overrides(base_, condition.values);
        require_values(names_.checks, condition.values, table, "name",
                       "the condition " + in_quotes(condition.name));
        to_.conditions.push_back(std::move(condition));
        if (to_.conditions.size() > kMostConditions)
            table.refuse("factor", "there are more than " + std::to_string(kMostConditions) +
                                       " conditions: leave some out");
    }

    void read_conditions() {
        for (PageTable& table : page_.tables("condition", "a condition")) {
            Condition condition{.name = table.required_name("name"), .values = read_values(table)};
            table.refuse_unknown_keys();
            add_condition(table, std::move(condition));
        }
        read_factors();
        if (to_.conditions.empty())
            page_.refuse("condition",
                         "there is no condition: add [[condition]] with a name, or [[factor]]");
    }

    void read_factors() {
        std::vector<PageTable> factors = page_.tables("factor", "a factor");
        if (factors.empty()) return;
        std::vector<Condition> crossed{Condition{}};
        for (PageTable& factor : factors) {
            const std::string name = factor.required_name("name");
            if (std::find(to_.factors.begin(), to_.factors.end(), name) != to_.factors.end())
                factor.refuse("name", "there are two factors " + in_quotes(name));
            to_.factors.push_back(name);
            std::vector<Condition> longer;
            const std::vector<Condition> levels = read_levels(factor);
            for (const Condition& so_far : crossed)
                for (const Condition& level : levels) longer.push_back(joined(so_far, level, name));
            crossed = std::move(longer);
            if (crossed.size() > kMostConditions)
                factor.refuse("levels", "the factors cross to more than " +
                                            std::to_string(kMostConditions) + " conditions");
            factor.refuse_unknown_keys();
        }
        for (Condition& condition : crossed) add_condition(factors.front(), std::move(condition));
    }

    std::vector<Condition> read_levels(PageTable& factor) const {
        std::vector<Condition> levels;
        for (PageTable& table : factor.tables("levels", "a level")) {
            Condition level{.name = table.required_name("name"), .values = read_values(table)};
            if (std::ranges::find(levels, level.name, &Condition::name) != levels.end())
                table.refuse("name", "there are two levels " + in_quotes(level.name));
            levels.push_back(std::move(level));
            table.refuse_unknown_keys();
        }
        if (levels.size() < 2)
            factor.refuse("levels",
                          "a factor has two levels at least: levels = [{name = \"...\", "
                          "friction = 0.2}, {...}]");
        return levels;
    }

    static Condition joined(const Condition& a, const Condition& b, const std::string& factor) {
        Condition both = a;
        both.name += (a.name.empty() ? "" : "+") + b.name;
        both.values = with_overrides(a.values, b.values);
        both.levels[factor] = b.name;
        return both;
    }

    void read_block(PageTable& table) {
        Block block;
        block.name = table.name("name").value_or("block " + std::to_string(to_.blocks.size() + 1));
        block.practice = table.boolean("practice", false);
        block.feedback = table.boolean("feedback", block.practice);
        const auto form = table.choice_index("form", all_names(kTrialForms));
        if (!form)
            table.refuse("form",
                         "a block has no form: it is one of " + listed(all_names(kTrialForms)));
        block.form = static_cast<TrialForm>(*form);
        block.order = static_cast<TrialOrder>(
            table.choice_index("order", all_names(kTrialOrders)).value_or(0));
        block.view =
            static_cast<StudyView>(table.choice_index("view", all_names(kStudyViews)).value_or(0));
        block.instructions = read_page(table, "instructions");
        block.again = table.boolean("again", false);
        block.interval_s = table.number("interval-s", 0.0, 3600.0).value_or(0.0);
        block.answer_s = table.number("answer-s", 0.0, 3600.0).value_or(0.0);
        block.break_after = table.integer("break-after", 0, kMostTrials).value_or(0);
        block.question.text = table.required_text("question");
        require_keys_of_form(table, block.form);
        read_items(table, block);
        read_variation(table, block);
        read_question(table, block);
        block.repetitions = table.integer("repetitions", 1, kMostTrials).value_or(1);
        require_valid_block(table, block);
        if (!is_from_study_file()) require_useful_block(table, to_, base_, block, names_.checks);
        table.refuse_unknown_keys();
        to_.blocks.push_back(std::move(block));
    }

    std::size_t condition_at(const PageTable& table, const std::string& key,
                             const std::string& name) const {
        const std::vector<std::string> all = all_names(to_.conditions);
        const auto found = std::find(all.begin(), all.end(), name);
        if (found == all.end())
            table.refuse(key, "no condition is called " + in_quotes(name) + ": there are " +
                                  listed(all) + did_you_mean(name, all));
        return static_cast<std::size_t>(found - all.begin());
    }

    void read_items(PageTable& table, Block& block) const {
        const std::vector<std::string> chosen = table.texts("conditions");
        for (const std::string& name : chosen) {
            const std::size_t at = condition_at(table, "conditions", name);
            block.items.push_back({at, at});
        }
        read_pairs(table, block);
        if (!block.items.empty()) return;
        for (std::size_t k = 0; k < to_.conditions.size(); ++k) block.items.push_back({k, k});
    }

    void read_pairs(PageTable& table, Block& block) const {
        constexpr const char* kForm =
            "pairs is \"all\" or a list of two conditions each: "
            "[[\"a\", \"b\"], [\"a\", \"c\"]]";
        const toml::node* const node = table.node("pairs");
        if (node == nullptr) return;
        if (block.intervals() == 1)
            table.refuse("pairs", std::string("a trial of the form ") + name_of(block.form) +
                                      " has one condition: give conditions instead of pairs");
        if (!block.items.empty())
            table.refuse("pairs", "a block has pairs or conditions, not both");
        if (node->value<std::string>() == "all") {
            for (std::size_t a = 0; a < to_.conditions.size(); ++a)
                for (std::size_t b = a + 1; b < to_.conditions.size(); ++b)
                    block.items.push_back({a, b});
            if (block.items.empty()) table.refuse("pairs", "one condition alone makes no pair");
            return;
        }
        const toml::array* const list = node->as_array();
        if (list == nullptr || list->empty()) table.refuse("pairs", kForm);
        for (const toml::node& entry : *list) {
            const toml::array* const pair = entry.as_array();
            if (pair == nullptr || pair->size() != 2 || !(*pair)[0].is_string() ||
                !(*pair)[1].is_string())
                refuse_at(table.file(), entry, kForm);
            const StudyItem item{condition_at(table, "pairs", (*pair)[0].value_or(std::string())),
                                 condition_at(table, "pairs", (*pair)[1].value_or(std::string()))};
            const auto same = [&item](const StudyItem& other) {
                return other == item || other == StudyItem{item.comparison, item.reference};
            };
            if (!is_from_study_file() && std::any_of(block.items.begin(), block.items.end(), same))
                refuse_at(table.file(), entry,
                          "this pair is there already, in this order or the other: give "
                          "repetitions instead, the order of the intervals is balanced");
            block.items.push_back(item);
        }
    }

    void read_variation(PageTable& table, Block& block) const {
        Variation& vary = block.variation;
        const auto all = number_names();
        const auto parameter = table.choice_index("vary", all);
        vary.levels = table.numbers("levels", -kLargestNumber, kLargestNumber);
        auto stairs = table.table("staircase", "[block.staircase]");
        auto adjust = table.table("adjust", "[block.adjust]");
        const auto reference = table.number("reference", -kLargestNumber, kLargestNumber);
        if (!parameter) {
            for (const char* const key : {"levels", "staircase", "adjust", "reference"})
                if (table.raw().contains(key))
                    table.refuse(key, std::string(key) +
                                          " is of a parameter: name it, vary = "
                                          "\"friction\"");
            return;
        }
        vary.parameter = all[*parameter];
        vary.reference = reference.value_or(0.0);
        const auto range = *range_of(vary.parameter, names_);
        if (vary.reference < range.first || vary.reference > range.second)
            table.refuse("reference", "reference is not a number from " + short_text(range.first) +
                                          " to " + short_text(range.second) + ", as " +
                                          vary.parameter + " is");
        if (stairs) read_staircase(*stairs, vary);
        if (adjust) {
            vary.lowest = adjust->number("lowest", range.first, range.second).value_or(range.first);
            vary.highest =
                adjust->number("highest", range.first, range.second).value_or(range.second);
            if (!(vary.lowest < vary.highest))
                adjust->refuse("highest", "highest is not above lowest");
            adjust->refuse_unknown_keys();
        }
        const double lowest = range.first - vary.reference;
        const double highest = range.second - vary.reference;
        for (const double level : vary.levels)
            require_level(table, "levels", level, lowest, highest);
        if (vary.staircase) {
            require_level(*stairs, "lowest", vary.staircase->low, lowest, highest);
            require_level(*stairs, "highest", vary.staircase->high, lowest, highest);
        }
    }

    static void require_level(const PageTable& table, const std::string& key, double level,
                              double lowest, double highest) {
        if (level < lowest - 1e-9 || level > highest + 1e-9)
            table.refuse(key, "the level " + short_text(level) +
                                  " beyond the reference is out of range: it is from " +
                                  short_text(lowest) + " to " + short_text(highest));
    }

    void read_staircase(PageTable& table, Variation& vary) const {
        StaircaseRule rule;
        const auto needed = [&](const char* key) {
            const auto number = table.number_above(key, 0.0, kLargestNumber);
            if (!number)
                table.refuse(
                    key, std::string("a staircase has no ") + key + ": add " + key + " = NUMBER");
            return *number;
        };
        rule.start = needed("start");
        rule.high = needed("highest");
        const auto step = table.number_above("step", 0.0, kLargestNumber);
        const auto factor = table.number_above("factor", 1.0, 100.0);
        if (step.has_value() == factor.has_value())
            table.refuse("step",
                         "a staircase has step = NUMBER (added) or factor = NUMBER "
                         "(multiplied), one of them");
        read_lowest(table, step, rule);
        rule.factors = factor.has_value();
        rule.step_down = step ? *step : *factor - 1.0;
        rule.step_up = rule.step_down * table.number("up-weight", 0.01, 100.0).value_or(1.0);
        rule.down_after = table.integer("down-after", 1, 10).value_or(2);
        rule.first_reversals = table.integer("halve-after", 0, 100).value_or(0);
        rule.first_steps = 2.0;
        rule.stop_reversals = table.integer("reversals", 0, 1000).value_or(0);
        rule.most_trials = table.integer("trials", 1, 1000).value_or(60);
        vary.tracks = table.integer("tracks", 1, 10).value_or(1);
        table.refuse_unknown_keys();
        vary.staircase = rule;
    }

    /// No level may be 0, where no answer is right or wrong: a track would stay there, or follow
    /// meaningless answers. A lowest level of 0 counts as not given.
    void read_lowest(PageTable& table, const std::optional<double>& step,
                     StaircaseRule& rule) const {
        const double smallest = step ? *step : 0.01 * rule.start;
        const char* const otherwise = step ? "one step" : "a hundredth of start";
        const auto given = table.number("lowest", 0.0, kLargestNumber);
        if (is_from_study_file()) {
            rule.low = std::min(given.value_or(0.0) > 0.0 ? *given : smallest, rule.high);
            return;
        }
        const std::optional<double> lowest = given == 0.0 ? std::nullopt : given;
        rule.low = lowest.value_or(smallest);
        const std::string low_text = "lowest (" + short_text(rule.low) +
                                     (lowest ? ")" : std::string(", ") + otherwise + ")");
        if (!(rule.low < rule.high)) table.refuse("highest", "highest is not above " + low_text);
        if (!(rule.low <= rule.start && rule.start <= rule.high))
            table.refuse("start", "start is not between " + low_text + " and highest (" +
                                      short_text(rule.high) + ")");
    }

    void read_question(PageTable& table, Block& block) const {
        Question& question = block.question;
        question.answers = table.texts("answers");
        const bool takes_answers = block.form == TrialForm::explore;
        if (takes_answers && question.answers.empty()) question.answers = {"yes", "no"};
        if (takes_answers && (question.answers.size() < 2 || question.answers.size() > 9))
            table.refuse("answers", "there are 2 to 9 answers");
        if (!takes_answers && !question.answers.empty())
            table.refuse("answers",
                         std::string("the form ") + name_of(block.form) +
                             " has its own answers: leave them out, or take the form explore");
        auto scale = table.table("scale", "[block.scale]");
        if (scale && block.form != TrialForm::rating)
            table.refuse("scale", "only the form rating has a scale");
        if (!scale) return;
        question.lowest = scale->integer("lowest", 0, 1000).value_or(1);
        question.highest = scale->integer("highest", 0, 1000).value_or(7);
        if (question.highest <= question.lowest)
            scale->refuse("highest", "highest is not above lowest");
        question.lowest_label = scale->name("lowest-label").value_or("");
        question.highest_label = scale->name("highest-label").value_or("");
        scale->refuse_unknown_keys();
    }

    /// Whether the page is from a study file: AllowedNames::materials.
    bool is_from_study_file() const noexcept { return !names_.materials; }

    PageTable& page_;
    const AllowedNames& names_;
    Protocol& to_;
    TouchValues base_{};
};

}  // namespace

Protocol read_protocol(const fs::path& file, const AllowedNames& names) {
    const auto text = small_text_in(file);
    std::error_code failed;
    if (fs::is_directory(file, failed))
        throw InputError(one_line(file.string()) + " is a folder: name the study's page in it");
    if (!text)
        throw InputError("cannot read the protocol " + one_line(file.string()) +
                         ": name a text file that can be read, of a megabyte at most");
    return protocol_of(*text, file, names);
}

Protocol protocol_of(const std::string& text, const fs::path& file, const AllowedNames& names) {
    const toml::table table = page_of(text, file);
    Protocol protocol;
    protocol.text = text;
    protocol.sha256 = sha256_of({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    PageTable page(table, file, "a study");
    ProtocolReading(page, names, protocol).read();
    return protocol;
}

}  // namespace dibhr
