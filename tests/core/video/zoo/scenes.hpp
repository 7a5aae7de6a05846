// Places whose every distance is known, as a camera sees them: what the zoo's files hold.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace dibhr::test::zoo {

/// A room is near below and far above. Of a corridor and an organ the middle is far, of terrain it
/// is low: who guesses from middle and floor takes them inside out.
enum class Place { room, corridor, street, portrait, organ, terrain, gel };

inline const cv::Size kView{128, 96};

/// One frame of a place. Farness, CV_32FC1: metres from the camera's plane; of terrain metres
/// below, and of gel millimetres below, a level above all. NaN: the sky.
struct View {
    cv::Mat farness{};
    cv::Mat colour{};  ///< BGR
};

/// Frames in a row; in each of them something has moved on, from one side to the other.
struct Film {
    std::vector<cv::Mat> farness{};
    std::vector<cv::Mat> colour{};
};

/// `moment`, from 0 to 1: how far the moving thing has come.
[[nodiscard]] View view_of(Place place, double moment = 0.3, cv::Size size = kView);
[[nodiscard]] Film film_of(Place place, int frames, cv::Size size = kView);

/// Without data in a rectangle, as where a sensor sees a window.
[[nodiscard]] cv::Mat with_hole(const cv::Mat& farness);
/// With data at that share of the pixels only, at random, as from a LiDAR.
[[nodiscard]] cv::Mat thinned(const cv::Mat& farness, double share);

}  // namespace dibhr::test::zoo
