// Depth is told from what is not, by content alone; in doubt pictures are photographs.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/video/sources/media.hpp"
#include "core/video/sources/picture_kind.hpp"
#include "core/video/sources/readers.hpp"
#include "tests/core/video/clips.hpp"
#include "tests/core/video/coded_scene.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

PictureGuess guess(const cv::Mat& picture) {
    const std::array pictures{picture};
    return guess_kind(pictures);
}

cv::Mat in_grey(const cv::Mat& picture) {
    cv::Mat grey;
    cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    cv::cvtColor(grey, grey, cv::COLOR_GRAY2BGR);
    return grey;
}

/// As a sensor's.
cv::Mat with_noise(const cv::Mat& picture) {
    cv::Mat noise(picture.size(), CV_8UC1);
    cv::RNG(3).fill(noise, cv::RNG::UNIFORM, 0, 24);
    cv::cvtColor(noise, noise, cv::COLOR_GRAY2BGR);
    return picture + noise;
}

/// Things of any brightness, each of a rough material.
cv::Mat grey_photo() {
    constexpr int kThing_px = 12;
    cv::Mat things(20, 26, CV_8UC1);
    cv::RNG(5).fill(things, cv::RNG::UNIFORM, 20, 220);
    cv::Mat photo;
    cv::resize(things, photo, {}, kThing_px, kThing_px, cv::INTER_NEAREST);
    cv::cvtColor(photo, photo, cv::COLOR_GRAY2BGR);
    return with_noise(photo);
}

cv::Mat blurred(const cv::Mat& picture, double by) {
    cv::Mat soft;
    cv::GaussianBlur(picture, soft, {}, by);
    return soft;
}

cv::Mat sheet(int level) {
    return {kSceneRows, kSceneColumns, CV_8UC3, cv::Scalar(level, level, level)};
}

cv::Mat page_of_text(int ink, int paper) {
    cv::Mat page = sheet(paper);
    for (int line = 0; line < 12; ++line)
        cv::putText(page, "the quick brown fox jumps over it", {8, 20 + 18 * line},
                    cv::FONT_HERSHEY_SIMPLEX, 0.45, cv::Scalar(ink, ink, ink), 1, cv::LINE_AA);
    return page;
}

cv::Mat screenshot() {
    cv::Mat screen = sheet(236);
    cv::rectangle(screen, {0, 0, kSceneColumns, 18}, cv::Scalar(90, 60, 40), cv::FILLED);
    cv::rectangle(screen, {10, 30, 90, 190}, cv::Scalar(250, 250, 250), cv::FILLED);
    cv::rectangle(screen, {110, 30, 200, 190}, cv::Scalar(255, 255, 255), cv::FILLED);
    for (int k = 0; k < 10; ++k) {
        cv::putText(screen, "Item", {16, 48 + 17 * k}, cv::FONT_HERSHEY_PLAIN, 0.8,
                    cv::Scalar(40, 40, 40));
        cv::putText(screen, "a value, and another", {118, 48 + 17 * k}, cv::FONT_HERSHEY_PLAIN, 0.8,
                    cv::Scalar(70, 70, 70));
    }
    return screen;
}

cv::Mat diagram(bool coloured) {
    cv::Mat drawn = sheet(255);
    const cv::Scalar first = coloured ? cv::Scalar(200, 60, 30) : cv::Scalar(90, 90, 90);
    const cv::Scalar second = coloured ? cv::Scalar(40, 160, 250) : cv::Scalar(180, 180, 180);
    cv::line(drawn, {30, 210}, {300, 210}, cv::Scalar(0, 0, 0), 1, cv::LINE_AA);
    cv::line(drawn, {30, 210}, {30, 20}, cv::Scalar(0, 0, 0), 1, cv::LINE_AA);
    for (int k = 0; k < 6; ++k)
        cv::rectangle(drawn, {45 + 42 * k, 210 - 25 * k, 26, 25 * k + 1}, k % 2 ? first : second,
                      cv::FILLED);
    cv::circle(drawn, {90, 70}, 35, second, cv::FILLED, cv::LINE_AA);
    return drawn;
}

