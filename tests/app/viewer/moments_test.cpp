// Colour and depth of one moment on the screen, also on a machine that is too slow: a number burnt
// into both, read from pictures of the real window.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <glm/vec4.hpp>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "core/haptics/vec.hpp"
#include "render/camera.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/app/program/desk.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

// The film: its upper half is raised where a bit of the number is set, and has a white mark on each
// bit; its lower half is flat, and white where a bit is set. The last two bits are 0 and 1.
constexpr int kColumns = 1280, kRows = 720;
constexpr int kBits = 10;
constexpr int kFrames = 120;
constexpr double kBit_px = kColumns / static_cast<double>(kBits);
constexpr double kMarkInBit_px = 80.0;  ///< its middle
constexpr double kMarkRow_px = 180.0;
constexpr double kColourRow_px = 600.0;

// Depth in millimetres.
constexpr double kNearest = 500.0, kFarthest = 4000.0;
constexpr double kRaised = 1840.0, kFlat = 3000.0;
constexpr double kRelief_px = 255.0 / 720.0 * kColumns;

constexpr int kDisplayColumns = 1280;
constexpr int kWindowColumns = 960, kWindowRows = 600;  ///< --size
constexpr std::size_t kPictures = 40;

double elevation_px(double depth_mm) {
    return kRelief_px * (kFarthest - depth_mm) / (kFarthest - kNearest);
}

const TemporaryFolder& numbered_films() {
    static const TemporaryFolder folder;
    static const bool made = [] {
        const std::string bit =
            "if(gte(floor(X/16)\\,8)\\,gt(floor(X/16)\\,8)\\,"
            "mod(floor(N/pow(2\\,floor(X/16)))\\,2))";
        const std::string mark = "between(mod(X\\,16)\\,9\\,10)*between(Y\\,21\\,23)";
        const std::string source =
            "ffmpeg -nostdin -v error -f lavfi -i \"color=black:s=160x90:r=60,";
        const std::string larger =
            ",scale=1280:720:flags=neighbor\" -frames:v " + std::to_string(kFrames) + " ";
        run_shell(folder, source + "format=gray,geq=lum='255*if(lt(Y\\,45)\\," + mark + "\\," +
                              bit + ")'" + larger +
                              "-c:v libx264 -preset ultrafast -crf 8 -pix_fmt yuv420p rgb.mp4");
        std::filesystem::create_directory(folder / "depth");
        run_shell(folder, source + "format=gray16le,geq=lum='if(lt(Y\\,45)*" + bit +
                              "\\,1840\\,3000)'" + larger + "-compression_level 1 depth/%03d.png");
        return true;
    }();
    static_cast<void>(made);
    return folder;
}

/// Lightness along a straight line of the screen, 0 to 255.
class Screen {
  public:
    explicit Screen(const Desk& desk) : rgb_(desk.picture()) {
        camera_.frame_relief(kColumns, kRows, kRelief_px);
    }

    [[nodiscard]] double lightness(double column, double row, double depth_mm) const {
        const glm::dvec4 clip =
            camera_.clip_from_grid(static_cast<double>(kWindowColumns) / kWindowRows) *
            glm::dvec4(column, row, elevation_px(depth_mm), 1.0);
        const int x = static_cast<int>(0.5 * (clip.x / clip.w + 1.0) * kWindowColumns);
        const int y = static_cast<int>(0.5 * (1.0 - clip.y / clip.w) * kWindowRows);
        const std::size_t first =
            3 * (static_cast<std::size_t>(y) * kDisplayColumns + static_cast<std::size_t>(x));
        return static_cast<unsigned char>(rgb_.at(first));
    }

    /// How far a bit is raised: 0, flat, to 1. Found by its mark, which is raised with it.
    [[nodiscard]] double raised(int bit) const {
        constexpr int kSteps = 60;
        double sum = 0.0;
        double weight = 0.0;
        for (int k = -kSteps / 2; k <= 3 * kSteps / 2; ++k) {
            const double part = static_cast<double>(k) / kSteps;
            const double light = lightness(kBit_px * bit + kMarkInBit_px, kMarkRow_px,
                                           kFlat + part * (kRaised - kFlat));
            if (light < 100.0) continue;
            sum += part * light;
            weight += light;
        }
        return weight > 0.0 ? sum / weight : std::nan("");
    }
    /// How white a bit is: 0, black, to 1.
    [[nodiscard]] double white(int bit) const {
        return lightness(kBit_px * (bit + 0.5), kColourRow_px, kFlat) / 255.0;
    }

