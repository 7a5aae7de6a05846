// The table of touch parameters: each entry is written and read unchanged wherever parameters are.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/settings/command_options.hpp"
#include "app/settings/settings.hpp"
#include "app/settings/study_values.hpp"
#include "core/files/json.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/parameters.hpp"
#include "core/session/recorder.hpp"
#include "core/session/session.hpp"
#include "core/study/protocol.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// The default parameters with one entry changed, and that value as text.
struct Changed {
    TouchParameters parameters{};
    std::string option{};  ///< on the command line
    std::string toml{};    ///< in settings and on a study's page
    Json json{};           ///< in a report
};

Changed changed(const TouchChoice& choice) {
    const std::vector<std::string> names = choice.names();
    const auto other = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
        return name != choice.standard();
    });
    REQUIRE(other != names.end());
    Changed all{.option = *other, .toml = '"' + *other + '"', .json = *other};
    REQUIRE(choice.choose(*other, all.parameters));
    return all;
}

Changed changed(const TouchSwitch& entry) {
    const bool on = !entry.standard();
    Changed all{.option = on ? "on" : "off", .toml = on ? "true" : "false", .json = on};
    entry.in(all.parameters) = on;
    return all;
}

Changed changed(const TouchNumber& number) {
    const bool is_lowest = !(number.standard() > number.lowest);
    const double value = 0.5 * (number.lowest + (is_lowest ? number.highest : number.standard()));
    Changed all{.option = number_text(value), .toml = number_text(value), .json = value};
    number.in(all.parameters) = value;
    keep_in_range(all.parameters);
    return all;
}

TouchParameters on_command_line(const std::string& name, const Changed& change) {
    CLI::App app;
    TouchRequest request;
    add_touch_options(app, request);
    app.parse("--" + name + " " + change.option);
    TouchParameters parameters;
    request.given.apply(parameters);
    return parameters;
}

/// Written by the program, and written by hand.
void check_settings(const TemporaryFolder& folder, const std::string& name, const Changed& change) {
    const auto file = folder / "settings.toml";
    Settings settings;
    settings.touch = change.parameters;
    save_settings(settings, file);
    CHECK(load_settings(file).touch == change.parameters);
    write_text(file, "[touch]\n" + name + " = " + change.toml + "\n");
    CHECK(load_settings(file).touch == change.parameters);
}

TouchParameters in_study(const std::string& name, const Changed& change) {
    const std::string page = "title = \"T\"\n[[condition]]\nname = \"c\"\n" + name + " = " +
                             change.toml + "\n[[block]]\nform = \"explore\"\nquestion = \"Q\"\n";
    const Protocol protocol = protocol_of(page, "study.toml", {});
    TouchParameters parameters;
    request_of(protocol.conditions.at(0).values).given.apply(parameters);
    return parameters;
}

/// A session with some ticks of each of them, as versions 1, 2 and so on.
void record_all(const std::filesystem::path& file, const std::vector<Changed>& all) {
    constexpr std::int64_t kTicksOfEach = 10;
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(file, *ring, {});
    std::int64_t number = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
        recorder.parameters({.version = k + 1, .touch = all[k].parameters});
        for (std::int64_t n = 0; n < kTicksOfEach; ++n, ++number) {
            TickRecord tick;
            tick.tick = number;
            tick.t_s = 0.001 * static_cast<double>(number);
            tick.dt_s = 0.001;
            tick.settings = k + 1;
            tick.surface = false;
            REQUIRE(ring->push(tick));
        }
    }
    REQUIRE(recorder.finish().failure.empty());
}

}  // namespace

TEST_CASE("every parameter is an option, a setting and a value of a study's condition",
          "[parameters]") {
    const TemporaryFolder folder;
    std::vector<std::string> helps;
    for (const std::string command : {"touch", "view", "replay"})
        helps.push_back(run_dibhr(folder, {command, "--help"}).output);
    visit_touch_entries([&](const auto& entry) {
        const std::string name(entry.name);
        CAPTURE(name);
        const Changed change = changed(entry);
        CHECK_FALSE(change.parameters == TouchParameters{});
        CHECK(on_command_line(name, change) == change.parameters);
        check_settings(folder, name, change);
        CHECK(in_study(name, change) == change.parameters);
        for (const std::string& help : helps) CHECK(contains(help, "--" + name + " "));
    });
}

TEST_CASE("every parameter is kept in a session and told in its report", "[parameters]") {
    const TemporaryFolder folder;
    std::vector<Changed> all;
    visit_touch_entries([&all](const auto& entry) { all.push_back(changed(entry)); });
    record_all(folder / "mine.dibhr", all);
    const Session session(folder / "mine.dibhr");
    REQUIRE(session.parameters().size() == all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
        CAPTURE(k);
        CHECK(session.parameters()[k].touch == all[k].parameters);
    }
    const ProgramResult result = run_dibhr(folder, {"report", "mine.dibhr", "--out", "report"});
    INFO(result.errors);
    REQUIRE(result.exit_code == 0);
    const Json told = parsed_json(read_text(folder / "report/report.json"))["parameters"];
    REQUIRE(told.size() == all.size());
    const std::string page = read_text(folder / "report/report.html");
    std::size_t k = 0;
    visit_touch_entries([&](const auto& entry) {
        CAPTURE(entry.name);
        CHECK(told.at(k).at(std::string(entry.column)) == all[k].json);
        std::string head(entry.label);
        head[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(head[0])));
        CHECK(contains(page, head));
        ++k;
    });
}
