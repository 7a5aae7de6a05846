// Depth made by estimators that work, are slow, crash, answer wrongly or not at all: small scripts,
// started as the real ones are.
#include "core/estimate/depth_estimate.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/estimate/depth_cache.hpp"
#include "core/video/playing/frame_reader.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/sidecar.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;
using Catch::Matchers::WithinAbs;

namespace {

constexpr int kFrames = 24;

/// $1: the folder of frames, $2: that of the depth. For each frame `step`, with $n, $f, $name,
/// $out.
std::string by_frames(const std::string& step) {
    return "echo once >> starts\nn=0\nfor f in \"$1\"/*.png; "
           "do\nn=$((n+1))\nname=${f##*/}\nout=$2\n" +
           step + "\ndone\n";
}

const std::string kCopy = "cp \"$f\" \"$out/.$name\" && mv \"$out/.$name\" \"$out/$name\"";

/// Made once.
const fs::path& plain_clip() {
    static const TemporaryFolder folder;
    static const fs::path clip = [] {
        make_flat_clip(folder / "plain.mkv", kFrames, 30, kLossless);
        return folder / "plain.mkv";
    }();
    return clip;
}

/// A folder with a video of colour alone, whose frame n has level 5 n, and an estimator.
struct Bench {
    TemporaryFolder folder{};
    fs::path home{folder / "a home"};
    EstimateWatch watch{};

    explicit Bench(const std::string& script, const std::string& filter = "", int width = 64) {
        fs::create_directories(home);
        if (filter.empty() && width == 64)
            fs::copy_file(plain_clip(), clip());
        else
            make_flat_clip(clip(), kFrames, 30, kLossless, filter, width);
        write_script(script);
    }
    [[nodiscard]] fs::path clip() const { return home / "my clip.mkv"; }
    [[nodiscard]] fs::path program() const { return home / "the estimator"; }
    [[nodiscard]] fs::path cache() const { return home / "cache"; }

    void write_script(const std::string& script) const {
        write_text(program(), "#!/bin/sh\ncd '" + home.string() + "'\n" + script);
        fs::permissions(program(), fs::perms::owner_all);
    }
    [[nodiscard]] EstimateRequest request(const std::string& places = "{frames} {output}") const {
        return {.colour = clip(),
                .command = "'" + program().string() + "' " + places,
                .cache = cache()};
    }
    [[nodiscard]] std::string failure(const EstimateRequest& asked) {
        return refusal([&] { (void)estimate_depth(asked, watch); });
    }
    [[nodiscard]] std::string failure() { return failure(request()); }
    /// How often it was started.
    [[nodiscard]] std::size_t starts() const {
        const std::string lines = read_text(home / "starts");
        return static_cast<std::size_t>(std::count(lines.begin(), lines.end(), '\n'));
    }
    [[nodiscard]] std::size_t kept_frames() const {
        const auto kept = kept_estimates(cache());
        return kept.size() == 1 ? kept.front().frames_there : 0;
    }
};

/// Frames of colour and depth as they are paired: both say their number.
void check_pairs(const fs::path& colour, const fs::path& depth, std::size_t count) {
    const auto media = open_media(colour, depth);  // levels as recorded
    std::size_t frames = 0;
    for (; const auto frame = media->next(); ++frames)
        REQUIRE(std::abs(frame->depth.at(3, 3) - static_cast<float>(frame->colour.rgb[0])) <= 1.0F);
    CHECK(frames == count);
}

/// The first level and the time of each picture, as the file has them.
struct Timed {
    double level, time_s;
};
std::vector<Timed> levels_of(const fs::path& file) {
    std::vector<Timed> all;
    const auto media = open_depth(file);
    while (const auto frame = media->next())
        all.push_back({static_cast<double>(frame->depth.at(3, 3)), frame->media_s});
    return all;
}

}  // namespace

