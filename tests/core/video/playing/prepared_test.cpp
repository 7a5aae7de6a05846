// Prepared recordings: the same surface as cleaned while it plays, found by content, bounded.
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/video/playing/frame_reader.hpp"
#include "core/video/playing/prepared_cache.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

constexpr std::uintmax_t kRoom = 1'000'000'000;
constexpr std::size_t kFrames = 20;

/// Colour and depth with noise, holes and something that moves.
void put_film(const TemporaryFolder& folder) {
    const std::string noisy =
        "-f lavfi -i testsrc2=s=96x72:r=10:d=2,noise=alls=12:allf=t:all_seed=5";
    ffmpeg(noisy + " -c:v ffv1 " + (folder / "film_color.mkv").string());
    ffmpeg(noisy + ",format=gray -c:v ffv1 " + (folder / "film_depth.mkv").string());
}

std::unique_ptr<Media> opened(const TemporaryFolder& folder, bool uses = true) {
    return open_media(folder / "film_color.mkv", folder / "film_depth.mkv",
                      {.prepared_in = uses ? folder / "cache" : fs::path()});
}

Prepared prepared(const TemporaryFolder& folder, const CleaningOptions& cleaning) {
    auto made = prepare(opened(folder),
                        {.cache = folder / "cache", .cleaning = cleaning, .most_bytes = kRoom});
    REQUIRE(made);
    return *made;
}

CleaningOptions by(CleaningPreset preset, double finger_px = 0.0) {
    return {.preset = preset, .finger = {finger_px, 80.0}};
}

std::vector<std::uint32_t> bits_of(const std::shared_ptr<const DepthImage>& image) {
    std::vector<std::uint32_t> bits;
    if (!image) return bits;
    for (const float level : image->levels) bits.push_back(std::bit_cast<std::uint32_t>(level));
    return bits;
}

void check_same(const std::optional<Frame>& a, const std::optional<Frame>& b) {
    REQUIRE(a);
    REQUIRE(b);
    CHECK(a->media_s == b->media_s);
    CHECK(bits_of(a->depth) == bits_of(b->depth));
    CHECK(bits_of(a->undilated) == bits_of(b->undilated));
    CHECK(a->depth->highest_level == b->depth->highest_level);
    CHECK((a->unseen == nullptr) == (b->unseen == nullptr));
    if (a->unseen && b->unseen) CHECK(*a->unseen == *b->unseen);
    CHECK(a->cleaning == b->cleaning);
    CHECK(a->has_colour() == b->has_colour());
}

/// One reader that finds the prepared surface, and one that cleans.
struct Pair {
    Pair(const TemporaryFolder& folder, const CleaningOptions& cleaning)
        : prepared(opened(folder)), cleaned(opened(folder, false)) {
        prepared.set_cleaning(cleaning);
        cleaned.set_cleaning(cleaning);
    }
    FrameReader prepared;
    FrameReader cleaned;
};

/// Overwrites some bytes in the middle of the kept surface.
void spoil(const fs::path& kept) {
    std::fstream file(kept / "surface", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(fs::file_size(kept / "surface") / 2));
    file.write("spoiled.spoiled.", 16);
}

}  // namespace

