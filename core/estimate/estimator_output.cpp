// Sorts files by the numbers, words and endings of their names.
#include "core/estimate/estimator_output.hpp"

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/estimate/colour_frames.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/sources/media_names.hpp"
#include "core/video/sources/readers.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr int kPutLast = 100;
constexpr int kVideo = 20;  ///< comes after all pictures and arrays

/// Rank by the precision of a form: 0 is the finest.
int rank_of_form(const fs::path& file) {
    constexpr std::array<std::string_view, 7> kForms{".exr", ".pfm", ".npy", ".npz",
                                                     ".tif", ".png", ".pgm"};
    const std::string ending = lower_case(file.extension().string());
    const auto* const form = std::find(kForms.begin(), kForms.end(), ending);
    return static_cast<int>(form - kForms.begin());
}

/// Whether the name, or that of a folder above, is for something else than depth levels: colour,
/// also in the words of estimators for it, or other output.
bool names_other_content(const fs::path& relative) {
    constexpr std::array<std::string_view, 2> kInputs{"src", "input"};
    for (const fs::path& part : relative) {
        const std::string name = lower_case(part.string());
        const auto in_name = [&name](std::string_view word) {
            return name.find(word) != std::string::npos;
        };
        if (std::any_of(kInputs.begin(), kInputs.end(), in_name) || named_colour(part) ||
            !named_other(part).empty())
            return true;
    }
    return false;
}

int rank_of(const fs::path& folder, const fs::path& file) {
    const int form = named_video(file) ? kVideo + (named_depth(file) ? 0 : 1) : rank_of_form(file);
    return form + (names_other_content(file.lexically_relative(folder)) ? kPutLast : 0);
}

/// Without hidden files, which are still being written.
std::vector<fs::path> files_in(const fs::path& folder) {
    constexpr int kDeepest = 3;
    std::vector<fs::path> files;
    std::error_code failed;
    fs::recursive_directory_iterator entry(folder, failed);
    for (; !failed && entry != fs::recursive_directory_iterator(); entry.increment(failed)) {
        std::error_code gone;
        const bool hidden = entry->path().filename().string().starts_with('.');
        if (hidden || entry.depth() >= kDeepest) {
            entry.disable_recursion_pending();
            continue;
        }
        if (entry->is_regular_file(gone)) files.push_back(entry->path());
    }
    return files;
}

/// A number in a name, and the name without it.
struct NumberInName {
    std::size_t number{0};
    fs::path without{};
};

std::vector<NumberInName> numbers_in(const fs::path& file) {
    constexpr std::size_t kMostDigits = 9;
    const std::string name = file.filename().string();
    const std::size_t end = name.size() - file.extension().string().size();
    std::vector<NumberInName> numbers;
    for (std::size_t at = 0; at < end;) {
        std::size_t to = at;
        while (to < end && is_decimal_digit(name[to])) ++to;
        if (to > at && to - at <= kMostDigits) {
            const std::string around = name.substr(0, at) + "#" + name.substr(to);
            numbers.push_back({std::stoul(name.substr(at, to - at)), file.parent_path() / around});
        }
        at = std::max(to, at + 1);
    }
    return numbers;
}

/// Rows of pictures whose names differ in one number.
std::vector<NumberedOutputs> rows_in(const fs::path& folder) {
    std::map<fs::path, NumberedOutputs> rows;
    for (const fs::path& file : files_in(folder)) {
        if (!named_picture(file)) continue;
        for (const NumberInName& one : numbers_in(file)) rows[one.without][one.number] = file;
    }
    std::vector<NumberedOutputs> all;
    all.reserve(rows.size());
    for (auto& [name, row] : rows) all.push_back(std::move(row));
    std::stable_sort(all.begin(), all.end(), [&folder](const auto& a, const auto& b) {
        return rank_of(folder, a.begin()->second) < rank_of(folder, b.begin()->second);
    });
    return all;
}

/// Gives the pictures of a row in order. A picture that is unreadable or of another size throws.
class RowOfOutputs : public PictureSource {
  public:
    explicit RowOfOutputs(const NumberedOutputs& row) {
        for (const auto& [number, file] : row) files_.push_back(file);
        const StillFile first(files_.front(), PictureRole::depth);
        facts_ = first.facts();
        facts_.frames = static_cast<std::int64_t>(files_.size());
        facts_.frames_exact = true;
    }

    [[nodiscard]] const SourceFacts& facts() const override { return facts_; }