TEST_CASE("an estimator of pictures gives depth that goes with the colour, frame by frame",
          "[estimate]") {
    Bench bench(by_frames(kCopy));
    const auto made = estimate_depth(bench.request(), bench.watch);
    REQUIRE(made);
    CHECK(made->frames == kFrames);
    CHECK_FALSE(made->kept_before);
    const std::vector<Timed> levels = levels_of(made->depth);
    REQUIRE(levels.size() == kFrames);
    for (std::size_t k = 0; k < levels.size(); ++k) {
        CHECK(levels[k].level == 5.0 * static_cast<double>(k));
        CHECK_THAT(levels[k].time_s, WithinAbs(static_cast<double>(k) / 30.0, 0.0006));
    }
    check_pairs(bench.clip(), made->depth, kFrames);
    const DepthMeaning meaning = *describe_media(made->depth).meaning;
    CHECK(meaning.unit == Known<DepthUnit>{DepthUnit::levels, Origin::sidecar});
    CHECK(meaning.near == Known<NearLevels>{NearLevels::bright, Origin::sidecar});
    CHECK(meaning.no_data.value.empty());
    CHECK(assumed_facts(meaning).empty());
}

TEST_CASE("the second time depth is there at once, for the same content and command",
          "[estimate]") {
    Bench bench(by_frames(kCopy));
    REQUIRE(estimate_depth(bench.request(), bench.watch));
    fs::rename(bench.clip(), bench.home / "renamed.mkv");
    EstimateRequest renamed = bench.request();
    renamed.colour = bench.home / "renamed.mkv";
    const auto again = estimate_depth(renamed, bench.watch);
    REQUIRE(again);
    CHECK(again->kept_before);
    CHECK(bench.starts() == 1);
    renamed.again = true;
    CHECK_FALSE(estimate_depth(renamed, bench.watch)->kept_before);
    CHECK(bench.starts() == 2);
    renamed.again = false;
    renamed.command += " --other";
    REQUIRE(estimate_depth(renamed, bench.watch));
    CHECK(bench.starts() == 3);
    CHECK(kept_estimates(bench.cache()).size() == 2);
    for (const KeptEstimate& kept : kept_estimates(bench.cache())) CHECK(forget_estimate(kept));
    CHECK(kept_estimates(bench.cache()).empty());
}

TEST_CASE("depth that is kept and damaged is made anew", "[estimate]") {
    Bench bench(by_frames(kCopy));
    const auto made = estimate_depth(bench.request(), bench.watch);
    REQUIRE(made);
    const std::string whole = read_text(made->depth);
    std::string changed = whole;
    changed[whole.size() / 2] = static_cast<char>(changed[whole.size() / 2] ^ 1);
    std::string zeros = whole;
    zeros.replace(whole.size() / 2, std::string::npos, whole.size() - whole.size() / 2, '\0');
    std::size_t starts = 1;
    for (const std::string& damaged :
         {std::string(), zeros, changed, whole + "x", whole.substr(0, whole.size() - 1)}) {
        write_text(made->depth, damaged);
        const auto again = estimate_depth(bench.request(), bench.watch);
        REQUIRE(again);
        CHECK_FALSE(again->kept_before);
        CHECK(bench.starts() == ++starts);
        CHECK(levels_of(again->depth).size() == kFrames);
    }
    fs::remove(made->depth);
    CHECK_FALSE(estimate_depth(bench.request(), bench.watch)->kept_before);
    CHECK(estimate_depth(bench.request(), bench.watch)->kept_before);
}

TEST_CASE("a crash at frame 7 keeps six, says so in a line, and the next run goes on from there",
          "[estimate]") {
    Bench bench(
        by_frames("echo \"frame $name\"\nif [ $n = 7 ]; then printf 'half' > \"$out/$name\"; "
                  "kill -SEGV $$; fi\n" +
                  kCopy));
    const std::string told = bench.failure();
    CHECK(contains(told, "was ended by signal 11 (Segmentation fault) at frame 7 of 24; "));
    CHECK(contains(told, "6 are kept: run it again to go on from there"));
    CHECK(contains(told, "its last line: 'frame 000007.png'"));
    CHECK(told.find('\n') == std::string::npos);
    CHECK(bench.kept_frames() == 6);
    bench.write_script(by_frames("echo $name >> given\n" + kCopy));
    const auto made = estimate_depth(bench.request(), bench.watch);
    REQUIRE(made);
    CHECK(read_text(bench.home / "given").starts_with("000007.png\n"));
    CHECK(bench.starts() == 2);
    const std::vector<Timed> levels = levels_of(made->depth);
    REQUIRE(levels.size() == kFrames);
    for (std::size_t k = 0; k < levels.size(); ++k)
        CHECK(levels[k].level == 5.0 * static_cast<double>(k));
}