cv::Mat chessboard(int square) {
    cv::Mat board = sheet(20);
    for (int j = 0; j < kSceneRows; ++j)
        for (int i = 0; i < kSceneColumns; ++i)
            if ((i / square + j / square) % 2 == 0) board.at<cv::Vec3b>(j, i) = {230, 230, 230};
    return board;
}

cv::Mat grey_gradient() {
    cv::Mat gradient = sheet(0);
    for (int j = 0; j < kSceneRows; ++j)
        for (int i = 0; i < kSceneColumns; ++i)
            gradient.at<cv::Vec3b>(j, i) =
                cv::Vec3b::all(static_cast<std::uint8_t>(255 * i / (kSceneColumns - 1)));
    return gradient;
}

cv::Mat colour_wheel() {
    cv::Mat wheel(kSceneRows, kSceneColumns, CV_32FC3);
    for (int j = 0; j < kSceneRows; ++j) {
        for (int i = 0; i < kSceneColumns; ++i) {
            const float angle =
                cv::fastAtan2(static_cast<float>(j - 120), static_cast<float>(i - 160));
            const auto away = static_cast<float>(cv::norm(cv::Point(i - 160, j - 120)) / 120.0);
            wheel.at<cv::Vec3f>(j, i) =
                away > 1.0F ? cv::Vec3f(0, 0, 1) : cv::Vec3f(angle, away, 1);
        }
    }
    cv::cvtColor(wheel, wheel, cv::COLOR_HSV2BGR);
    wheel.convertTo(wheel, CV_8U, 255.0);
    return wheel;
}

cv::Mat white_noise(bool coloured) {
    cv::Mat noise(kSceneRows, kSceneColumns, CV_8UC3);
    cv::RNG random(5);
    random.fill(noise, cv::RNG::UNIFORM, 0, 256);
    return coloured ? noise : in_grey(noise);
}

cv::Mat landscape(bool coloured) {
    cv::Mat view = scene_photo();
    for (int j = 0; j < kSceneRows / 2; ++j)  // a bare sky over a rough ground
        view.row(j).setTo(cv::Scalar(250.0 - j / 4.0, 225.0 - j / 3.0, 200.0 - j / 2.0));
    return coloured ? view : in_grey(view);
}

/// Three pictures of each input, or as many as it has, by one run of ffmpeg.
void code(const std::vector<std::string>& inputs, const std::vector<std::string>& videos) {
    std::string arguments;
    for (const std::string& input : inputs) arguments += input + " ";
    for (std::size_t k = 0; k < videos.size(); ++k)
        arguments += "-map " + std::to_string(k) +
                     " -frames:v 3 -c:v libx264 -threads 1 -crf 20 -pix_fmt yuv420p '" + videos[k] +
                     "' ";
    ffmpeg(arguments);
}

struct Named {
    const char* name;
    cv::Mat picture;
};

std::vector<Named> no_depth() {
    const cv::Mat left = scene_photo();
    const cv::Mat right = scene_photo(9.0);
    return {
        {"photograph", left},
        {"black-and-white photograph", in_grey(left)},
        {"soft black-and-white photograph", blurred(in_grey(left), 2.0)},
        {"stereo pair", beside(left, right)},
        {"stereo pair, one above the other", above(left, right)},
        {"black-and-white stereo pair", in_grey(beside(left, right))},
        {"stereo pair, one eye grey", beside(left, in_grey(right))},
        {"photograph beside its grey copy", beside(left, in_grey(left))},
        {"photograph beside its soft grey copy", beside(left, blurred(in_grey(left), 3.0))},
        {"photograph beside its very soft grey copy", beside(left, blurred(in_grey(left), 6.0))},
        {"landscape", landscape(true)},
        {"black-and-white landscape", landscape(false)},
        {"text", page_of_text(10, 250)},
        {"light text on dark paper", page_of_text(230, 25)},
        {"photograph beside text", beside(left, page_of_text(10, 250))},
        {"screenshot", screenshot()},
        {"diagram", diagram(true)},
        {"grey diagram", diagram(false)},
        {"photograph beside a grey diagram", beside(left, diagram(false))},
        {"photograph beside a grey gradient", beside(left, grey_gradient())},
        {"chessboard", chessboard(24)},
        {"soft chessboard", blurred(chessboard(24), 2.0)},
        {"grey gradient", grey_gradient()},
        {"colour wheel", colour_wheel()},
        {"noise", white_noise(true)},
        {"grey noise", white_noise(false)},
        {"rough surface", in_grey(blurred(white_noise(false), 1.0))},
        {"black", sheet(0)},
        {"white", sheet(255)},
        {"painted depth",
         [] {
             cv::Mat levels;
             scene_depth().convertTo(levels, CV_8U, 255.0);
             cv::applyColorMap(levels, levels, cv::COLORMAP_VIRIDIS);
             return levels;
         }()},
        {"one hue", cv::Mat(kSceneRows, kSceneColumns, CV_8UC3, cv::Scalar(0, 255, 0))},
        {"photograph beside black", beside(left, sheet(0))},
        {"photograph beside the depth of another one", [&] {
             cv::Mat mirrored;
             cv::flip(painted(scene_depth(), as_grey), mirrored, 1);
             return beside(left, mirrored);
         }()}};
}

}  // namespace

