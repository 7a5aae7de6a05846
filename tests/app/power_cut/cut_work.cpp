// Says on standard output each time that something is kept for good.
#include "tests/app/power_cut/cut_work.hpp"

#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "app/settings/consent.hpp"
#include "app/settings/file_memory.hpp"
#include "app/settings/material.hpp"
#include "app/settings/recent_files.hpp"
#include "app/settings/settings.hpp"
#include "core/clip/clip_file.hpp"
#include "core/estimate/depth_estimate.hpp"
#include "core/haptics/touch_maps.hpp"
#include "core/report/session_report.hpp"
#include "core/session/recorder.hpp"
#include "core/session/session.hpp"
#include "core/study/study_file.hpp"
#include "core/video/sources/kept_choices.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/picture_files.hpp"
#include "core/video/sources/sidecar.hpp"
#include "core/video/sources/touch_map_files.hpp"
#include "tests/core/session/exploration.hpp"

namespace {

using namespace dibhr;
namespace fs = std::filesystem;

/// Not through a buffer, which may hold what the test has printed.
void kept() {
    constexpr std::string_view kLine = "kept\n";
    if (::write(STDOUT_FILENO, kLine.data(), kLine.size()) < 0) ::_exit(1);
}

void write_settings(const fs::path& folder) {
    Settings settings;
    settings.width = 1000;
    save_settings(settings, folder / "dibhr" / "settings.toml");
    kept();
}

void write_history(const fs::path& folder) {
    add_recent_file({folder / "a.mp4", folder / "b.mp4"}, folder / "state" / "recent");
    keep_memory(folder / "state" / "files", folder / "a.mp4", {.relief_px = 50.0, .at_s = 3.0});
    keep_choice(folder / "state" / "depth", folder / "a.mp4", {.near = NearLevels::dark});
    Consent(folder / "state" / "agreed").agree("estimator --of {colour}");
    kept();
}

void write_sidecar_and_maps(const fs::path& folder) {
    write_sidecar(folder / "depth.png", {.near = NearLevels::dark});
    TouchMaps maps;
    TouchMap& stiffness = maps.of(TouchMapKind::stiffness);
    stiffness = bare_map(TouchMapKind::stiffness, 64, 48);
    for (TouchMap::Pixel& pixel : stiffness.pixels) pixel = {7, 65535};
    write_touch_maps(maps, folder / "depth.png");
    kept();
}

void write_material(const fs::path&) {  // of XDG_CONFIG_HOME
    Material material;
    material.name = "mine";
    save_material(material);
    kept();
}

void write_pictures(const fs::path& folder) {
    const ColourImage picture{32, 24, std::vector<std::uint8_t>(std::size_t{32} * 24 * 3, 90)};
    write_png(picture, folder / "one.png");
    if (!fs::exists(folder / "two.png")) write_new_png(picture, folder / "two.png");
    ClipFile clip(folder / "clip.mp4", ClipNameConflict::replaces);
    for (int k = 0; k < 5; ++k) clip.add(picture, 0.1 * k);
    clip.finish(0.5, ClipEnd::indexed);
    kept();
}

void write_session(const fs::path& folder) {
    test::MovingSurface surface;
    test::Exploration hand(surface);
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(folder / "mine.dibhr", *ring, {});
    kept();
    recorder.parameters(hand.parameters);
    for (int k = 0; k < test::kCutTicks; ++k) ring->push(hand.next());
    if (recorder.finish().failure.empty()) kept();
}

/// In real time, so that its log is flushed and grows on.
void record(const fs::path& folder) {
    test::MovingSurface surface;
    test::Exploration hand(surface);
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(folder / "mine.dibhr", *ring, {});
    kept();
    recorder.parameters(hand.parameters);
    auto due = std::chrono::steady_clock::now();
    for (int k = 0; k < test::kCutTicks; ++k) {
        ring->push(hand.next());
        std::this_thread::sleep_until(due += std::chrono::milliseconds(1));
    }
    if (recorder.finish().failure.empty()) kept();
}

void write_study(const fs::path& folder) {
    StudyFile study(study_file_of(folder, "P07"), test::cut_identity());
    kept();
    for (int number = 0; number < test::kCutTrials; ++number) {
        study.add(test::cut_trial(number));
        kept();
    }
    study.finish();
    kept();
}

void write_report(const fs::path& folder) {
    const auto no_picture = [](const SessionSource&, double) { return RecordedPicture{}; };
    write_session_report(Session(folder / "mine.dibhr"),
                         {.folder = folder / "made", .program = "dibhr", .pictures = no_picture});
    kept();
}

void make_depth(const fs::path& folder) {
    EstimateWatch watch;
    if (estimate_depth(test::cut_request(folder), watch)) kept();
}

}  // namespace

namespace dibhr::test {

const std::map<std::string, std::function<void(const fs::path&)>>& cut_work() {
    static const std::map<std::string, std::function<void(const fs::path&)>> all{
        {"settings", write_settings},
        {"history", write_history},
        {"maps", write_sidecar_and_maps},
        {"material", write_material},
        {"pictures", write_pictures},
        {"session", write_session},
        {"recording", record},
        {"report", write_report},
        {"study", write_study},
        {"cache", make_depth}};
    return all;
}

}  // namespace dibhr::test