TEST_CASE("a prepared recording has the bits of one that is cleaned while it plays", "[prepared]") {
    const TemporaryFolder folder;
    put_film(folder);
    const CleaningOptions cleaning = GENERATE(
        by(CleaningPreset::automatic), by(CleaningPreset::gentle), by(CleaningPreset::sensor),
        by(CleaningPreset::sensor, 3.0),
        CleaningOptions{
            .preset = CleaningPreset::own,
            .own = {.fill_holes = true, .sharpen_silhouettes = true, .colour_edges = true}});
    CHECK(prepared(folder, cleaning).frames == kFrames);
    Pair pair(folder, cleaning);

    SECTION("one frame after the other") {
        auto a = pair.prepared.at(0.0);
        auto b = pair.cleaned.at(0.0);
        CHECK(pair.prepared.prepared().found());
        CHECK(pair.prepared.whole_plan() == pair.cleaned.whole_plan());
        std::size_t frames = 0;
        for (; a && b; ++frames) {
            check_same(a, b);
            const double media_s = a->media_s;
            a = pair.prepared.after(media_s);
            b = pair.cleaned.after(media_s);
        }
        CHECK(a.has_value() == b.has_value());
        CHECK(frames == kFrames);
    }
    SECTION("in any order and a step back") {
        for (const double media_s : {1.2, 0.3, 1.9, 0.0, 1.0, 1.1})
            check_same(pair.prepared.at(media_s), pair.cleaned.at(media_s));
        check_same(pair.prepared.before(1.1), pair.cleaned.before(1.1));
        check_same(pair.prepared.before(1.0), pair.cleaned.before(1.0));
    }
    SECTION("frames that are left out") {
        for (const double earliest_s : {0.45, 0.55, 1.25, 1.85, 5.0}) {
            auto a = pair.prepared.at(0.1);
            auto b = pair.cleaned.at(0.1);
            for (int k = 0; k < 2; ++k) {  // the decoder goes ahead after two in a row
                a = pair.prepared.after(a->media_s);
                b = pair.cleaned.after(b->media_s);
            }
            check_same(pair.prepared.after(a->media_s, {.earliest_s = earliest_s}),
                       pair.cleaned.after(b->media_s, {.earliest_s = earliest_s}));
        }
    }
    CHECK(pair.prepared.prepared().trouble().empty());
}

TEST_CASE("frames whose depth is known come with their colour and no depth", "[prepared]") {
    const TemporaryFolder folder;
    put_film(folder);
    const auto whole = opened(folder, false);
    const auto known = opened(folder, false);
    std::vector<double> times;
    for (auto frame = whole->next(); frame; frame = whole->next()) times.push_back(frame->media_s);
    REQUIRE(times.size() == kFrames);
    known->leave_out_depth(std::make_shared<const std::vector<double>>(times));
    const auto check_next = [&] {
        const auto a = known->next();
        const auto b = whole->next();
        REQUIRE(a.has_value() == b.has_value());
        if (!a) return;
        CHECK(a->media_s == b->media_s);
        CHECK(a->index == b->index);
        CHECK(a->colour.rgb == b->colour.rgb);
        CHECK_FALSE(a->colour.rgb.empty());
        CHECK(a->depth_left_out);
        CHECK(a->depth.levels.empty());
    };
    for (const double media_s : {0.0, 1.7, 0.31, 1.2, 9.0}) {
        known->seek(media_s);
        whole->seek(media_s);
        for (int k = 0; k < 5; ++k) check_next();
    }
    SECTION("until the depth is wanted again") {
        known->leave_out_depth(nullptr);
        known->seek(0.5);
        const auto frame = known->next();
        REQUIRE(frame);
        CHECK_FALSE(frame->depth.levels.empty());
    }
}

TEST_CASE("depth that the colour is painted from is not left out", "[prepared]") {
    const TemporaryFolder folder;
    put_film(folder);
    const auto painted = open_media({}, folder / "film_depth.mkv");
    painted->leave_out_depth(std::make_shared<const std::vector<double>>(1, 0.0));
    painted->seek(0.0);
    const auto frame = painted->next();
    REQUIRE(frame);
    CHECK_FALSE(frame->depth_left_out);
    CHECK_FALSE(frame->depth.levels.empty());
}

TEST_CASE("a prepared frame needs at most one other", "[prepared]") {
    const TemporaryFolder folder;
    put_film(folder);
    const fs::path kept = prepared(folder, by(CleaningPreset::gentle)).folder;
    spoil(kept);
    PreparedReader reader(kept / "surface", {});
    std::size_t damaged = 0;
    for (const double media_s : *reader.times()) {
        Frame frame{.media_s = media_s};
        try {
            const bool filled = reader.fill(frame);
            CHECK(filled);
        } catch (const InputError&) {
            ++damaged;
        }
    }
    CHECK(damaged > 0);
    CHECK(damaged <= 2);  // the bytes may be of two neighbours
}

