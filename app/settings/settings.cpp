// Reads and writes the viewer's settings file, from one list of all settings.
#include "app/settings/settings.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "core/files/machine.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/text_file.hpp"
#include "core/haptics/parameters.hpp"
#include "core/video/sources/sidecar.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kVersion = 1;
constexpr std::string_view kKeys = "keys";
constexpr std::string_view kEstimators = "estimators";

// Each returns what is wrong with a value of the file; empty: valid, and stored.

template <typename T>
std::string take_exact(const toml::node& node, T& value, const char* problem) {
    const auto read = node.value_exact<T>();
    if (!read) return problem;
    value = *read;
    return {};
}

template <typename Enum>
std::string take_word(std::optional<Enum> named, Enum& value, const std::string& problem) {
    if (!named) return problem;
    value = *named;
    return {};
}

std::string take(const toml::node& node, const Setting&, bool& value) {
    return take_exact(node, value, "is not true or false");
}

std::string take(const toml::node& node, const Setting&, std::string& value) {
    return take_exact(node, value, "is not a text in quotes");
}

std::string take(const toml::node& node, const Setting&, NamePattern& value) {
    const auto read = node.value_exact<std::string>();
    if (!read) return "is not a text in quotes";
    std::string problem = problem_of({*read});
    if (problem.empty()) value.text = *read;
    return problem;
}

std::string take(const toml::node& node, const Setting& setting, double& value) {
    const auto read = node.is_number() ? node.value<double>() : std::nullopt;
    if (!read || !(*read >= setting.lowest && *read <= setting.highest)) {
        return "is not a number from " + short_text(setting.lowest) + " to " +
               short_text(setting.highest);
    }
    value = *read;
    return {};
}

std::string take(const toml::node& node, const Setting& setting, int& value) {
    double read = value;
    std::string problem = take(node, setting, read);
    value = static_cast<int>(std::lround(read));
    return problem;
}

template <HasNameTable Enum>
std::string take(const toml::node& node, const Setting&, Enum& value) {
    std::string problem = "is none of " + listed(all_names<Enum>());
    if (std::is_same_v<Enum, Algorithm>) problem = "is not the name of an algorithm";
    if (std::is_same_v<Enum, CleaningPreset>) problem = "is not the name of a way to clean";
    if (std::is_same_v<Enum, ReliefPaint>) problem = "is not what the relief can be painted with";
    const auto word = node.value<std::string_view>().value_or("");
    return take_word(named<Enum>(word), value, problem);
}

std::string take(const toml::node& node, const Setting&, ButtonAction& value) {
    const auto word = node.value<std::string_view>().value_or("");
    return take_word(button_action_named(word), value, "is not what a button can do");
}

std::string take_at(const toml::node& node, const Setting&, const DeviceEnum& word) {
    const std::vector<std::string> names(word.names.begin(), word.names.end());
    const auto found =
        std::find(names.begin(), names.end(), node.value<std::string>().value_or(""));
    if (found == names.end()) return "is none of " + listed(names);
    *word = static_cast<std::uint8_t>(found - names.begin());
    return {};
}

template <typename T>
std::string take_at(const toml::node& node, const Setting& setting, T* value) {
    return take(node, setting, *value);
}

/// "Space", ["F8", "Ctrl+R"], or "" for none; nothing: another kind of value.
std::optional<std::vector<std::string>> key_names(const toml::node& node) {
    std::vector<std::string> names;
    if (const auto* const one = node.as_string()) {
        if (!one->get().empty()) names.push_back(one->get());
        return names;
    }
    const toml::array* const list = node.as_array();
    if (list == nullptr) return std::nullopt;
    for (const toml::node& entry : *list) {
        if (!entry.is_string()) return std::nullopt;
        names.push_back(entry.as_string()->get());
    }
    return names;
}

/// A command, or a table with a command and facts of its depth. Returns what is wrong; empty:
/// valid, and stored.
std::string take(const toml::node& node, Estimator& estimator) {
    constexpr const char* kProblem = "is neither a command in quotes nor a table with one";
    if (const auto command = node.value_exact<std::string>()) {
        estimator.command = *command;
        return {};
    }
    const toml::table* const table = node.as_table();
    const auto command =
        table == nullptr ? std::nullopt : (*table)["command"].value_exact<std::string>();
    if (!command) return kProblem;
    toml::table rest = *table;
    rest.erase("command");
    std::ostringstream facts;
    facts << toml::table{{"depth", rest}};
    try {
        estimator.meaning = statement_in(facts.str(), "it");
    } catch (const InputError& error) {
        return std::string("is not understood: ") + error.what();
    }
    estimator.command = *command;
    return {};
}

