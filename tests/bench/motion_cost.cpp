// Prints what motion and in-betweens cost: motion_cost [--frames N] [--times N] [PLACE...]. A place
// is what `dibhr view` takes, in one word; hand, plane and still are synthetic, of 640x480.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/libraries.hpp"
#include "core/video/motion/in_betweens.hpp"
#include "core/video/motion/motion_estimator.hpp"
#include "core/video/playing/frame_reader.hpp"
#include "core/video/sources/media.hpp"
#include "tests/core/video/moving_scene.hpp"

namespace {

using namespace dibhr;
using test::MovingScene;

/// CPU time of the process, whose other threads wait.
double cpu_ms() {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Noisy enough that every cell has changed.
std::optional<std::vector<Frame>> made(const std::string& name, int count) {
    using Shape = MovingScene::Shape;
    const bool still = name == "still";
    if (name != "hand" && name != "plane" && !still) return std::nullopt;
    const Shape shape = name == "plane" ? Shape::plane : Shape::hand;
    const MovingScene scene({shape, MovingScene::Goes::along, still ? 0.0 : 300.0, 640, 480});
    return test::film(scene, count, 30.0, {.brightness = 3.0}, false);
}

std::vector<Frame> read(const std::string& place, int count) {
    FrameReader reader(open_media(place, {}, {.find_out = true}));
    std::vector<Frame> frames;
    std::optional<Frame> frame = reader.at(0.0);
    while (frame && static_cast<int>(frames.size()) < count) {
        const double media_s = frame->media_s;
        frames.push_back(std::move(*frame));
        frame = reader.after(media_s);
    }
    if (frames.size() < 2) throw InputError(place + " holds no two pictures");
    return frames;
}

/// Milliseconds of one thing after the other.
class Costs {
  public:
    void add(double ms) { ms_.push_back(ms); }
    [[nodiscard]] double at(double share) {
        if (ms_.empty()) return 0.0;
        std::sort(ms_.begin(), ms_.end());
        return ms_[static_cast<std::size_t>(share * static_cast<double>(ms_.size() - 1))];
    }

  private:
    std::vector<double> ms_{};
};

struct Cost {
    Costs motion{}, each_between{}, between{};
    std::size_t pairs{0}, moving{0}, betweens{0};
};

/// The least of `times` runs, so that other work of the machine does not count.
template <typename Run>
double least_ms(int times, const Run& run) {
    double least = 1e9;
    for (int k = 0; k < times; ++k) {
        const double begin_ms = cpu_ms();
        run();
        least = std::min(least, cpu_ms() - begin_ms);
    }
    return least;
}

Cost cost_of(std::vector<Frame> frames, int times) {
    Cost cost;
    std::vector<MotionEstimator> estimators(static_cast<std::size_t>(times));
    InBetweenMaker maker;
    for (std::size_t k = 0; k + 1 < frames.size(); ++k) {
        Frame& from = frames[k];
        std::size_t run = 0;
        // Each goes on from the pair before, as in a video.
        const double ms =
            least_ms(times, [&] { from.motion = estimators[run++].estimate(from, frames[k + 1]); });
        if (k > 0) cost.motion.add(ms);
        ++cost.pairs;
        if (!from.motion) continue;
        ++cost.moving;
        const double between_ms =
            least_ms(times, [&] { from.in_betweens = maker.make(from, frames[k + 1]); });
        if (!from.in_betweens) continue;
        cost.between.add(between_ms);
        cost.betweens += from.in_betweens->size();
        cost.each_between.add(between_ms / static_cast<double>(from.in_betweens->size()));
        // A player holds a few.
        if (k >= FrameWindow::kFrames) {
            frames[k - FrameWindow::kFrames].motion.reset();
            frames[k - FrameWindow::kFrames].in_betweens.reset();
        }
    }
    return cost;
}

void print_row(const std::string& place, Cost cost) {
    std::printf("%-32s %5zu %5.0f | %7.2f %7.2f | %5.1f %7.2f %7.2f | %7.2f %7.2f\n",
                place.substr(place.size() - std::min<std::size_t>(place.size(), 32)).c_str(),
                cost.pairs,
                100.0 * static_cast<double>(cost.moving) / static_cast<double>(cost.pairs),
                cost.motion.at(0.5), cost.motion.at(0.95),
                static_cast<double>(cost.betweens) / static_cast<double>(cost.pairs),
                cost.each_between.at(0.5), cost.each_between.at(0.95), cost.between.at(0.5),
                cost.between.at(0.95));
    std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
    std::vector<std::string> places{"still", "hand", "plane"};
    int frames = 24;
    int times = 3;
    CLI::App app{"What motion and in-betweens cost."};
    app.add_option("PLACE", places, "Recordings; still, hand and plane are made up")
        ->capture_default_str();
    app.add_option("--frames", frames, "Of each")->check(CLI::Range(3, 1000));
    app.add_option("--times", times, "The least of so many counts")->check(CLI::Range(1, 100));
    CLI11_PARSE(app, count, words);
    set_up_libraries();
    try {
        std::printf("%-32s %5s %5s | %7s %7s | %5s %7s %7s | %7s %7s [ms of CPU]\n", "recording",
                    "pairs", "go %", "motion", "95 %", "each", "one", "95 %", "all", "95 %");
        for (const std::string& place : places) {
            auto film = made(place, frames);
            print_row(place, cost_of(film ? std::move(*film) : read(place, frames), times));
        }
        return 0;
    } catch (const std::exception& error) {
        print_error_line(error.what());
        return 1;
    }
}