TEST_CASE("a prepared surface is found for its content and its cleaning only", "[prepared]") {
    const TemporaryFolder folder;
    put_film(folder);
    const CleaningOptions gentle = by(CleaningPreset::gentle);
    CHECK_FALSE(prepared(folder, gentle).was_kept);
    CHECK(prepared(folder, gentle).was_kept);
    const auto finds = [&](const CleaningOptions& cleaning) {
        return find_prepared(opened(folder)->description(), cleaning) != nullptr;
    };
    CHECK(finds(gentle));
    CHECK_FALSE(finds(by(CleaningPreset::sensor)));
    CHECK_FALSE(finds(by(CleaningPreset::gentle, 2.0)));

    SECTION("also of a file that was only touched") {
        fs::last_write_time(folder / "film_depth.mkv", fs::file_time_type::clock::now());
        CHECK(finds(gentle));
    }
    SECTION("not of a file that has changed") {
        ffmpeg("-f lavfi -i testsrc2=s=96x72:r=10:d=2,negate,format=gray -c:v ffv1 -y " +
               (folder / "film_depth.mkv").string());
        CHECK_FALSE(finds(gentle));
    }
    SECTION("a reader that changes its cleaning goes from one to the other and back") {
        Pair pair(folder, gentle);
        for (const CleaningOptions& cleaning :
             {gentle, by(CleaningPreset::sensor), gentle, by(CleaningPreset::raw)}) {
            pair.prepared.set_cleaning(cleaning);
            pair.cleaned.set_cleaning(cleaning);
            check_same(pair.prepared.at(0.5), pair.cleaned.at(0.5));
            CHECK(pair.prepared.prepared().found() == (cleaning == gentle));
            check_same(pair.prepared.after(0.5), pair.cleaned.after(0.5));
        }
    }
}

TEST_CASE("where a prepared surface is damaged the recording is cleaned and one sentence says so",
          "[prepared]") {
    const TemporaryFolder folder;
    put_film(folder);
    const CleaningOptions sensor = by(CleaningPreset::sensor);
    const fs::path kept = prepared(folder, sensor).folder;
    spoil(kept);
    Pair pair(folder, sensor);
    auto a = pair.prepared.at(0.0);
    auto b = pair.cleaned.at(0.0);
    CHECK(pair.prepared.prepared().found());
    for (std::size_t k = 0; k + 1 < kFrames; ++k) {
        check_same(a, b);
        a = pair.prepared.after(a->media_s);
        b = pair.cleaned.after(b->media_s);
    }
    check_same(a, b);
    CHECK_FALSE(pair.prepared.prepared().found());
    CHECK(contains(pair.prepared.prepared().trouble(), "is damaged"));

    SECTION("and it is made anew on request") {
        CHECK_FALSE(prepared(folder, sensor).was_kept);
        CHECK(find_prepared(opened(folder)->description(), sensor) != nullptr);
    }
}

TEST_CASE("what was used longest ago makes room for a new prepared surface", "[prepared]") {
    const TemporaryFolder folder;
    put_film(folder);
    const Prepared gentle = prepared(folder, by(CleaningPreset::gentle));
    const Prepared sensor = prepared(folder, by(CleaningPreset::sensor));
    const auto old = fs::file_time_type::clock::now() - std::chrono::hours(1);
    fs::last_write_time(gentle.folder / "lock", old - std::chrono::hours(1));
    fs::last_write_time(sensor.folder / "lock", old);
    CHECK(find_prepared(opened(folder)->description(), by(CleaningPreset::gentle)) != nullptr);
    const auto made = prepare(
        opened(folder),
        {.cache = folder / "cache", .cleaning = by(CleaningPreset::gentle, 3.0), .most_bytes = 1});
    REQUIRE(made);
    CHECK(made->removed == 2);
    const std::vector<KeptRecording> left = kept_recordings(folder / "cache");
    REQUIRE(left.size() == 1);
    CHECK(left.front().folder == made->folder);
    CHECK(left.front().is_current);
    CHECK(left.front().bytes == made->bytes);
    CHECK(forget_recording(left.front()));
    CHECK(kept_recordings(folder / "cache").empty());
}

TEST_CASE("preparing that is broken off keeps nothing", "[prepared]") {
    const TemporaryFolder folder;
    put_film(folder);
    int calls = 0;
    const auto made = prepare(opened(folder), {.cache = folder / "cache",
                                               .cleaning = by(CleaningPreset::gentle),
                                               .most_bytes = kRoom,
                                               .progress = [&](double share) {
                                                   CHECK(share > 0.0);
                                                   CHECK(share <= 1.0);
                                                   return ++calls < 5;
                                               }});
    CHECK_FALSE(made);
    CHECK(calls == 5);
    CHECK(kept_recordings(folder / "cache").empty());
}