/// The entries of a table in the order of the file.
std::vector<std::pair<std::string, const toml::node*>> in_order(const toml::table& table) {
    std::vector<std::pair<std::string, const toml::node*>> entries;
    for (const auto& [name, node] : table) entries.emplace_back(name.str(), &node);
    std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
        return a.second->source().begin < b.second->source().begin;
    });
    return entries;
}

/// Reads values from a parsed file. An invalid value keeps its default, with a warning that names
/// the line.
class SettingsReader {
  public:
    SettingsReader(const toml::table& root, const fs::path& file,
                   std::vector<std::string>& warnings)
        : root_(root), file_(file), warnings_(warnings) {}

    void take_keys(std::vector<OwnKeys>& keys) {
        const toml::table* const table = root_[kKeys].as_table();
        if (table == nullptr) return;
        const std::vector<const toml::node*> nodes = take_key_names(*table, keys);
        std::vector<std::string> complaints;
        const KeyTable checked(keys, &complaints);
        for (std::size_t k = 0; k < keys.size(); ++k)
            if (!complaints[k].empty())
                add_warning(*nodes[k], kKeys, keys[k].action, complaints[k]);
    }

    void take_estimators(std::vector<Estimator>& estimators) {
        const toml::table* const table = root_[kEstimators].as_table();
        if (table == nullptr) return;
        for (const auto& [name, node] : in_order(*table)) {
            Estimator estimator{.name = name};
            const std::string problem = is_bare_name(name)
                                            ? take(*node, estimator)
                                            : "is not a name of letters, digits, - and _";
            if (problem.empty())
                estimators.push_back(std::move(estimator));
            else
                add_warning(*node, kEstimators, name, problem);
        }
    }

    void take_all(const std::vector<Setting>& settings) {
        for (const Setting& setting : settings) {
            known_[setting.table].insert(setting.name);
            const toml::node* node = root_[setting.table][setting.name].node();
            if (node == nullptr) continue;
            const std::string problem = std::visit(
                [&](const auto& value) { return take_at(*node, setting, value); }, setting.value);
            if (!problem.empty()) warn(*node, setting.table, setting.name, problem);
        }
        tell_unknown();
    }

    void warn(const toml::node& node, std::string_view table, std::string_view name,
              const std::string& what) {
        add_warning(node, table, name, what + "; the default is kept");
    }

  private:
    void add_warning(const toml::node& node, std::string_view table, std::string_view name,
                     const std::string& what) {
        std::ostringstream text;
        text << file_.string() << ":" << node.source().begin.line << ": ";
        if (!table.empty()) text << table << ".";
        text << name << " " << what;
        warnings_.push_back(one_line(text.str()));  // a name may hold anything
    }

    /// Reads the keys in the file's order, as the first of two entries counts. Returns their nodes.
    std::vector<const toml::node*> take_key_names(const toml::table& table,
                                                  std::vector<OwnKeys>& keys) {
        std::vector<const toml::node*> taken;
        for (const auto& [name, node] : in_order(table)) {
            auto names = key_names(*node);
            if (!is_bare_name(name)) {
                add_warning(*node, kKeys, name, "is not an action: dibhr help keys lists them");
            } else if (!names) {
                warn(*node, kKeys, name, "is neither a key in quotes nor a list of them");
            } else {
                keys.push_back({name, std::move(*names)});
                taken.push_back(node);
            }
        }
        return taken;
    }

    void tell_unknown() {
        for (const auto& [table, node] : root_) {
            const bool has_names = table == kKeys || table == kEstimators;  // chosen by the user
            if (table == "version" || (has_names && node.is_table())) continue;
            const auto known = known_.find(table.str());
            if (!node.is_table() || known == known_.end()) {
                warn(node, "", table.str(), "is not a setting");
                continue;
            }
            for (const auto& [name, value] : *node.as_table()) {
                if (known->second.contains(name.str())) continue;
                warn(value, table.str(), name.str(), "is not a setting");
            }
        }
    }

    const toml::table& root_;
    const fs::path& file_;
    std::vector<std::string>& warnings_;
    std::map<std::string_view, std::set<std::string_view>> known_{};
};

// Values as TOML; numbers as short as possible without loss.

std::string toml_text(bool value) {
    return value ? "true" : "false";
}

std::string toml_text(int value) {
    return std::to_string(value);
}

std::string toml_text(double value) {
    return number_text(value);
}

std::string toml_text(const std::string& value) {
    std::ostringstream quoted;
    quoted << toml::value<std::string>(value);
    return quoted.str();
}

std::string toml_text(const NamePattern& value) {
    return toml_text(value.text);
}

/// A word.
template <typename Enum>
std::string toml_text(Enum value) {
    return '"' + std::string(name_of(value)) + '"';
}

std::string toml_text_at(const DeviceEnum& word) {
    return '"' + std::string(word.names[*word]) + '"';
}

