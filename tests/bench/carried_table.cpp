// Prints how a finger is carried by motion that was found in pictures (carried.hpp): carried
// [--speeds A,B] [--rates A,B] [--seconds S] [--noise LEVELS] [--depth-noise PX] [--raw]
// [--true-motion]
// [--without]
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <utility>
#include <vector>

#include "tests/bench/carried.hpp"

namespace {

using dibhr::bench::CarriedFinger;
using dibhr::bench::Filming;
using dibhr::test::MovingScene;

struct TableOptions {
    std::vector<double> speeds_px{0.0, 25.0, 100.0, 200.0, 400.0};
    std::vector<double> rates{15.0, 30.0, 60.0};
    Filming filming{};
};

void print_table(const TableOptions& options) {
    using Shape = MovingScene::Shape;
    using Goes = MovingScene::Goes;
    std::printf("%-7s %-6s %5s %4s | %8s %8s %3s | %8s %8s\n", "thing", "goes", "px/s", "1/s",
                "astray", "worst", "of", "turned", "drag");
    for (const auto& [shape, name] :
         {std::pair{Shape::plane, "plane"}, {Shape::sphere, "sphere"}, {Shape::hand, "hand"}})
        for (const auto& [goes, word] : {std::pair{Goes::along, "along"},
                                         {Goes::round, "round"},
                                         {Goes::apart, "apart"},
                                         {Goes::swelling, "swell"}})
            for (const double speed : options.speeds_px)
                for (const double rate : options.rates) {
                    if (goes != Goes::along && !(speed > 0.0)) continue;
                    Filming filming = options.filming;
                    filming.frames_per_s = rate;
                    const CarriedFinger felt =
                        carried_finger(MovingScene({shape, goes, speed, 640, 480}), filming);
                    std::printf("%-7s %-6s %5.0f %4.0f | %8.2f %8.2f %3d | %8.2f %8.3f\n", name,
                                word, speed, rate, felt.astray_px, felt.worst_astray_px,
                                felt.fingers, felt.turned_deg, felt.drag_share);
                    std::fflush(stdout);
                }
}

}  // namespace

int main(int argc, char** argv) {
    TableOptions options;
    CLI::App app("How a finger is carried by motion that was found in pictures");
    app.add_option("--speeds", options.speeds_px)->delimiter(',');
    app.add_option("--rates", options.rates)->delimiter(',');
    app.add_option("--seconds", options.filming.seconds, "How long fingers are carried");
    app.add_option("--noise", options.filming.brightness_levels, "Of the colour, of 255");
    app.add_option("--depth-noise", options.filming.elevation_px, "Of the depth, of 255");
    app.add_flag("!--raw", options.filming.coded, "Colour as it is, not coded");
    app.add_flag("!--true-motion", options.filming.found, "As it is, not as it is found");
    app.add_flag("!--without", options.filming.carry, "Fingers that nothing carries");
    CLI11_PARSE(app, argc, argv);
    try {
        print_table(options);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "carried: %s\n", error.what());
        return 1;
    }
    return 0;
}