TEST_CASE("photographs, stereo pairs, text and drawings are not taken for depth", "[kind]") {
    for (const Named& no : no_depth()) {
        const PictureGuess guessed = guess(no.picture);
        CAPTURE(no.name, static_cast<int>(guessed.kind), guessed.edges_agree,
                guessed.whole.brightness.texture, guessed.whole.brightness.slopes);
        CHECK(guessed.kind == PictureKind::photo);
    }
    CHECK(no_depth().size() >= 20);
}

TEST_CASE("what is no depth is not opened alone, and the line says what is missing", "[kind]") {
    const auto [ending, bits] = GENERATE(
        table<std::string, int>({{"png", 8}, {"png", 16}, {"jpg", 8}, {"tiff", 8}, {"mp4", 8}}));
    const TemporaryFolder folder;
    const auto number_of = [&](std::size_t k, const std::string& form) {
        return folder / (std::to_string(k) + "/IMG_0001." + form);
    };
    const std::vector<Named> all = no_depth();
    std::vector<std::string> stills, videos;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const auto still = number_of(k, ending == "mp4" ? "png" : ending);
        std::filesystem::create_directory(still.parent_path());
        cv::Mat picture;
        all[k].picture.convertTo(picture, bits == 16 ? CV_16U : CV_8U, bits == 16 ? 257.0 : 1.0);
        REQUIRE(cv::imwrite(still.string(), picture));
        stills.push_back("-i '" + still.string() + "'");
        videos.push_back(number_of(k, ending).string());
    }
    if (ending == "mp4") {
        code(stills, videos);
        for (std::size_t k = 0; k < all.size(); ++k) std::filesystem::remove(number_of(k, "png"));
    }
    for (std::size_t k = 0; k < all.size(); ++k) {
        const auto file = number_of(k, ending);
        CAPTURE(all[k].name, ending, bits);
        const std::string line = refusal([&] { (void)open_media(file, {}, {.find_out = true}); });
        CHECK(contains(line, "needs a depth file"));
        CHECK(contains(line, file.string()));
        CHECK(line.find('\n') == std::string::npos);
    }
}

TEST_CASE("test pictures are not taken for depth, also compressed", "[kind]") {
    const TemporaryFolder folder;
    const std::vector<std::string> names{"testsrc",    "testsrc2",   "smptebars", "smptehdbars",
                                         "rgbtestsrc", "mandelbrot", "cellauto",  "life",
                                         "gradients",  "pal100bars"};
    std::vector<std::string> sources, videos;
    for (const std::string& name : names) {
        sources.push_back("-f lavfi -i " + name);
        videos.push_back((folder / (name + ".mp4")).string());
    }
    code(sources, videos);
    for (const std::string& name : names) {
        const auto source = open_picture_source(folder / (name + ".mp4"), PictureRole::colour);
        std::vector<cv::Mat> pictures;
        while (auto taken = source->next()) pictures.push_back(taken->picture);
        REQUIRE(pictures.size() == 3);
        CAPTURE(name);
        CHECK(guess_kind(pictures).kind == PictureKind::photo);
    }
}

