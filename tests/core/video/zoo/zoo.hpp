// The zoo: forms that people bring depth in, each with a function that writes its files and says
// what is true of them.
#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "tests/core/video/zoo/scenes.hpp"
#include "tests/core/video/zoo/zoo_files.hpp"

namespace dibhr::test::zoo {

/// What the files let one know without asking: which pixels are nearer; also the shape, of unknown
/// size; also the distances.
enum class Knows { order, shape, metric };

/// What a farness of the truth is: metres from the camera, a height below something, or a number
/// without a unit.
enum class Measure { metres, height, relative };

struct Truth {
    Pictures farness{};  ///< of each depth frame; NaN: no data
    Pictures colour{};   ///< of each colour frame, BGR; empty: the files hold none
    /// Since the first depth frame; empty: the files do not say it.
    std::vector<double> times_s{};
    std::vector<double> colour_times_s{};
    Knows knows{Knows::order};
    Measure measure{Measure::metres};
    cv::Mat between{};         ///< of sparse depth the whole surface, felt between its pixels, too
    bool sky{false};           ///< or may be the farthest
    std::string refused_as{};  ///< a word of the right refusal; empty: refusing is not right
};

/// Files as their owner opens them.
struct Brought {
    fs::path place{};
    fs::path depth{};  ///< a second place; mostly empty
    Truth truth{};
};

struct Form {
    std::string name{};
    std::function<Brought(const fs::path& folder)> bring{};
};
using Forms = std::vector<Form>;

[[nodiscard]] Forms forms_of_datasets();
[[nodiscard]] Forms forms_of_devices();
[[nodiscard]] Forms forms_of_estimators();
[[nodiscard]] Forms forms_of_numbers();
[[nodiscard]] Forms forms_of_heights();
[[nodiscard]] Forms forms_of_videos();

// For the functions of forms.

/// One picture, without colour.
[[nodiscard]] Truth truth_of(const cv::Mat& farness, Knows knows = Knows::order,
                             Measure measure = Measure::metres);
[[nodiscard]] Truth truth_of(const Film& film, Knows knows = Knows::order);
/// A depth picture and its colour.
[[nodiscard]] Brought brought_of(const fs::path& place, const cv::Mat& farness,
                                 const cv::Mat& colour, Knows knows = Knows::order);
/// Times of so many frames, 0 first.
[[nodiscard]] std::vector<double> even_times(std::size_t frames, double frames_per_s);

/// Pictures of depth in 16 bits, one a frame, with pictures of colour.
struct Rows {
    std::string colour{};  ///< name with # for the number
    std::string depth{};
    double levels_per_m{1000.0};
    Place place{Place::room};
    Knows knows{Knows::metric};
    int first{0};
    int step{1};
    bool holes{true};
    int none{0};       ///< level of no data
    double size{1.0};  ///< how many times as large the place is
};
inline constexpr int kRowFrames = 5;
/// Writes them; the owner opens the folder.
[[nodiscard]] Brought rows_in(const fs::path& folder, const Rows& rows);

}  // namespace dibhr::test::zoo
