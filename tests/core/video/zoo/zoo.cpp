// What functions of several forms need.
#include "tests/core/video/zoo/zoo.hpp"

namespace dibhr::test::zoo {

Truth truth_of(const cv::Mat& farness, Knows knows, Measure measure) {
    Truth truth;
    truth.farness = {farness};
    truth.knows = knows;
    truth.measure = measure;
    return truth;
}

Truth truth_of(const Film& film, Knows knows) {
    Truth truth;
    truth.farness = film.farness;
    truth.colour = film.colour;
    truth.knows = knows;
    return truth;
}

Brought brought_of(const fs::path& place, const cv::Mat& farness, const cv::Mat& colour,
                   Knows knows) {
    Brought brought{place, {}, truth_of(farness, knows)};
    brought.truth.colour = {colour};
    return brought;
}

std::vector<double> even_times(std::size_t frames, double frames_per_s) {
    std::vector<double> times_s;
    for (std::size_t k = 0; k < frames; ++k)
        times_s.push_back(static_cast<double>(k) / frames_per_s);
    return times_s;
}

Brought rows_in(const fs::path& folder, const Rows& rows) {
    Film film = film_of(rows.place, kRowFrames);
    if (rows.holes) film.farness = each(film.farness, with_hole);
    film.farness = each(film.farness, [&](const cv::Mat& far) { return cv::Mat(far * rows.size); });
    for (std::size_t k = 0; k < film.farness.size(); ++k) {
        const int number = rows.first + rows.step * static_cast<int>(k);
        save(folder / numbered_name(rows.depth, number),
             in_16_bits(film.farness[k], rows.levels_per_m, rows.none));
        if (!rows.colour.empty()) save(folder / numbered_name(rows.colour, number), film.colour[k]);
    }
    if (rows.colour.empty()) film.colour.clear();
    Brought brought{folder, {}, truth_of(film, rows.knows)};
    brought.truth.sky = rows.place == Place::street;
    return brought;
}

}  // namespace dibhr::test::zoo