TEST_CASE("depth alone in a picture is told, with its code", "[kind]") {
    const cv::Mat depth = scene_depth();
    CHECK(guess(painted(depth, as_grey)).kind == PictureKind::grey_depth);
    CHECK(guess(painted(depth, as_hue)).kind == PictureKind::hue_depth);
    CHECK(guess(painted(depth, as_ramp)).kind == PictureKind::ramp_depth);
    cv::Mat inverse;
    cv::bitwise_not(painted(depth, as_grey), inverse);
    CHECK(guess(inverse).kind == PictureKind::grey_depth);
}

TEST_CASE("depth in the bytes of channels is told, and the same channels in disorder are not",
          "[kind]") {
    const cv::Mat depth = scene_depth();
    const auto [code, nearest, farthest] =
        GENERATE(table<DepthCode, double, double>({{DepthCode::rg16, 400.0, 6000.0},
                                                   {DepthCode::rg16, 0.0, 65535.0},
                                                   {DepthCode::rgb24, 8000.0, 900000.0},
                                                   {DepthCode::terrain, -40.0, 2500.0}}));
    CAPTURE(name_of(code), farthest);
    cv::Mat numbers;
    depth.convertTo(numbers, CV_32F, farthest - nearest, nearest);
    const cv::Mat picture = in_bytes(numbers, code);
    const PictureGuess guessed = guess(picture);
    CHECK(guessed.kind == PictureKind::byte_depth);
    CHECK(guessed.code == code);
    std::vector<cv::Mat> channels;
    cv::split(picture, channels);
    cv::flip(channels[1], channels[1], 1);
    cv::Mat mixed_up;
    cv::merge(channels, mixed_up);
    CHECK(guess(mixed_up).kind == PictureKind::photo);
}

TEST_CASE("colour and depth in halves are told, with packing and code", "[kind]") {
    const cv::Mat colour = scene_photo();
    const auto [code, paint] = GENERATE(table<DepthCode, cv::Vec3b (*)(float)>(
        {{DepthCode::grey, as_grey}, {DepthCode::hue, as_hue}}));
    const cv::Mat depth = painted(scene_depth(), paint);
    const auto [packing, picture] = GENERATE_COPY(
        table<DepthPacking, cv::Mat>({{DepthPacking::left_right, beside(colour, depth)},
                                      {DepthPacking::right_left, beside(depth, colour)},
                                      {DepthPacking::top_bottom, above(colour, depth)},
                                      {DepthPacking::bottom_top, above(depth, colour)}}));
    CAPTURE(name_of(code), name_of(packing));
    cv::Mat shown = picture;
    if (GENERATE(false, true))  // both halves squeezed
        cv::resize(picture, shown, {kSceneColumns, kSceneRows}, 0.0, 0.0, cv::INTER_AREA);
    const PictureGuess guessed = guess(shown);
    CAPTURE(guessed.edges_agree, guessed.edges_by_chance, guessed.depth_half.brightness.texture,
            guessed.depth_half.hue.slopes);
    CHECK(guessed.kind == PictureKind::packed);
    CHECK(guessed.packing == packing);
    CHECK(guessed.code == code);
}

TEST_CASE("depth alone of a packed picture is its half, as beside its colour", "[kind]") {
    const TemporaryFolder folder;
    const auto [code, paint] = GENERATE(table<DepthCode, cv::Vec3b (*)(float)>(
        {{DepthCode::grey, as_grey}, {DepthCode::hue, as_hue}}));
    CAPTURE(name_of(code));
    const cv::Mat depth = painted(scene_depth(), paint);
    const std::filesystem::path file = folder / "both.png";
    cv::imwrite(file.string(),
                GENERATE_COPY(beside(scene_photo(), depth), above(depth, scene_photo())));
    const DepthRequest request{.find_out = true};
    const std::unique_ptr<Media> alone = open_depth(file, request);
    const std::unique_ptr<Media> both = open_media(file, {}, request);
    const std::unique_ptr<Media> twice = open_media(file, file, request);
    CHECK(alone->description().depth_columns == kSceneColumns);
    CHECK(alone->description().depth_rows == kSceneRows);
    CHECK(alone->description().colour_columns == 0);
    REQUIRE(alone->description().meaning);
    REQUIRE(both->description().meaning);
    const DepthMeaning& meaning = *alone->description().meaning;
    CHECK(meaning.code.value == code);
    CHECK(meaning.packing.value == both->description().meaning->packing.value);
    const std::vector<float> levels = alone->next().value().depth.levels;
    const auto is_same = [](float a, float b) { return a == b || (a != a && b != b); };
    CHECK(std::ranges::equal(levels, both->next().value().depth.levels, is_same));
    CHECK(std::ranges::equal(levels, twice->next().value().depth.levels, is_same));
}