template <typename T>
std::string toml_text_at(const T* value) {
    return toml_text(*value);
}

/// "" for none, one key as it is, more as a list.
std::string toml_text(const OwnKeys& own) {
    std::vector<std::string> quoted;
    for (const std::string& key : own.keys) quoted.push_back(toml_text(key));
    const bool is_list = quoted.size() > 1 || (quoted.size() == 1 && own.keys.front().empty());
    const std::string keys = quoted.empty() ? "\"\"" : listed(quoted);
    return own.action + " = " + (is_list ? "[" + keys + "]" : keys) + "\n";
}

/// The file without its head; a heading before each table.
std::string toml_text(Settings settings) {
    std::string text;
    std::string_view table;
    for (const Setting& setting : all_settings(settings)) {
        if (setting.table != table) text += "\n[" + std::string(setting.table) + "]\n";
        table = setting.table;
        text += std::string(setting.name) + " = " + text_of(setting) + "\n";
    }
    if (!settings.keys.empty()) text += "\n[keys]\n";
    for (const OwnKeys& own : settings.keys) text += toml_text(own);
    if (!settings.estimators.empty()) text += "\n[estimators]\n";
    for (const Estimator& estimator : settings.estimators) text += toml_of(estimator);
    return text;
}

toml::table parsed(const fs::path& file) {
    const auto content = small_text_in(file);
    if (!content)
        throw InputError("cannot read the settings file " + file.string() +
                         ": make it readable or delete it");
    try {
        return toml::parse(*content);
    } catch (const toml::parse_error& error) {
        std::ostringstream text;
        text << "cannot understand the settings file " << file.string() << " at line "
             << error.source().begin.line << " (" << error.description()
             << "): correct or delete it";
        throw InputError(one_line(text.str()));  // it quotes the file
    }
}

}  // namespace

fs::path settings_path() {
    return program_folder("XDG_CONFIG_HOME", ".config") / "settings.toml";
}

fs::path depth_choices_path() {
    return settings_path().parent_path() / "depth";
}

fs::path prepared_cache_path() {
    return program_folder("XDG_CACHE_HOME", ".cache") / "prepared";
}

DepthRequest usual_depth_request() {
    return {
        .find_out = true, .kept_in = depth_choices_path(), .prepared_in = prepared_cache_path()};
}

Settings load_settings(const fs::path& file, std::vector<std::string>& warnings) {
    std::error_code failed;
    if (fs::status(file, failed).type() == fs::file_type::not_found) return {};
    const toml::table root = parsed(file);
    Settings settings;
    SettingsReader reading(root, file, warnings);
    if (const toml::node* version = root.get("version")) {
        if (version->value_exact<std::int64_t>() != kVersion) {
            reading.warn(*version, "", "version", "is not 1, the one this program writes");
        }
    }
    reading.take_all(all_settings(settings));
    reading.take_keys(settings.keys);
    reading.take_estimators(settings.estimators);
    keep_in_range(settings.touch);
    return settings;
}

Settings load_settings(const fs::path& file) {
    std::vector<std::string> warnings;
    Settings settings = load_settings(file, warnings);
    for (const std::string& warning : warnings) print_error_line(warning);
    return settings;
}

void save_settings(const Settings& settings, const fs::path& file) {
    std::error_code failed;
    const fs::path folder = file.parent_path();
    make_folders(folder, failed);
    if (failed) {
        throw InputError("the settings are not kept: the folder " + folder.string() +
                         " cannot be written (" + failed.message() + "); make it writable");
    }
    try {
        write_file(file,
                   "# dibhr writes this file; change it while it is not running.\nversion = " +
                       std::to_string(kVersion) + "\n" + toml_text(settings));
    } catch (const InputError& error) {
        throw InputError(std::string("the settings are not kept: ") + error.what());
    }
}

