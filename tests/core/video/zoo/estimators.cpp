// What programs that estimate depth from a photograph or a video write.
#include <cstddef>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "tests/core/video/coded_scene.hpp"
#include "tests/core/video/zoo/zoo.hpp"

namespace dibhr::test::zoo {

namespace {

/// Estimated nearness has no unit; its order is right.
Truth estimated(const cv::Mat& farness) {
    return truth_of(farness, Knows::order, Measure::relative);
}

Brought estimated_of(const fs::path& place, const View& view) {
    Brought brought{place, {}, estimated(view.farness)};
    brought.truth.colour = {view.colour};
    return brought;
}

cv::Mat in_16_bits_of_1(const cv::Mat& parts) {
    cv::Mat levels;
    parts.convertTo(levels, CV_16U, 65535.0);
    return levels;
}

/// Bright is near, in a folder of its own under the photograph's name.
Brought depth_anything(const fs::path& folder) {
    const View view = view_of(Place::portrait);
    save(folder / "photo.jpg", view.colour);
    save(folder / "vis_depth/photo.png", in_8_bits(nearness_of(view.farness)));
    Brought brought = estimated_of(folder / "photo.jpg", view);
    brought.depth = folder / "vis_depth/photo.png";
    return brought;
}

/// Its usual output: the photograph, a white gap, the depth in one picture.
Brought depth_anything_beside(const fs::path& folder) {
    const View view = view_of(Place::portrait);
    cv::Mat grey;
    cv::cvtColor(in_8_bits(nearness_of(view.farness)), grey, cv::COLOR_GRAY2BGR);
    const cv::Mat gap(kView.height, 50, CV_8UC3, cv::Scalar::all(255.0));
    save(folder / "photo.png", beside(beside(view.colour, gap), grey));
    return estimated_of(folder / "photo.png", view);
}

/// Painted in the colours of a map: no brightness of these is depth.
Brought painted_depth(const fs::path& folder, int colours) {
    const View view = view_of(Place::room);
    cv::Mat map;
    cv::applyColorMap(in_8_bits(nearness_of(view.farness)), map, colours);
    save(folder / "photo_depth.png", map);
    Brought brought{folder / "photo_depth.png", {}, estimated(view.farness)};
    brought.truth.refused_as = "colours";
    return brought;
}

Brought midas_png(const fs::path& folder) {
    const View view = view_of(Place::corridor);
    save(folder / "photo-dpt_large_384.png", in_16_bits_of_1(disparity_of(view.farness, 1.0)));
    return {folder / "photo-dpt_large_384.png", {}, estimated(view.farness)};
}

Brought midas_pfm(const fs::path& folder) {
    const View view = view_of(Place::room);
    save_pfm(folder / "photo-dpt_large_384.pfm", disparity_of(view.farness, 3100.0));
    return {folder / "photo-dpt_large_384.pfm", {}, estimated(view.farness)};
}

/// Metres times 256.
Brought zoe_depth(const fs::path& folder) {
    const View view = view_of(Place::room);
    save(folder / "photo_depth.png", in_16_bits(view.farness, 256.0));
    save(folder / "photo.jpg", view.colour);
    return brought_of(folder / "photo.jpg", view.farness, view.colour);
}

/// From 0, near, to 1, as numbers and as 16 bits, and painted; each in a folder.
Brought marigold(const fs::path& folder, const std::string& opened) {
    const View view = view_of(Place::room);
    const cv::Mat parts = 1.0 - nearness_of(view.farness);
    cv::Mat map;
    cv::applyColorMap(in_8_bits(parts), map, cv::COLORMAP_RAINBOW);
    save_npy(folder / "depth_npy/photo_pred.npy", parts);
    save(folder / "depth_bw/photo_pred.png", in_16_bits_of_1(parts));
    save(folder / "depth_colored/photo_pred_colored.png", map);
    return {folder / opened, {}, estimated(view.farness)};
}

/// Metres, and a picture painted of them under the same name.
Brought depth_pro(const fs::path& folder) {
    const View view = view_of(Place::portrait);
    cv::Mat map;
    cv::applyColorMap(in_8_bits(nearness_of(view.farness)), map, cv::COLORMAP_JET);
    save_npz(folder / "photo.npz", {{"depth", npy_of({view.farness})}});
    save(folder / "photo.jpg", map);
    return {folder, {}, truth_of(view.farness)};
}

/// The same of numpy's plain form.
Brought numbers_beside_painting(const fs::path& folder) {
    const View view = view_of(Place::room);
    cv::Mat map;
    cv::applyColorMap(in_8_bits(nearness_of(view.farness)), map, cv::COLORMAP_JET);
    save_npy(folder / "photo.npy", view.farness);
    save(folder / "photo.png", map);
    return {folder, {}, truth_of(view.farness)};
}

/// Relative values of any offset and sign, near is large.
Brought offset_values(const fs::path& folder) {
    const View view = view_of(Place::room);
    const cv::Mat values = nearness_of(view.farness) * 900.0 - 40.0;
    save_npy(folder / "photo_depth.npy", values);
    return {
        folder / "photo_depth.npy", {}, truth_of(view.farness, Knows::shape, Measure::relative)};
}

/// Arrays [frames, rows, columns]: relative, near is large, or metres.
Brought video_depth_anything(const fs::path& folder, bool metric) {
    const Film film = film_of(Place::room, 8);
    const Pictures depths = metric ? film.farness : each(film.farness, [](const cv::Mat& farness) {
        return disparity_of(farness, 14.0);
    });
    save_npz(folder / "clip_depths.npz", {{"depths", npy_of(depths)}});
    Brought brought{folder / "clip_depths.npz", {}, truth_of(film)};
    brought.truth.colour.clear();
    if (!metric) brought.truth.measure = Measure::relative;
    return brought;
}

/// The folder that the program leaves, with the video that it was given, and a painting.
Brought video_depth_anything_folder(const fs::path& folder) {
    Brought brought = video_depth_anything(folder, false);
    const Film film = film_of(Place::room, 8);
    const Pictures painted = each(film.farness, [](const cv::Mat& farness) {
        cv::Mat map;
        cv::applyColorMap(in_8_bits(nearness_of(farness)), map, cv::COLORMAP_INFERNO);
        return map;
    });
    save_video(folder / "clip_src.mp4", {{film.colour, 10.0, kGoodH264}});
    save_video(folder / "clip_vis.mp4", {{painted, 10.0, kGoodH264}});
    brought.place = folder;
    brought.truth.colour = film.colour;
    for (std::size_t k = 0; k < film.farness.size(); ++k)
        brought.truth.times_s.push_back(0.1 * static_cast<double>(k));
    brought.truth.colour_times_s = brought.truth.times_s;
    return brought;
}

Brought estimated_video(const fs::path& folder) {
    const Film film = film_of(Place::portrait, 20);
    const Pictures grey =
        each(film.farness, [](const cv::Mat& farness) { return in_8_bits(nearness_of(farness)); });
    save_video(folder / "clip.mp4", {{film.colour, 25.0, kGoodH264}});
    save_video(folder / "clip_depth.mp4", {{grey, 25.0, kGoodH264}});
    Brought brought{folder / "clip.mp4", {}, truth_of(film)};
    brought.truth.measure = Measure::relative;
    brought.truth.times_s = brought.truth.colour_times_s = even_times(film.farness.size(), 25.0);
    return brought;
}

/// Predictions of several views: depth [1, views, rows, columns, 1], images [1, views, 3, ...].
Brought several_views(const fs::path& folder) {
    const Film film = film_of(Place::room, 3);
    const Pictures planes = each(film.colour, [](const cv::Mat& colour) {
        Pictures channels;
        cv::split(colour, channels);
        cv::Mat all;
        cv::vconcat(Pictures{channels[2], channels[1], channels[0]}, all);
        all.convertTo(all, CV_32F, 1.0 / 255.0);
        return all;
    });
    save_npz(folder / "predictions.npz", {{"depth", npy_of(film.farness, "(1, 3, 96, 128, 1)")},
                                          {"images", npy_of(planes, "(1, 3, 3, 96, 128)")}});
    Brought brought{folder / "predictions.npz", {}, truth_of(film)};
    brought.truth.refused_as = "shape";
    return brought;
}

}  // namespace

Forms forms_of_estimators() {
    return {{"Depth Anything", depth_anything},
            {"Depth Anything, photo and depth in one", depth_anything_beside},
            {"painted in jet",
             [](const fs::path& folder) { return painted_depth(folder, cv::COLORMAP_JET); }},
            {"painted in inferno",
             [](const fs::path& folder) { return painted_depth(folder, cv::COLORMAP_INFERNO); }},
            {"MiDaS, PNG", midas_png},
            {"MiDaS, PFM", midas_pfm},
            {"ZoeDepth", zoe_depth},
            {"Marigold, npy",
             [](const fs::path& folder) { return marigold(folder, "depth_npy/photo_pred.npy"); }},
            {"Marigold, PNG",
             [](const fs::path& folder) { return marigold(folder, "depth_bw/photo_pred.png"); }},
            {"Depth Pro", depth_pro},
            {"npy beside its painting", numbers_beside_painting},
            {"relative values with negative ones", offset_values},
            {"Video Depth Anything",
             [](const fs::path& folder) { return video_depth_anything(folder, false); }},
            {"Video Depth Anything, its folder", video_depth_anything_folder},
            {"Video Depth Anything, metric",
             [](const fs::path& folder) { return video_depth_anything(folder, true); }},
            {"estimated video", estimated_video},
            {"predictions of several views", several_views}};
}

}  // namespace dibhr::test::zoo