TEST_CASE("a slow one shows how far it is, is cancelled at once, and goes on the next time",
          "[estimate]") {
    Bench bench("");
    const fs::path gate = bench.home / "gate";
    REQUIRE(::mkfifo(gate.c_str(), 0600) == 0);
    // Each frame waits for a line of the gate.
    bench.write_script("exec 3<gate\n" + by_frames("read line <&3\n" + kCopy));
    std::optional<DepthEstimate> made{DepthEstimate{}};
    std::thread maker([&] { made = estimate_depth(bench.request(), bench.watch); });
    {
        std::ofstream may_go_on(gate);  // waits for the estimator
        for (const std::size_t done : {2U, 5U}) {
            may_go_on << (done == 2 ? "1\n2\n" : "3\n4\n5\n") << std::flush;
            CHECK(eventually([&] { return bench.watch.progress().done == done; }));
        }
        CHECK(eventually([&] { return bench.watch.progress().left_s.has_value(); }));
        const EstimateProgress now = bench.watch.progress();
        CHECK(now.step == EstimateStep::estimating);
        CHECK(now.of == kFrames);
        CHECK(now.left_s.value_or(0.0) > 0.0);
        CHECK(contains(in_words(now), "estimating frame "));
        CHECK(contains(in_words(now), " left"));
        bench.watch.stop();
        maker.join();  // it waits for the next line
    }
    CHECK_FALSE(made);
    CHECK(bench.kept_frames() == 5);
    bench.write_script(by_frames("echo $name >> given\n" + kCopy));
    EstimateWatch watch;
    REQUIRE(estimate_depth(bench.request(), watch));
    const std::string given = read_text(bench.home / "given");
    CHECK(std::count(given.begin(), given.end(), '\n') == kFrames - 5);
}

TEST_CASE("one that will not end when it is asked to is killed, with all that it started",
          "[estimate]") {
    Bench bench(
        "trap '' TERM\nsleep 60 &\necho $! > child\necho $$ > self\nwhile :; do sleep 1; done\n");
    std::optional<DepthEstimate> made{DepthEstimate{}};
    std::thread maker([&] { made = estimate_depth(bench.request(), bench.watch); });
    CHECK(eventually([&] { return !read_text(bench.home / "self").empty(); }));
    bench.watch.stop();
    maker.join();
    CHECK_FALSE(made);
    for (const char* const name : {"child", "self"}) {
        const std::string pid = read_text(bench.home / name);
        const auto ended = [&] {
            const std::string state = read_text("/proc/" + pid.substr(0, pid.find('\n')) + "/stat");
            return state.empty() || state.find(") Z ") != std::string::npos;
        };
        CHECK(eventually(ended));
    }
}

namespace {

/// `talk`: of more than a million bytes.
void check_bounded(const std::string& talk) {
    CAPTURE(talk);
    Bench bench("echo first words\n" + talk + "\necho\necho last words\nexit 3\n");
    const std::string told = bench.failure(bench.request("{input} {output}"));
    CHECK(contains(told, "ended with 3; its last line: 'last words'; all its output is in "));
    CHECK(told.find('\n') == std::string::npos);
    const auto kept = kept_estimates(bench.cache());
    REQUIRE(kept.size() == 1);
    const std::string said = read_text(kept.front().folder / "said.txt");
    CHECK(said.size() < 1600000);
    CHECK(said.starts_with("first words\n"));
    CHECK(said.ends_with("last words\n"));
    CHECK(contains(said, " bytes are left out here]"));
}

const std::string kMillions = "head -c 3000000 /dev/zero | tr '\\0' ";

}  // namespace

