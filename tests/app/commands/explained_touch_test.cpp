// An explained update is the one that `dibhr touch` writes, to the last digit of its rows.
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <glm/common.hpp>
#include <map>
#include <string>
#include <vector>

#include "app/settings/assets_path.hpp"
#include "app/settings/command_options.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/explanation.hpp"
#include "core/video/playing/depth_timeline.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

constexpr int kColumns = 60;
constexpr int kRows = 44;
constexpr int kGoals = 300;

void write_pgm(const std::filesystem::path& file, const DepthImage& image) {
    std::ofstream out(file, std::ios::binary);
    out << "P5\n" << image.columns << ' ' << image.rows << "\n255\n";
    for (const float level : image.levels) out.put(static_cast<char>(std::lround(level)));
}

/// The first one in the air; then drags, above and below the surface, with a jump now and then.
std::vector<Vec3> goals_over(const DepthSurface& surface) {
    Dice dice(31);
    std::vector<Vec3> goals;
    goals.reserve(kGoals);
    const double high = surface.ceiling() + 5.0;
    Vec3 goal{0.5 * surface.columns(), 0.5 * surface.rows(), high};
    for (int k = 0; k < kGoals; ++k) {
        goals.push_back(goal);
        if (k % 20 == 19) {
            goal = {dice.uniform(-4.0, surface.columns() + 3.0),
                    dice.uniform(-4.0, surface.rows() + 3.0), dice.uniform(-20.0, high)};
        } else {
            goal += Vec3{dice.uniform(-3.0, 3.0), dice.uniform(-3.0, 3.0), dice.uniform(-9.0, 7.0)};
        }
    }
    return goals;
}

/// As the rows have it.
std::string printed(double value) {
    std::string text;
    append_number(text, value);
    return text;
}

/// One output row by the names of its columns.
using OutputLine = std::map<std::string, std::string>;

std::vector<OutputLine> output_of(const std::string& csv) {
    const std::vector<std::string> lines = split(csv, '\n');
    const std::vector<std::string> columns = split(lines.front(), ',');
    std::vector<OutputLine> rows;
    for (std::size_t n = 1; n + 1 < lines.size(); ++n) {
        const std::vector<std::string> values = split(lines[n], ',');
        REQUIRE(values.size() == columns.size());
        OutputLine& row = rows.emplace_back();
        for (std::size_t c = 0; c < columns.size(); ++c) row[columns[c]] = values[c];
    }
    return rows;
}

/// Runs the program with these options over goals on the first image of `depth`, and explains each
/// update from the end of the one before. Returns the number of steps.
std::size_t compare(const TemporaryFolder& folder, const std::filesystem::path& depth,
                    const TouchRequest& request, const Friction& friction,
                    std::vector<std::string> words) {
    TouchParameters parameters;
    auto media = open_depth(depth, request.depth_request());
    const MediaDescription description = media->description();
    request.given.fit(description, request.raw_depth, parameters);
    const DepthTimeline first(std::move(media), DepthTimeline::Wanted::first,
                              request.cleaning(parameters, description));
    const DepthSurface surface = first.now().surface(parameters.shape);

    const std::vector<Vec3> goals = goals_over(surface);
    std::string csv = "t,x,y,z\n";
    for (std::size_t k = 0; k < goals.size(); ++k) {
        csv += number_text(0.001 * static_cast<double>(k));
        for (const double value : {goals[k].x, goals[k].y, goals[k].z})
            csv.append(",").append(number_text(value));
        csv += '\n';
    }
    write_text(folder / "goals.csv", csv);
    words.insert(words.end(), {"--static-friction", number_text(friction.static_coefficient),
                               "--dynamic-friction", number_text(friction.dynamic_coefficient)});
    words.insert(words.begin(), {"touch", "--depth", depth.string(), "--goals", "goals.csv"});
    const ProgramResult result = run_dibhr(folder, words);
    REQUIRE(result.exit_code == 0);

    const std::vector<OutputLine> rows = output_of(result.output);
    REQUIRE(rows.size() == goals.size());
    Proxy proxy;
    proxy.position = goals.front();
    std::size_t steps = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) {
        OutputLine row = rows[k];
        CAPTURE(depth, k);
        const ExplainedUpdate explained = explain(surface, proxy, goals[k], friction);
        const Proxy& last =
            explained.steps.empty() ? explained.result : explained.steps.back().after;
        REQUIRE(row["px"] == printed(last.position.x));
        REQUIRE(row["py"] == printed(last.position.y));
        REQUIRE(row["pz"] == printed(last.position.z));
        REQUIRE(row["primitive"] == name_of(last.active.kind));
        REQUIRE(row["i"] == std::to_string(last.active.i));
        REQUIRE(row["j"] == std::to_string(last.active.j));
        REQUIRE(row["moves"] == std::to_string(last.moves));
        REQUIRE(row["contact"] == (last.contact ? "1" : "0"));
        std::size_t visits = 0;
        for (const WalkStep& step : explained.steps) visits += step.visits;
        REQUIRE(visits <= static_cast<std::size_t>(last.moves));
        steps += explained.steps.size();
        proxy = explained.result;
    }
    return steps;
}

}  // namespace

TEST_CASE("the steps that are explained end as the row of `dibhr touch` says, on hostile ground",
          "[touch]") {
    const TemporaryFolder folder;
    const Friction friction = GENERATE(Friction{0.0, 0.0}, Friction{0.5, 0.3});
    TouchRequest raw;
    raw.raw_depth = true;
    for (const NamedSurface& ground : hostile_surfaces(kColumns, kRows)) {
        CAPTURE(ground.name, friction.static_coefficient);
        write_pgm(folder / "ground.pgm", ground.image);
        CHECK(compare(folder, folder / "ground.pgm", raw, friction, {"--raw-depth"}) > kGoals);
    }
}

TEST_CASE("the steps that are explained end as the row of `dibhr touch` says, on the sample",
          "[touch]") {
    const TemporaryFolder folder;
    CHECK(compare(folder, sample_files().depth, {}, {0.5, 0.3}, {}) > kGoals);
}