std::vector<Setting> all_settings(Settings& s) {
    std::vector<Setting> list{{"window", "width", &s.width, kSmallestWindow, kLargestWindow},
                              {"window", "height", &s.height, kSmallestWindow, kLargestWindow},
                              {"window", "ui-scale", &s.ui_scale, 0.0, kLargestUi},
                              {"window", "theme", &s.theme},
                              {"window", "panels-visible", &s.panels_visible},
                              {"window", "screenshot-name", &s.screenshot_name},
                              {"window", "open-dialog", &s.open_with},
                              {"panels", "video", &s.panels.video},
                              {"panels", "surface", &s.panels.surface},
                              {"panels", "touch", &s.panels.touch},
                              {"panels", "device", &s.panels.device},
                              {"panels", "session", &s.panels.session},
                              {"panels", "loop", &s.panels.loop},
                              {"panels", "paint", &s.panels.paint}};
    for (const TouchChoice& choice : touch_choices()) {
        std::visit(
            [&](auto* word) {
                list.push_back({"touch", choice.name, word});
            },
            choice.in(s.touch));
    }
    for (const TouchSwitch& entry : touch_switches())
        list.push_back({"touch", entry.name, &entry.in(s.touch)});
    list.insert(list.end(),
                {{"touch", "material", &s.material},
                 {"touch", "outlines", &s.outlines},
                 {.table = "touch",
                  .name = "stability",
                  .value = &s.stability,
                  .protection = Protection{WeakerWhen::other, "Stability control"}},
                 {.table = "touch",
                  .name = "damping-as-needed",
                  .value = &s.damping_as_needed,
                  .protection = Protection{WeakerWhen::other, "Damping as the hand needs"}},
                 {"touch", "fit-relief", &s.fit_relief},
                 {"touch", "fit-pixel-pitch", &s.fit_pitch}});
    for (const TouchNumber& number : touch_numbers()) {
        list.push_back({"touch", number.name, &number.in(s.touch), number.lowest, number.highest});
    }
    list.push_back({"device", "max-force", &s.max_force_newton, 0.0,
                    DeviceLimits{}.max_force_newton,
                    Protection{WeakerWhen::higher, "Max force [N]"}});
    list.insert(list.end(), {{"sound", "volume", &s.sound_volume, 0.0, 1.0},
                             {"sound", "mute", &s.mute},
                             {"sound", "speak", &s.speak},
                             {"sound", "game-pad", &s.game_pad}});
    // In this table for compatibility: the Falcon was once the only force device.
    list.push_back(
        {.table = "falcon",
         .name = "force-in-front-only",
         .value = &s.force_in_front_only,
         .protection = Protection{WeakerWhen::other, "Force only while the window is in front"}});
    const auto kinds = force_device_kinds();
    for (std::size_t k = 0; k < s.devices.size(); ++k) {
        for (const DeviceRow& row : s.devices[k].rows()) {
            std::visit(
                [&](const auto& value) {
                    list.push_back(
                        {kinds[k]->name, row.name, value, row.lowest, row.highest, row.protection});
                },
                row.value);
        }
    }
    list.insert(list.end(), {{"cleaning", "preset", &s.cleaning.preset},
                             {"cleaning", "finger", &s.finger_mm, 0.0, kThickestFinger_mm},
                             {"cleaning", "in-betweens", &s.in_betweens}});
    visit_steps(s.cleaning.own, [&list](std::string_view name, bool& step) {
        list.push_back({"cleaning", name, &step});
    });
    list.insert(list.end(),
                {{"look", "discard-silhouettes", &s.relief_style.discard_silhouettes},
                 {"look", "silhouette-slope", &s.relief_style.silhouette_slope, 1.0, 100.0},
                 {"look", "paint", &s.relief_style.paint},
                 {"look", "light", &s.relief_style.light, 0.0, 1.0},
                 {"look", "coarse", &s.relief_style.coarse},
                 {"look", "dent", &s.relief_style.dent},
                 {"look", "trace", &s.relief_style.trace},
                 {"look", "straight-view", &s.straight_view},
                 {"look", "panes", &s.panes},
                 {"look", "others", &s.others},
                 {"playing", "resume", &s.resume},
                 {"charts", "force", &s.charts.force},
                 {"charts", "penetration", &s.charts.penetration},
                 {"charts", "speed", &s.charts.speed},
                 {"charts", "energy", &s.charts.energy},
                 {"charts", "lateness", &s.charts.lateness}});
    return list;
}

bool same(const Setting& a, const Setting& b) {
    return std::visit(
        [&]<typename Place>(const Place& value) { return *value == *std::get<Place>(b.value); },
        a.value);
}

void assign(const Setting& to, const Setting& from) {
    std::visit([&]<typename Place>(const Place& value) { *value = *std::get<Place>(from.value); },
               to.value);
}

std::string text_of(const Setting& setting) {
    return std::visit([](const auto& value) { return toml_text_at(value); }, setting.value);
}

Settings merge_changes(Settings in_file, Settings started, Settings now) {
    const std::vector<Setting> kept = all_settings(in_file);
    const std::vector<Setting> before = all_settings(started);
    const std::vector<Setting> after = all_settings(now);
    for (std::size_t k = 0; k < kept.size(); ++k) {
        if (!same(before[k], after[k])) assign(kept[k], after[k]);
    }
    return in_file;
}

bool same_settings(Settings a, Settings b) {
    const std::vector<Setting> first = all_settings(a);
    const std::vector<Setting> second = all_settings(b);
    return a.keys == b.keys && a.estimators == b.estimators &&
           std::equal(first.begin(), first.end(), second.begin(), same);
}

}  // namespace dibhr