  private:
    std::string rgb_;
    Camera camera_{};
};

/// The bits that a picture of the window shows, each from 0 to 1; NaN where a mark is not seen.
struct Bits {
    std::array<double, kBits> depth{}, colour{};

    explicit Bits(const Screen& screen) {
        for (int bit = 0; bit < kBits; ++bit) {
            depth[static_cast<std::size_t>(bit)] = screen.raised(bit);
            colour[static_cast<std::size_t>(bit)] = screen.white(bit);
        }
    }
    /// Whether every bit is nearer to one of two frames than to the middle between them.
    [[nodiscard]] bool is_plain() const {
        return std::all_of(depth.begin(), depth.end(),
                           [](double raised) { return std::abs(raised - 0.5) > 0.15; });
    }
};

/// The last two bits are no part of it.
int number_of(const std::array<double, kBits>& bits) {
    int number = 0;
    for (std::size_t bit = 0; bit + 2 < kBits; ++bit)
        if (bits[bit] > 0.5) number += 1 << bit;
    return number;
}

/// Waits until a picture follows another one whose frame is not the one before.
void wait_for_left_out_frames(const WindowProgram& viewer) {
    Seen before = viewer.seen();
    bool leaves_out = false;
    viewer.wait_until([&](const Seen& now) {
        leaves_out = leaves_out || (now.picture == before.picture + 1 &&
                                    now.drawn_frame > before.drawn_frame + 1);
        before = now;
        return leaves_out;
    });
}

}  // namespace

TEST_CASE("colour and relief on the screen are of one moment, also on a machine that is too slow",
          "[moments][long]") {
    const Desk desk;
    const TemporaryFolder home;
    const bool is_too_slow = GENERATE(false, true);
    CAPTURE(is_too_slow);
    std::filesystem::create_directories(home / "config/dibhr");
    write_text(home / "config/dibhr/settings.toml", "[window]\npanels-visible = false\n");
    std::vector<std::string> options{(numbered_films() / "rgb.mp4").string(), "--speed",
                                     is_too_slow ? "4" : "0.1"};
    for (const char* const option :
         {"--near",        "dark",     "--depth-unit", "mm",     "--depth-scale", "1",
          "--depth-range", "500:4000", "--no-data",    "0",      "--cleaning",    "raw",
          "--in-betweens", "off",      "--device",     "mouse",  "--loop",        "on",
          "--start",       "1",        "--pause",      "--size", "960x600"})
        options.emplace_back(option);
    WindowProgram viewer = desk.start_viewer(home, options);
    viewer.wait_for_surface();
    viewer.wait_for_turn();
    const Bits still(Screen{desk});
    CAPTURE(still.depth, still.colour);
    REQUIRE(still.is_plain());
    REQUIRE(number_of(still.depth) == viewer.seen().drawn_frame);
    REQUIRE(number_of(still.colour) == viewer.seen().drawn_frame);

    std::vector<std::unique_ptr<Process>> busy;
    for (unsigned k = 0; is_too_slow && k < std::thread::hardware_concurrency(); ++k)
        busy.push_back(std::make_unique<Process>(
            std::vector<std::string>{"/bin/sh", "-c", "while :; do :; done"},
            std::vector<std::string>{}, home / "busy.txt"));
    viewer.act("key space");
    if (is_too_slow) wait_for_left_out_frames(viewer);
    std::mt19937 random(41);
    std::set<int> shown;
    std::string mixed;
    for (std::size_t read = 0; read < kPictures;) {
        const auto next = viewer.seen().picture + std::uniform_int_distribution(1U, 6U)(random);
        viewer.wait_until([next](const Seen& now) { return now.picture >= next; });
        const Bits bits(Screen{desk});
        if (!bits.is_plain()) continue;
        ++read;
        const int depth = number_of(bits.depth);
        const int colour = number_of(bits.colour);
        shown.insert(depth);
        if (depth != colour)
            mixed += "depth of " + std::to_string(depth) + ", colour of " + std::to_string(colour) +
                     "\n";
    }
    INFO(mixed);
    CHECK(mixed.empty());
    CHECK(shown.size() > kPictures / 8);
    busy.clear();
    desk.press("key q");
    REQUIRE(viewer.wait() == 0);
}