TEST_CASE(
    "of one that talks without end the first and the last words are kept, and no disk is filled",
    "[estimate]") {
    check_bounded(GENERATE_COPY(
        kMillions + "x", std::string("head -c 3000000 /dev/urandom"),
        std::string("(yes A | head -c 1500000 & yes B | head -c 1500000 >&2; wait)")));
}

TEST_CASE("whatever one that talks without end says, no disk is filled", "[estimate][long]") {
    check_bounded(GENERATE_COPY(
        kMillions + "'\\n'", kMillions + "'\\r'", kMillions + "' '", kMillions + "'\\t'",
        kMillions + "'\\b'", kMillions + "'\\033'", kMillions + "'\\377'", kMillions + "'\\302'",
        kMillions + "'7' >&2", std::string("head -c 3000000 /dev/zero"),
        std::string("head -c 3000000 /dev/urandom >&2"), std::string("yes | head -c 3000000"),
        std::string("yes '1/2' | head -c 3000000"),
        std::string("yes 'frame 7 of 24' | head -c 3000000"),
        std::string("seq -f '%.0f/9000000' 200000 | head -c 3000000; head -c 1000000 /dev/zero"),
        std::string("yes A | head -c 1500000; yes B | head -c 1500000 >&2"),
        std::string("setsid sh -c 'yes C | head -c 3000000'; wait")));
}

TEST_CASE("one that shows no sign of life is ended when patience is", "[estimate]") {
    Bench bench("sleep 60\n");
    EstimateRequest request = bench.request();
    request.timeout_s = 1.0;
    CHECK(contains(bench.failure(request), "wrote and printed nothing for 1 s and was ended"));
}

TEST_CASE("what is there and wrong is told in a line, and nothing is kept as depth", "[estimate]") {
    struct Wrong {
        std::string script, told;
    };
    const Wrong wrong = GENERATE(
        Wrong{by_frames("cp square.png \"$out/$name\""),
              "of another shape than the colour, 48 x 48 in '000001.png' instead of 64 x"},
        Wrong{by_frames("[ $n = 5 ] || " + kCopy), "gave 23 pictures ('000001.png') for"},
        Wrong{by_frames(""), "left no depth"},
        Wrong{"echo A; echo 'ModuleNotFoundError: torch' >&2; exit 3\n",
              "ended with 3; its last line: 'ModuleNotFoundError: torch'; all its output is"},
        Wrong{by_frames("echo nonsense > \"$out/$name\""),
              "the estimator's depth cannot be read: "},
        Wrong{by_frames("cp red.png \"$out/$name\""), "painted its depth in colours"},
        Wrong{by_frames("cp grey.png \"$out/$name\""), "one level everywhere"},
        Wrong{"head -c 300000 /dev/urandom; echo; exit 1\n", "ended with 1"});
    Bench bench(wrong.script);
    write_picture(bench.home / "square.png", 48, 48, 8, 1, [](int i, int, int) { return i; });
    write_picture(bench.home / "red.png", 64, 48, 8, 3, [](int, int, int c) { return 120 * c; });
    write_picture(bench.home / "grey.png", 64, 48, 8, 1, [](int, int, int) { return 7; });
    const std::string told = bench.failure();
    CHECK(contains(told, wrong.told));
    CHECK(told.find('\n') == std::string::npos);
    const auto kept = kept_estimates(bench.cache());
    REQUIRE(kept.size() == 1);
    CHECK(kept.front().record.depth.empty());
    CHECK(fs::exists(bench.clip()));
}

TEST_CASE("a program that is not there, or no program, is told by its name", "[estimate]") {
    Bench bench("");
    EstimateRequest request = bench.request();
    request.command = "no-such-estimator {input} {output}";
    CHECK(contains(bench.failure(request),
                   "there is no program 'no-such-estimator'; install it, or write its whole path"));
    request.command = "'" + bench.clip().string() + "' {input} {output}";
    CHECK(contains(bench.failure(request), "cannot be executed; make it executable (chmod +x)"));
    write_text(bench.program(), "#!/no/such/python\n");
    CHECK(contains(bench.failure(), "(#!) is not there"));
    request = bench.request();
    request.colour = bench.home / "none.mp4";
    CHECK(contains(bench.failure(request), "none.mp4'"));
}

