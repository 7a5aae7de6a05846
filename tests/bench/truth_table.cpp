// Prints how near depth comes to the truth (truth.hpp): truth [--cleaning raw,gentle,auto]
// [--scenes A,B] [--sensors A,B] [--columns N] [--frames N] [--seed N] [--json FILE]
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

#include "core/files/json.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "tests/bench/sensors.hpp"
#include "tests/bench/truth.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::bench;

struct TableOptions {
    std::vector<std::string> cleanings{"raw", "gentle", "auto"};
    std::vector<std::string> scenes{};
    std::vector<std::string> sensors{};
    int columns{640};
    int rows{480};
    int frames{40};
    std::uint32_t seed{1};
};

void print_head() {
    std::printf("%-8s %-8s %-8s %9s %10s %8s %11s %7s %10s\n", "scene", "sensor", "cleaning",
                "error px", "normal deg", "edge px", "lag frames", "bump %", "flicker px");
}

void print_number(int width, int digits, double value) {
    if (std::isnan(value))
        std::printf(" %*s", width, "-");
    else
        std::printf(" %*.*f", width, digits, value);
}

void print_row(const std::string& scene, const std::string& sensor, const std::string& cleaning,
               const Cleaned& cleaned) {
    const Nearness& near = cleaned.nearness;
    std::printf("%-8s %-8s %-8s", scene.c_str(), sensor.c_str(), cleaning.c_str());
    print_number(9, 3, near.elevation_px);
    print_number(10, 2, near.normal_deg);
    print_number(8, 2, near.edge_px);
    print_number(11, 3, near.lag_frames);
    print_number(7, 1, 100.0 * near.bump_kept);
    print_number(10, 3, near.flicker_px);
    std::printf("  %s\n", cleaned.words.c_str());
    std::fflush(stdout);
}

Json json_of(const std::string& scene, const std::string& sensor, const std::string& cleaning,
             const Cleaned& cleaned) {
    const Nearness& near = cleaned.nearness;
    return {{"scene", scene},
            {"sensor", sensor},
            {"cleaning", cleaning},
            {"done", cleaned.words},
            {"elevation_px", near.elevation_px},
            {"normal_deg", near.normal_deg},
            {"edge_px", near.edge_px},
            {"lag_frames", near.lag_frames},
            {"bump_kept", near.bump_kept},
            {"flicker_px", near.flicker_px}};
}

Json measure(const TableOptions& options) {
    Json json = Json::array();
    for (const std::string& scene : options.scenes) {
        const TrueFrames truth(known_scene(scene, options.columns, options.rows), options.frames);
        for (const std::string& name : options.sensors) {
            const std::vector<DepthImage> recorded = sensor(name).see(truth, options.seed);
            for (const std::string& cleaning : options.cleanings) {
                const Cleaned cleaned =
                    cleaned_against(truth, recorded, named<CleaningPreset>(cleaning).value());
                print_row(scene, name, cleaning, cleaned);
                json.push_back(json_of(scene, name, cleaning, cleaned));
            }
        }
    }
    return json;
}

/// What there is, and of it what is asked for: all.
template <typename Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
    std::vector<std::string> names;
    for (const Named& each : all) names.push_back(each.name);
    return names;
}

}  // namespace

int main(int count, char** words) {
    TableOptions options;
    std::string json_file;
    CLI::App app{"How near cleaned depth comes to the truth, in numbers."};
    app.add_option("--cleaning", options.cleanings, "Presets: raw, gentle, sensor, auto")
        ->delimiter(',')
        ->check(CLI::IsMember({"raw", "gentle", "sensor", "auto"}))
        ->capture_default_str();
    options.scenes = names_of(known_scenes(options.columns, options.rows));
    options.sensors = names_of(sensors());
    app.add_option("--scenes", options.scenes, "Surfaces")
        ->delimiter(',')
        ->check(CLI::IsMember(options.scenes))
        ->capture_default_str();
    app.add_option("--sensors", options.sensors, "What sees them")
        ->delimiter(',')
        ->check(CLI::IsMember(options.sensors))
        ->capture_default_str();
    app.add_option("--columns", options.columns, "Of the pictures, whose rows are 3/4 as many")
        ->check(CLI::Range(80, 4000))
        ->capture_default_str();
    app.add_option("--frames", options.frames, "Of each clip, 30 a second")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    app.add_option("--seed", options.seed, "Of the noise")->capture_default_str();
    app.add_option("--json", json_file, "Writes the numbers as JSON; - is standard output");
    CLI11_PARSE(app, count, words);
    options.rows = options.columns * 3 / 4;
    try {
        std::optional<OutputFile> out;
        if (!json_file.empty()) out.emplace(json_file);
        print_head();
        const Json json = measure(options);
        if (out) {
            out->write(json_text(json));
            out->commit();
        }
        return 0;
    } catch (const std::exception& error) {
        print_error_line(error.what());
        return 1;
    }
}
