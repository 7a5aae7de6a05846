// Prints what the cleaning of a frame costs, step by step: cleaning_cost [--cleaning sensor,auto]
// [--size 640x480,1920x1080] [--frames N] [PLACE...]. A place is what `dibhr view` takes, in one
// word; its frames are stretched to the size, with fresh noise. bad, bad16, clean, clean16,
// sparse30 and sparse5 are synthetic; of the last two 30 and 5 % of the pixels are seen.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <exception>
#include <filesystem>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/cleaning/cleaning_chain.hpp"
#include "core/video/cleaning/sparse_meter.hpp"
#include "core/video/formats/libraries.hpp"
#include "core/video/frames/colour_image.hpp"
#include "core/video/sources/media.hpp"

namespace {

using namespace dibhr;

constexpr double kMadeNoise = 1.0 / 255.0;  ///< standard deviation, of the highest level

struct Size {
    int columns{0}, rows{0};
};

/// Of "640x480"; without text, the recorded size.
Size size_of(const std::string& words) {
    Size size;
    if (std::sscanf(words.c_str(), "%dx%d", &size.columns, &size.rows) != 2) return {};
    return size;
}

/// CPU time of the process, whose other threads wait: threads of libraries count, too.
double cpu_ms() {
    timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// Synthetic frames of 8 bits or more, with many errors or none.
struct Made {
    const char* name;
    double highest_level;
    bool bad;
    unsigned seen_thousandths{1000};
};
constexpr std::array<Made, 6> kMade{{{"bad", 255.0, true},
                                     {"bad16", 8000.0, true},
                                     {"clean", 255.0, false},
                                     {"clean16", 8000.0, false},
                                     {"sparse30", 8000.0, false, 300},
                                     {"sparse5", 8000.0, false, 50}}};

/// Steps in front of a wavy wall; where it is bad, holes, flickering patches, noise and outliers.
DepthImage made_frame(Size size, const Made& made, std::size_t number) {
    std::mt19937 random(static_cast<unsigned>(number));
    std::normal_distribution<float> noise;
    const double highest = made.highest_level;
    const double time = 0.1 * static_cast<double>(number);
    return image_of(size.columns, size.rows, highest, [&](int i, int j) {
        const double x = 8.0 * i / size.columns;
        const double y = 6.0 * j / size.columns;
        const bool near = std::fmod(x + time, 2.0) < 1.0 && std::fmod(y, 2.0) < 1.4;
        const bool flips = made.bad && std::fmod(x + 5.0 * time, 1.7) < 0.1;
        const double level = (near != flips ? 0.7 : 0.3) + 0.05 * std::sin(3.0 * x + 2.0 * y);
        const auto dice = random() % 1000;
        if (dice >= made.seen_thousandths) return std::nan("");
        if (!made.bad) return std::round(highest * level);
        const bool shadow = near && std::fmod(x + time, 2.0) > 0.9;
        if (dice < 30 || (shadow && dice < 900)) return std::nan("");
        const double outlier = dice < 35 ? 0.3 : 0.0;
        const double shaken = level + outlier + kMadeNoise * static_cast<double>(noise(random));
        return std::round(highest * std::clamp(shaken, 0.0, 1.0));
    });
}

/// The nearest pixel's level and fresh noise: whole levels where there were.
DepthImage stretched(const DepthImage& image, Size size, const DepthNoise& noise, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    const auto highest = static_cast<float>(image.highest_level);
    return image_of(size.columns, size.rows, image.highest_level, [&](int i, int j) {
        const float level = image.at(i * image.columns / size.columns, j * image.rows / size.rows);
        const float shake = normal(random) * noise.at(level / highest) * highest;
        if (std::isnan(level)) return level;
        return std::clamp(std::round(level + shake), 0.0F, highest) + 0.0F;  // no -0
    });
}

struct Clip {
    std::vector<DepthImage> frames{};
    std::vector<std::vector<HeldLevel>> held{};
    DepthNoise noise{};
    std::optional<ColourImage> colour{};  ///< of sparse depth, which is interpolated with it
};

/// The shades of the first frame as a colour picture, the worst that colour steps can be.
ColourImage shades_of(const DepthImage& image) {
    ColourImage colour{image.columns, image.rows, {}};
    for (const float level : image.levels) {
        const float shade = std::isnan(level) ? 0.0F : level;
        const auto byte =
            static_cast<std::uint8_t>(255.0 * static_cast<double>(shade) / image.highest_level);
        colour.rgb.insert(colour.rgb.end(), 3, byte);
    }
    return colour;
}

std::vector<DepthImage> read(const std::string& place, std::size_t count) {
    std::vector<DepthImage> frames;
    const auto media = open_media(place, {}, {.find_out = true});
    while (frames.size() < count) {
        std::optional<RawFrame> frame = media->next();
        if (!frame) break;
        frames.push_back(std::move(frame->depth));
    }
    if (frames.empty()) throw InputError(place + " holds no picture");
    return frames;
}

DepthNoise noise_of(const std::vector<DepthImage>& frames) {
    NoiseMeter meter;
    for (std::size_t k = 0; k < std::min(frames.size(), NoiseMeter::kEnoughFrames); ++k)
        meter.add(frames[k]);
    return meter.noise();
}

Clip clip_of(const std::string& place, Size size, std::size_t count) {
    Clip clip;
    const auto* const made = std::find_if(kMade.begin(), kMade.end(),
                                          [&](const Made& one) { return place == one.name; });
    if (made != kMade.end()) {
        if (size.columns == 0) size = {640, 480};
        for (std::size_t k = 0; k < count; ++k) clip.frames.push_back(made_frame(size, *made, k));
    } else {
        clip.frames = read(place, count);
        const DepthNoise noise = noise_of(clip.frames);
        for (std::size_t k = 0; size.columns != 0 && k < clip.frames.size(); ++k)
            clip.frames[k] = stretched(clip.frames[k], size, noise, static_cast<unsigned>(k));
    }
    clip.noise = noise_of(clip.frames);
    SparseMeter meter;
    meter.add(clip.frames.front());
    if (meter.sparse_share()) clip.colour = shades_of(clip.frames.front());
    DepthMemory memory;
    for (std::size_t k = 0; k < clip.frames.size(); ++k)
        clip.held.push_back(memory.take(clip.frames[k], static_cast<double>(k) / 30.0));
    return clip;
}

struct Cost {
    double least_ms{0.0}, median_ms{0.0};
};

double median_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

Cost cost_of(const std::vector<double>& each_ms) {
    return {*std::min_element(each_ms.begin(), each_ms.end()), median_of(each_ms)};
}

/// A checksum of the finished levels, which shows whether they changed.
std::uint64_t mixed(std::uint64_t sum, const DepthImage& image) {
    for (const float level : image.levels)
        sum = (sum ^ std::bit_cast<std::uint32_t>(level)) * 0x100000001B3ULL;
    return sum;
}

/// Pages that the process was given, each of which the system had to clear.
double pages() {
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    return static_cast<double>(used.ru_minflt);
}

struct Cleaned {
    Cost clean_frame{}, finish_frame{};
    double pages{0.0};  ///< median of both together
    std::uint64_t sum{0xCBF29CE484222325ULL};
};

/// All frames with these steps; those at the ends, which have fewer around them, are not counted.
/// As in a player, a frame that is not cleaned with others is finished and freed at once.
Cleaned clean(const Clip& clip, const CleaningPlan& plan) {
    CleaningChain chain;
    Cleaned cleaned;
    std::vector<double> clean_frame_ms, finish_frame_ms, clean_pages, finish_pages;
    const auto finish = [&](std::span<const SingleFrameDepth* const> frames, std::size_t now,
                            bool counts) {
        const double begin_ms = cpu_ms();
        const double begin_pages = pages();
        const Frame done = chain.finish_frame(frames, now, plan);
        if (counts) finish_frame_ms.push_back(cpu_ms() - begin_ms);
        if (counts) finish_pages.push_back(pages() - begin_pages);
        cleaned.sum = mixed(cleaned.sum, *done.depth);
    };
    std::vector<SingleFrameDepth> kept;
    for (std::size_t k = 0; k < clip.frames.size(); ++k) {
        DepthImage frame = clip.frames[k];
        const double begin_ms = cpu_ms();
        const double begin_pages = pages();
        SingleFrameDepth single_frame = chain.clean_frame(std::move(frame), plan, clip.held[k],
                                                          clip.colour ? &*clip.colour : nullptr);
        if (k > 1) clean_frame_ms.push_back(cpu_ms() - begin_ms);
        if (k > 1) clean_pages.push_back(pages() - begin_pages);
        if (plan.steps.steady) {
            kept.push_back(std::move(single_frame));
        } else {
            const SingleFrameDepth* const alone = &single_frame;
            finish({&alone, 1}, 0, k > 1);
        }
    }
    std::vector<const SingleFrameDepth*> all;
    for (const SingleFrameDepth& one : kept) all.push_back(&one);
    for (std::size_t k = 0; k < all.size(); ++k) {
        const bool inside = k >= kReachInTime && k + kReachInTime < all.size();
        finish(all, k, inside || all.size() <= 2 * kReachInTime);
    }
    cleaned.pages = median_of(clean_pages) + median_of(finish_pages);
    cleaned.clean_frame = cost_of(clean_frame_ms);
    cleaned.finish_frame = cost_of(finish_frame_ms);
    return cleaned;
}

/// Prints what each step adds, and what all of them cost.
void print_costs(const Clip& clip, const CleaningSteps& wanted) {
    CleaningSteps steps;
    Cleaned before = clean(clip, {steps, {}, clip.noise});
    std::printf(" %7.2f", before.clean_frame.least_ms + before.finish_frame.least_ms);
    std::vector<bool> on;
    visit_steps(wanted, [&](const char*, bool step) { on.push_back(step); });
    for (std::size_t step = 0; step < on.size(); ++step) {
        std::size_t k = 0;
        visit_steps(steps, [&](const char*, bool& value) { value = k++ <= step && on[k - 1]; });
        const Cleaned now = on[step] ? clean(clip, {steps, {}, clip.noise}) : before;
        std::printf(" %7.2f", now.clean_frame.least_ms - before.clean_frame.least_ms +
                                  now.finish_frame.least_ms - before.finish_frame.least_ms);
        before = now;
    }
    std::printf(" | %7.2f %7.2f | %7.2f %7.2f | %6.0f | %016llx\n", before.clean_frame.least_ms,
                before.clean_frame.median_ms, before.finish_frame.least_ms,
                before.finish_frame.median_ms, before.pages,
                static_cast<unsigned long long>(before.sum));
    std::fflush(stdout);
}

void print_head() {
    std::printf(
        "%-36s %-9s %-7s %7s %7s %7s %7s %7s %7s %7s %7s %7s | %7s %7s | %7s %7s | %6s | [ms of "
        "CPU]\n",
        "recording", "size", "way", "none", "sparse", "spikes", "holes", "silhou.", "colours",
        "time", "steps", "noise", "alone", "median", "finish", "median", "pages");
}

}  // namespace

int main(int count, char** words) {
    std::vector<std::string> places{"bad"}, ways{"sensor"}, sizes{"as recorded"};
    std::size_t frames = 24;
    CLI::App app{"What the cleaning of a frame costs."};
    app.add_option("PLACE", places,
                   "Recordings; bad, bad16, clean, clean16, sparse30 and sparse5 are made up")
        ->capture_default_str();
    app.add_option("--cleaning", ways,
                   "Presets, one after the other; auto: what it takes for large pictures")
        ->delimiter(',')
        ->check(CLI::IsMember({"gentle", "auto", "sensor"}))
        ->capture_default_str();
    app.add_option("--size", sizes, "Such as 640x480, one after the other")->delimiter(',');
    app.add_option("--frames", frames, "Of each")->check(CLI::Range(3, 1000));
    CLI11_PARSE(app, count, words);
    set_up_libraries();
    try {
        print_head();
        for (const std::string& place : places)
            for (const std::string& size : sizes) {
                const Clip clip = clip_of(place, size_of(size), frames);
                for (const std::string& way : ways) {
                    const std::filesystem::path path(place);
                    const auto name = path.parent_path().filename() / path.filename();
                    const DepthImage& first = clip.frames.front();
                    std::printf("%-36s %4dx%-4d %-7s", name.c_str(), first.columns, first.rows,
                                way.c_str());
                    CleaningSteps steps = way == "gentle" ? kGentleSteps
                                          : way == "auto" ? ways_of_automatic(0).front()
                                                          : kSensorSteps;
                    steps.densify = clip.colour.has_value();
                    print_costs(clip, steps);
                }
            }
        return 0;
    } catch (const std::exception& error) {
        print_error_line(error.what());
        return 1;
    }
}