TEST_CASE("a packed picture that is said to be all depth is not split, given once or twice",
          "[kind]") {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "both.png";
    cv::imwrite(file.string(), beside(scene_photo(), painted(scene_depth(), as_grey)));
    DepthRequest request{.find_out = true};
    request.command_line.packing = DepthPacking::separate;
    request.command_line.code = DepthCode::grey;
    CHECK(open_depth(file, request)->description().depth_columns == 2 * kSceneColumns);
    CHECK(open_media(file, file, request)->description().depth_columns == 2 * kSceneColumns);
    request.command_line.packing.reset();
    CHECK(open_depth(file, request)->description().depth_columns == kSceneColumns);
}

TEST_CASE("depth is told in compressed video, too", "[kind]") {
    const TemporaryFolder folder;
    const cv::Mat depth = scene_depth();
    const auto [name, picture, kind] = GENERATE_COPY(table<const char*, cv::Mat, PictureKind>(
        {{"grey", painted(depth, as_grey), PictureKind::grey_depth},
         {"hue", painted(depth, as_hue), PictureKind::hue_depth},
         {"ramp", painted(depth, as_ramp), PictureKind::ramp_depth},
         {"packed", beside(scene_photo(), painted(depth, as_grey)), PictureKind::packed},
         {"packed hue", beside(painted(depth, as_hue), scene_photo()), PictureKind::packed}}));
    CAPTURE(name);
    cv::imwrite((folder / "still.png").string(), picture);
    ffmpeg("-loop 1 -i '" + (folder / "still.png").string() +
           "' -frames:v 2 -c:v libx264 -crf 23 -pix_fmt yuv420p '" +
           (folder / "clip.mp4").string() + "'");
    const auto source = open_picture_source(folder / "clip.mp4", PictureRole::colour);
    CHECK(guess(source->next()->picture).kind == kind);
}

TEST_CASE("another photograph of the scene is told from its depth", "[kind]") {
    const cv::Mat colour = scene_photo();
    const cv::Mat depth = painted(scene_depth(), as_grey);
    const cv::Mat noisy = with_noise(depth);
    cv::Mat steps = sheet(60);
    cv::rectangle(steps, {100, 60, 90, 120}, cv::Scalar::all(200), cv::FILLED);
    cv::Mat darker;
    in_grey(colour).convertTo(darker, CV_8U, 0.6, 30.0);
    CHECK(is_photo_of_scene(colour, in_grey(colour)));
    CHECK(is_photo_of_scene(colour, darker));
    CHECK(is_photo_of_scene(colour, in_grey(scene_photo(9.0))));
    CHECK(is_photo_of_scene(in_grey(colour), in_grey(scene_photo(9.0))));
    for (const cv::Mat& surface : {depth, noisy, steps, sheet(90), grey_gradient()})
        CHECK_FALSE(is_photo_of_scene(colour, surface));
    cv::Mat painting;
    cv::applyColorMap(noisy, painting, cv::COLORMAP_VIRIDIS);
    CHECK_FALSE(is_photo_of_scene(painting, noisy));
    CHECK_FALSE(is_photo_of_scene(colour, cv::Mat(8, 8, CV_8UC3, cv::Scalar::all(9))));
}