    std::optional<TimedPicture> next() override {
        if (at_ == files_.size()) return std::nullopt;
        const fs::path& file = files_[at_];
        StillFile still(file, PictureRole::depth);
        const cv::Mat picture = with_bits(still.next()->picture, still.facts().bits, facts_.bits);
        if (picture.cols != facts_.columns || picture.rows != facts_.rows)
            throw InputError(shown(file) + " has " + std::to_string(picture.cols) + " x " +
                             std::to_string(picture.rows) + " pixels, the first one " +
                             std::to_string(facts_.columns) + " x " + std::to_string(facts_.rows) +
                             ": let the estimator write all in one size");
        return TimedPicture{picture, 0.0, static_cast<std::int64_t>(at_++)};
    }

    void seek(double /*time_s*/) override { at_ = 0; }

  private:
    std::vector<fs::path> files_{};
    SourceFacts facts_{};
    std::size_t at_{0};
};

bool can_be_read(const fs::path& file) try {
    const StillFile whole(file, PictureRole::depth);
    return true;
} catch (const InputError&) {
    return false;
}

/// Whether a picture has colours; ignores slight tints by compression, in a few places.
bool has_colours(const cv::Mat& picture) {
    constexpr double kTint = 12.0;  // of 255
    constexpr double kFew = 0.005;  // of the pixels
    if (picture.channels() < 3) return false;
    cv::Mat channels;
    picture.convertTo(channels, CV_32F, picture.depth() == CV_16U ? 1.0 / 257.0 : 1.0);
    std::vector<cv::Mat> planes;
    cv::split(channels, planes);
    const cv::Mat tinted =
        (cv::abs(planes[0] - planes[1]) > kTint) | (cv::abs(planes[1] - planes[2]) > kTint);
    return cv::countNonZero(tinted) > kFew * static_cast<double>(picture.total());
}

}  // namespace

NumberedOutputs row_so_far(const fs::path& folder) {
    std::vector<NumberedOutputs> rows = rows_in(folder);
    std::size_t longest = 0;
    for (const NumberedOutputs& row : rows) longest = std::max(longest, row.size());
    const auto found = std::find_if(
        rows.begin(), rows.end(), [longest](const auto& row) { return row.size() + 1 >= longest; });
    return found == rows.end() ? NumberedOutputs{} : std::move(*found);
}

WholeOutputs whole_outputs(const fs::path& folder) {
    constexpr std::size_t kMayBeCut = 16;
    const NumberedOutputs row = row_so_far(folder);
    std::vector<std::pair<fs::file_time_type, std::size_t>> newest;
    WholeOutputs whole;
    for (const auto& [number, file] : row) {
        if (file.filename().string().find(frame_name(number)) == std::string::npos) return {};
        std::error_code gone;
        newest.emplace_back(fs::last_write_time(file, gone), number);
        whole.numbers.insert(number);
    }
    std::sort(newest.rbegin(), newest.rend());
    if (newest.size() > kMayBeCut) newest.resize(kMayBeCut);
    for (const auto& [time, number] : newest) {
        if (can_be_read(row.at(number))) continue;
        std::error_code gone;
        fs::remove(row.at(number), gone);
        whole.numbers.erase(number);
        whole.removed.push_back(row.at(number));
    }
    return whole;
}

std::unique_ptr<PictureSource> DepthOutput::open() const {
    if (!row_.empty()) return std::make_unique<RowOfOutputs>(row_);
    return open_picture_source(file_, PictureRole::depth);
}

bool DepthOutput::is_painted() const {
    const bool levels_alone = named_video(file());  // whose luma is read as depth
    if (!levels_alone) return has_colours(open()->next().value_or(TimedPicture{}).picture);
    const auto seen = open_picture_source(file_, PictureRole::colour)->next();
    return seen && has_colours(seen->picture);
}

std::vector<DepthOutput> depth_outputs(const fs::path& folder) {
    std::vector<DepthOutput> outputs;
    for (NumberedOutputs& row : rows_in(folder)) {
        if (row.size() > 1) outputs.emplace_back(std::move(row));
    }
    for (const fs::path& file : files_in(folder)) {
        if (named_video(file) || named_picture(file)) outputs.emplace_back(file);
    }
    std::stable_sort(outputs.begin(), outputs.end(), [&folder](const auto& a, const auto& b) {
        return rank_of(folder, a.file()) < rank_of(folder, b.file());
    });
    return outputs;
}

}  // namespace dibhr
