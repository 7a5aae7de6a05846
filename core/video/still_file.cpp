// A still image as a source of one picture.
#include "core/video/still_file.hpp"

#include <algorithm>
#include <cctype>
#include <string>

#include "core/video/input_file.hpp"
#include "core/video/pictures.hpp"

namespace dibhr {

StillFile::StillFile(const std::filesystem::path& file, PictureRole role)
    : picture_(role == PictureRole::depth ? read_picture_unchanged(file)
                                          : read_colour_picture(file)) {
    facts_.file = file;
    facts_.columns = picture_.cols;
    facts_.rows = picture_.rows;
    facts_.bits = picture_.depth() == CV_16U ? 16 : 8;
    facts_.channels = picture_.channels();
    facts_.codec = file.extension().string();
    if (!facts_.codec.empty()) facts_.codec.erase(0, 1);
    std::transform(facts_.codec.begin(), facts_.codec.end(), facts_.codec.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    facts_.frames = 1;
    facts_.frames_exact = true;
    facts_.still = true;
    require_size(file, facts_.columns, facts_.rows);
}

std::optional<TimedPicture> StillFile::next() {
    if (given_) return std::nullopt;
    given_ = true;
    return TimedPicture{picture_, 0.0, 0};
}

void StillFile::seek(double /*time_s*/) {
    given_ = false;
}

}  // namespace dibhr