TEST_CASE("an estimator of videos is paired by the colour's times, at variable rates, too",
          "[estimate]") {
    Bench bench(
        "echo once >> starts\nffmpeg -nostdin -v quiet -i \"$1\" -vf setpts=N/29/TB -r 29 "
        "-pix_fmt gray -c:v ffv1 \"$2/my clip_vis.mkv\"\ncp \"$1\" \"$2/my clip_src.mkv\"\n",
        "select='not(eq(mod(n,5),2))',setpts=PTS+7/TB");
    const auto made = estimate_depth(bench.request("{input} {output}"), bench.watch);
    REQUIRE(made);
    const std::vector<Timed> depth = levels_of(made->depth);
    REQUIRE(depth.size() == kFrames);
    // Frames 0 1 3 4 5 6 8 ... of 30 a second: a number tells the time.
    for (const Timed& one : depth)
        CHECK_THAT(one.time_s, WithinAbs(std::round(one.level / 5.0) / 30.0, 0.0011));
    CHECK(depth.back().time_s > 0.9);
    check_pairs(bench.clip(), made->depth, kFrames);
}

TEST_CASE("a video of another rate that lasts as long keeps its times, a shorter one is refused",
          "[estimate]") {
    const std::string part = GENERATE(as<std::string>{}, "", "-t 0.3");
    Bench bench("ffmpeg -nostdin -v quiet -i \"$1\" -r 15 " + part +
                " -pix_fmt gray -c:v ffv1 \"$2\"\n");
    const EstimateRequest request = bench.request("{input} {output.mkv}");
    if (!part.empty()) {
        CHECK(contains(bench.failure(request), "pictures ('depth.mkv') for the 24 frames"));
        return;
    }
    const auto made = estimate_depth(request, bench.watch);
    REQUIRE(made);
    for (const Timed& one : levels_of(made->depth))
        CHECK_THAT(one.level / 5.0 / 30.0, WithinAbs(one.time_s, 0.07));
}

TEST_CASE("of several forms the finest is taken, and numbers become levels in their unit",
          "[estimate]") {
    // As depth-pro leaves them: a picture in colours, and the distances as numbers.
    Bench bench(
        by_frames("cp numbers.pfm \"$out/${name%.png}.pfm\"\ncp painted.jpg "
                  "\"$out/${name%.png}.jpg\""));
    cv::Mat metres(24, 32, CV_32F);
    for (int j = 0; j < metres.rows; ++j)
        for (int i = 0; i < metres.cols; ++i)
            metres.at<float>(j, i) = 1.0F + 0.25F * static_cast<float>(i);
    metres.at<float>(5, 7) = std::nanf("");
    REQUIRE(cv::imwrite((bench.home / "numbers.pfm").string(), metres));
    ffmpeg("-f lavfi -i color=red:s=64x48 -frames:v 1 '" + (bench.home / "painted.jpg").string() +
           "'");
    EstimateRequest request = bench.request();
    request.meaning.unit = DepthUnit::m;
    const auto made = estimate_depth(request, bench.watch);
    REQUIRE(made);
    const MediaDescription media = describe_media(made->depth);
    CHECK(media.depth_columns == 32);
    CHECK(media.depth_bits == 16);
    CHECK(media.meaning->unit.value == DepthUnit::m);
    CHECK(media.meaning->near.value == NearLevels::dark);
    const double scale = media.meaning->scale.value;
    CHECK(scale <= 0.001);
    const auto depth = open_depth(made->depth);
    const auto frame = depth->next();
    REQUIRE(frame);
    for (const int i : {0, 3, 20, 31})
        CHECK_THAT(static_cast<double>(frame->depth.at(i, 2)) * scale,
                   WithinAbs(1.0 + 0.25 * i, 0.0006));
    CHECK(frame->depth.at(7, 5) == 0.0F);
    CHECK(media.meaning->no_data.value == std::vector<double>{0.0});
}