TEST_CASE("what is given as depth and is none is refused, unless a person calls it depth",
          "[kind]") {
    const TemporaryFolder folder;
    const cv::Mat colour = scene_photo();
    cv::Mat labels = sheet(20);
    cv::rectangle(labels, {100, 60, 90, 120}, cv::Scalar::all(80), cv::FILLED);
    cv::Mat mask = sheet(0);
    cv::rectangle(mask, {100, 60, 90, 120}, cv::Scalar::all(255), cv::FILLED);
    const auto [name, picture, words] = GENERATE_COPY(table<std::string, cv::Mat, std::string>(
        {{"cam1/14036.png", in_grey(scene_photo(9.0)), "photograph"},
         {"ir.png", in_grey(colour), "named as infrared"},
         {"semantic/0000.png", labels, "in a folder named as labels"},
         {"confidence/0000.png", white_noise(false), "in a folder named as confidence"},
         {"mask.png", mask, "named as a mask"},
         {"b.png", mask, "black and white"},
         {"frame_flow.png", painted(scene_depth(), as_grey), "named as optical flow"}}));
    CAPTURE(name);
    const auto file = folder / name;
    std::filesystem::create_directories(file.parent_path());
    REQUIRE(cv::imwrite((folder / "rgb.png").string(), colour));
    cv::Mat grey;
    cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    REQUIRE(cv::imwrite(file.string(), grey));
    DepthRequest request{.find_out = true};
    const auto open = [&] { return open_media(folder / "rgb.png", file, request); };
    const std::string line = refusal([&] { (void)open(); });
    CHECK(contains(line, words));
    CHECK(contains(line, file.string()));
    CHECK(contains(line, "--depth-code grey"));
    CHECK(line.find('\n') == std::string::npos);
    request.command_line.code = DepthCode::grey;
    CHECK(open()->description().depth_bits == 8);
}

TEST_CASE("grey depth is opened beside colour, whatever it is called", "[kind]") {
    const TemporaryFolder folder;
    cv::Mat steps = sheet(60);
    cv::rectangle(steps, {100, 60, 90, 120}, cv::Scalar::all(200), cv::FILLED);
    const cv::Mat noisy = with_noise(painted(scene_depth(), as_grey));
    const auto [name, picture] = GENERATE_COPY(
        table<std::string, cv::Mat>({{"b.png", painted(scene_depth(), as_grey)},
                                     {"b.png", steps},
                                     {"b.png", noisy},
                                     {"valid/0000.png", painted(scene_depth(), as_grey)},
                                     {"mask_depth.png", steps}}));
    CAPTURE(name);
    std::filesystem::create_directories((folder / name).parent_path());
    REQUIRE(cv::imwrite((folder / "a.png").string(), scene_photo()));
    cv::Mat grey;
    cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    REQUIRE(cv::imwrite((folder / name).string(), grey));
    const auto media = open_media(folder / "a.png", folder / name, {.find_out = true});
    CHECK(media->description().depth_bits == 8);
}

TEST_CASE("a photograph has fine structure and edges, noisy depth has fine structure alone",
          "[kind]") {
    const cv::Mat photo = grey_photo();
    CHECK(looks_like_photo(photo));
    CHECK_FALSE(looks_like_photo(photo(cv::Rect(0, 0, 60, 60))));
    const cv::Mat depth = painted(scene_depth(), as_grey);
    for (const cv::Mat& surface :
         {depth, with_noise(depth), with_noise(sheet(90)), grey_gradient(), sheet(0)})
        CHECK_FALSE(looks_like_photo(surface));
}

TEST_CASE("black and white alone are a mask's levels, with a third one they are not", "[kind]") {
    const auto [type, white] = GENERATE(table<int, double>({{CV_8U, 255.0}, {CV_16U, 65535.0}}));
    cv::Mat mask(60, 80, type, cv::Scalar(0.0));
    CHECK_FALSE(is_black_and_white(mask));
    mask(cv::Rect(20, 20, 30, 30)) = cv::Scalar(white);
    CHECK(is_black_and_white(mask));
    mask.row(3) = cv::Scalar(1.0);
    CHECK_FALSE(is_black_and_white(mask));
    CHECK_FALSE(is_black_and_white(cv::Mat(60, 80, CV_32F, cv::Scalar(1.0))));
    CHECK_FALSE(is_black_and_white(cv::Mat()));
}

