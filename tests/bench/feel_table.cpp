// Prints how recordings feel (feel.hpp): feel [--cleaning raw,gentle,auto] [--fitted] [--spots N]
// [--json FILE] PLACE... A place is what `dibhr view` takes, in one word; of two files the depth
// alone is as good. Or, as Markdown, how scenes of our own making do (feel_scenes.hpp): feel
// --scenes [detail,outlines,discs] [--cleaning raw,gentle,auto]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/files/json.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "tests/bench/feel.hpp"
#include "tests/bench/feel_scenes.hpp"

namespace {

using namespace dibhr;
using namespace dibhr::bench;

double seconds(std::size_t milliseconds) {
    return 1e-3 * static_cast<double>(milliseconds);
}

/// The end of a place's name, which distinguishes it from others.
std::string short_name(const std::filesystem::path& place) {
    const std::filesystem::path file = place.has_filename() ? place : place.parent_path();
    return (file.parent_path().filename() / file.filename()).string();
}

void print_head() {
    std::printf("%-43s %-13s %9s %9s %9s %7s %8s %8s %8s |", "recording", "way", "buzz N",
                "p99 N/ms", "p99.9", "stuck", "contact", "no holes", "of s");
    for (const Cause cause : kCauses) std::printf(" %12s", name_of(cause));
    std::printf("  [%% of the time lost to it; no holes: contact, holes aside]\n");
}

void print_way(const std::string& name, const char* way, bool slides, const FeelNumbers& feel) {
    std::printf("%-43s %-13s %9.4f %9.4f %9.4f", name.c_str(), way, feel.buzz_newton, feel.step_p99,
                feel.step_p999);
    if (slides)
        std::printf(" %6.1f%%", 100.0 * feel.stuck);
    else
        std::printf(" %7s", "");
    std::printf(" %7.2f%%", 100.0 * feel.contact);
    if (slides)
        std::printf(" %8s", "");
    else
        std::printf(" %7.2f%%", 100.0 * contact_beside_holes(feel));
    std::printf(" %8.1f |", feel.seconds);
    for (const Cause cause : kCauses)
        if (!slides && feel.seconds > 0.0)
            std::printf(" %12.2f", 100.0 * seconds(feel.lost[cause]) / feel.seconds);
    std::printf("\n");
    std::fflush(stdout);
}

void print_feel(const std::string& name, const Feel& feel) {
    for (const Way way : kWays) print_way(name, name_of(way), way == Way::slide, feel[way]);
    print_way(name, "slide-smooth", true, feel.slide_smooth);
    print_way(name, "slide-cliffs", true, feel.slide_cliffs);
}

void print_blemishes(const Blemishes& found) {
    std::printf(
        "  teeth %.1f per 100,000 px, pimples %.2f (there again %.2f) per 1000 px of flat ground, "
        "%.0f%% of the picture\n",
        found.teeth, found.pimples, found.pimples_again, 100.0 * found.flat);
}

Json json_of(bool slides, const FeelNumbers& feel) {
    Json json{{"seconds", feel.seconds},
              {"buzz_newton", feel.buzz_newton},
              {"step_p99_newton_per_ms", feel.step_p99},
              {"step_p999_newton_per_ms", feel.step_p999},
              {"contact", feel.contact}};
    if (slides) {
        json["stuck"] = feel.stuck;
        return json;
    }
    json["contact_beside_holes"] = contact_beside_holes(feel);
    for (const Cause cause : kCauses) json["lost_ms"][name_of(cause)] = feel.lost[cause];
    return json;
}

Json json_of(const std::string& place, const Feel& feel) {
    Json json{{"recording", place}, {"cleaning", feel.cleaning}, {"columns", feel.columns},
              {"rows", feel.rows},  {"frames", feel.frames},     {"seconds", feel.seconds}};
    for (const Way way : kWays) json[name_of(way)] = json_of(way == Way::slide, feel[way]);
    json["slide-smooth"] = json_of(true, feel.slide_smooth);
    json["slide-cliffs"] = json_of(true, feel.slide_cliffs);
    json["blemishes"] = {{"teeth_per_100000_px", feel.blemishes.teeth},
                         {"pimples_per_1000_px", feel.blemishes.pimples},
                         {"pimples_again_per_1000_px", feel.blemishes.pimples_again},
                         {"flat_share", feel.blemishes.flat}};
    return json;
}

/// False when the place cannot be read; prints the error.
bool measure(const std::string& place, const std::string& cleaning, FeelOptions options,
             Json& json) {
    options.cleaning.preset = named<CleaningPreset>(cleaning).value();
    try {
        const Feel feel = feel_of(open_media(place, {}, {.find_out = true}), options);
        print_feel(short_name(place) + " " + cleaning, feel);
        print_blemishes(feel.blemishes);
        std::printf("  %s\n", feel.cleaning.c_str());
        json.push_back(json_of(place, feel));
        return true;
    } catch (const std::exception& error) {
        print_error_line(place + ": " + error.what());
        return false;
    }
}

}  // namespace

int main(int count, char** words) {
    std::vector<std::string> places;
    FeelOptions options;
    std::vector<std::string> scenes;
    std::vector<std::string> ways{"auto"};
    std::string json_file;
    CLI::App app{"How recordings feel, in numbers."};
    CLI::Option* const given_places =
        app.add_option("PLACE", places, "Recordings, each as `dibhr view` takes it");
    const std::vector<std::string> all_scenes = feel_scenes();
    CLI::Option* const given_scenes =
        app.add_option("--scenes", scenes,
                       "Scenes of our own making, as Markdown: detail, "
                       "outlines, discs; without a name all of them")
            ->delimiter(',')
            ->expected(0, -1)
            ->check(CLI::IsMember(all_scenes))
            ->excludes(given_places);
    CLI::Option* const given_cleaning =
        app.add_option(
               "--cleaning", ways,
               "Presets, one after the other: raw, gentle, sensor, auto; what levels mean is "
               "found out in each; of scenes all but sensor")
            ->delimiter(',')
            ->check(CLI::IsMember({"raw", "gentle", "sensor", "auto"}))
            ->capture_default_str();
    app.add_flag("--fitted", options.fitted, "Relief and pitch as the viewer fits them");
    app.add_option("--spots", options.spots, "Fingers of each way to touch")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    app.add_option("--seed", options.seed, "Of the places")->capture_default_str();
    app.add_option("--json", json_file, "Writes the numbers as JSON; - is standard output");
    CLI11_PARSE(app, count, words);
    try {
        if (*given_scenes) {
            std::erase(scenes, "");  // CLI11's value where none is given
            if (!*given_cleaning) ways = {"raw", "gentle", "auto"};
            print_feel_scenes(scenes.empty() ? all_scenes : scenes, ways);
            return 0;
        }
        if (places.empty()) throw InputError("no recording is given; name one, or give --scenes");
        std::optional<OutputFile> out;
        if (!json_file.empty()) out.emplace(json_file);
        Json json = Json::array();
        bool all = true;
        print_head();
        for (const std::string& place : places)
            for (const std::string& way : ways) all = measure(place, way, options, json) && all;
        if (out) {
            out->write(json_text(json));
            out->commit();
        }
        return all ? 0 : 1;
    } catch (const std::exception& error) {
        print_error_line(error.what());
        return 1;
    }
}