TEST_CASE("what numbers mean can be said later, and stays said", "[estimate]") {
    Bench bench(by_frames("cp numbers.pfm \"$out/${name%.png}.pfm\""));
    cv::Mat metres(24, 32, CV_32F);
    for (int j = 0; j < metres.rows; ++j)
        for (int i = 0; i < metres.cols; ++i)
            metres.at<float>(j, i) = 2.0F + 0.125F * static_cast<float>(i);
    REQUIRE(cv::imwrite((bench.home / "numbers.pfm").string(), metres));
    const auto meaning = [&](const DepthStatement& said) {
        EstimateRequest request = bench.request();
        request.meaning = said;
        const auto made = estimate_depth(request, bench.watch);
        REQUIRE(made);
        DepthMeaning known = *describe_media(made->depth).meaning;
        const double metre = levels_of(made->depth).front().level * known.scale.value;
        CHECK_THAT(metre, WithinAbs(2.375 * said.scale.value_or(1.0), 0.001));
        return known;
    };
    CHECK(meaning({}).unit.value == DepthUnit::levels);
    CHECK(meaning({.unit = DepthUnit::m}).near.value == NearLevels::dark);
    CHECK(meaning({}).unit.value == DepthUnit::m);
    CHECK(meaning({.scale = 2.0}).unit.value == DepthUnit::m);
    CHECK(bench.starts() == 1);
}

TEST_CASE("pictures squeezed to a network's sides are stretched to the colour's shape",
          "[estimate]") {
    Bench bench(by_frames("cp ramp.png \"$out/$name\""), "", 640);
    write_picture(bench.home / "ramp.png", 640, 64, 8, 1, [](int i, int, int) { return i / 4; });
    ffmpeg("-f lavfi -i testsrc=s=640x60:r=30 -frames:v 3 '" + (bench.home / "wide.mp4").string() +
           "'");
    EstimateRequest request = bench.request();
    request.colour = bench.home / "wide.mp4";
    const auto made = estimate_depth(request, bench.watch);
    REQUIRE(made);
    const MediaDescription media = describe_media(made->depth);
    CHECK_THAT(1.0 * media.depth_columns / media.depth_rows, WithinAbs(640.0 / 60.0, 0.1));
}

TEST_CASE("a scale of its own in each frame is seen as one when the depth is opened",
          "[estimate]") {
    // A relief that does not move.
    Bench bench(by_frames("cp \"scaled_$name\" \"$out/$name\""));
    for (int n = 1; n <= kFrames; ++n) {
        const double gain = 200.0 * (1.0 + 0.03 * std::sin(1.0 + 2.3 * n));
        const double shift = 1200.0 * std::cos(4.1 * n);
        char name[32];
        std::snprintf(name, sizeof name, "scaled_%06d.png", n);
        write_picture(bench.home / name, 64, 48, 16, 1, [&](int i, int j, int) {
            const double height = 100.0 + i + 30.0 * std::sin(i / 9.0) * std::cos(j / 7.0);
            return static_cast<int>(5000.0 + gain * height + shift);
        });
    }
    const auto made = estimate_depth(bench.request(), bench.watch);
    REQUIRE(made);
    FrameReader reader(open_media(bench.clip(), made->depth, {.find_out = true}));
    REQUIRE(reader.at(0.2));
    CHECK(reader.plan().noise.per_frame_scale);
}

TEST_CASE("depth of a still picture is a picture", "[estimate]") {
    Bench bench(by_frames("cp ramp.png \"$out/$name\""));
    write_picture(bench.home / "ramp.png", 64, 48, 8, 1, [](int i, int, int) { return i; });
    ffmpeg("-f lavfi -i testsrc=s=64x48 -frames:v 1 '" + (bench.home / "photo.png").string() + "'");
    EstimateRequest request = bench.request();
    request.colour = bench.home / "photo.png";
    const auto made = estimate_depth(request, bench.watch);
    REQUIRE(made);
    CHECK(made->depth.extension() == ".png");
    const auto frame = open_media(request.colour, made->depth, {.find_out = true})->next();
    REQUIRE(frame);
    CHECK(frame->depth.at(40, 9) > frame->depth.at(20, 9));
    const fs::path copied = copy_depth(*made, request.colour, bench.home);
    CHECK(copied == bench.home / "photo_depth.png");
    CHECK(open_media(request.colour)->description().depth_path == copied);
}