TEST_CASE("what is named depth and looks like something else is asked about", "[kind]") {
    const TemporaryFolder folder;
    cv::Mat mask = sheet(0);
    cv::rectangle(mask, {100, 60, 90, 120}, cv::Scalar::all(255), cv::FILLED);
    const auto [name, picture, doubt] = GENERATE_COPY(table<std::string, cv::Mat, std::string>(
        {{"depth.png", grey_photo(), "looks like a photograph"},
         {"depth_0.png", mask, "black and white alone"},
         {"wall_height.png", grey_photo(), ""},
         {"depth.png", with_noise(painted(scene_depth(), as_grey)), ""}}));
    CAPTURE(name);
    const auto file = folder / name;
    cv::Mat grey;
    cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
    REQUIRE(cv::imwrite(file.string(), grey));
    DepthRequest request{.find_out = true};
    const MediaDescription media = describe_media(file, request);
    CHECK(contains(media.conclusion.doubt, doubt));
    CHECK(media.conclusion.doubt.empty() == doubt.empty());
    request.command_line.code = DepthCode::grey;
    CHECK(describe_media(file, request).conclusion.doubt.empty());
    if (doubt.empty()) return;
    CHECK(media.conclusion.alternatives.size() >= 2);
    CHECK(contains(doubt_about(media), "it may be no depth; near is assumed"));
    CHECK(contains(doubt_about(media), "or give the file of the depth"));
}

TEST_CASE("a grey picture and one of something else are refused as what they are", "[kind]") {
    const TemporaryFolder folder;
    const cv::Mat photo = scene_photo();
    cv::Mat painting;
    cv::applyColorMap(painted(scene_depth(), as_grey), painting, cv::COLORMAP_VIRIDIS);
    cv::Mat in_jet;
    cv::applyColorMap(painted(scene_depth(), as_grey), in_jet, cv::COLORMAP_JET);
    const auto [name, picture, words] = GENERATE_COPY(table<std::string, cv::Mat, std::string>(
        {{"cam0_000012.png", in_grey(photo), "is grey and does not look like depth"},
         {"frame_0001_normal.png", photo, "named as normals"},
         {"aachen_gtFine_labelIds.png", chessboard(24), "named as labels"},
         {"flow_occ/000000_10.png", photo, "in a folder named as optical flow"},
         {"disparities/alley_1/frame_0001.png", photo, "is a colour picture, not depth"},
         {"vis/depth_viridis.png", painting, "take its brightness by --depth-code grey"},
         {"vis/depth_jet.png", in_jet, "--depth-code grey would give a wrong relief"},
         {"thermal.png", painting, "give the numbers that it was painted from"},
         {"IMG_0001.png", photo,
          "is a colour picture without depth and needs a depth file beside it"}}));
    CAPTURE(name);
    const auto file = folder / name;
    std::filesystem::create_directories(file.parent_path());
    REQUIRE(cv::imwrite(file.string(), picture));
    DepthRequest request{.find_out = true};
    const auto open = [&] { return open_media(file, {}, request); };
    CHECK(contains(refusal([&] { (void)open(); }), words));
    request.command_line.code = DepthCode::grey;
    CHECK(open()->description().depth_bits == 8);
}

TEST_CASE("no pictures, tiny ones and ones of another type are photographs", "[kind]") {
    CHECK(guess_kind({}).kind == PictureKind::photo);
    CHECK(guess(cv::Mat()).kind == PictureKind::photo);
    CHECK(guess(cv::Mat(1, 1, CV_8UC3, cv::Scalar(1, 2, 3))).kind == PictureKind::photo);
    CHECK(guess(cv::Mat(1, 4000, CV_8UC3, cv::Scalar(1, 2, 3))).kind == PictureKind::photo);
    CHECK(guess(cv::Mat(17, 3001, CV_8UC3, cv::Scalar(1, 2, 3))).kind == PictureKind::photo);
    CHECK(guess(cv::Mat(40, 40, CV_8UC1, cv::Scalar(9))).kind == PictureKind::photo);
    CHECK(guess(cv::Mat(40, 40, CV_16UC3, cv::Scalar(9))).kind == PictureKind::photo);
}

TEST_CASE("pictures of several sizes are looked at one by one", "[kind]") {
    cv::Mat large;
    cv::resize(painted(scene_depth(), as_grey), large, {1280, 960}, 0.0, 0.0, cv::INTER_LINEAR);
    const std::vector<cv::Mat> pictures{painted(scene_depth(), as_grey), large};
    CHECK(guess_kind(pictures).kind == PictureKind::grey_depth);
}
