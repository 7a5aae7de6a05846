// Checks the table and the label pictures against each other and against the depth, and writes
// both.
#include "core/video/guide/regions_file.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/text_file.hpp"
#include "core/video/sources/beside_recording.hpp"
#include "core/video/sources/picture_files.hpp"
#include "core/video/sources/readers.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr double kMostPictures_per_s = 1000.0;
/// A label picture may be so much wider or higher than the depth.
constexpr double kAspectTolerance = 0.03;

/// A pixel of a label picture: its level, or its colour as 0xRRGGBB.
using Mark = std::uint32_t;

/// The regions of the table, and what marks the pixels of each.
struct Table {
    Regions regions{};
    std::map<Mark, std::uint8_t> labels{};  ///< of levels
    std::map<Mark, std::uint8_t> colours{};
};

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
    throw InputError(shown(file) + ": " + what);
}

std::optional<Mark> colour_in(std::string_view text) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    if (text.size() != 7 || text.front() != '#') return std::nullopt;
    Mark mark = 0;
    for (const char c : lower_case(std::string(text.substr(1)))) {
        const std::size_t digit = kDigits.find(c);
        if (digit == std::string_view::npos) return std::nullopt;
        mark = mark * 16 + static_cast<Mark>(digit);
    }
    return mark;
}

void take_region(const toml::table& said, const fs::path& file, Table& table) {
    std::vector<Region>& regions = table.regions.regions;
    const std::string name = one_line(said["name"].value_or(std::string()), kMostRegionName);
    const std::string text = one_line(said["text"].value_or(std::string()), kMostRegionText);
    const std::string which = name.empty() ? "region " + std::to_string(regions.size() + 1)
                                           : "the region " + in_quotes(name);
    if (name.empty()) refuse(file, which + " has no name; give it one");
    const auto level = said["level"].value<std::int64_t>();
    const auto colour = colour_in(said["colour"].value_or(std::string_view()));
    const bool level_fits = level && *level > 0 && *level <= 65535;
    if (!level_fits && !colour)
        refuse(file, which +
                         " has neither a level from 1 to 65535 nor a colour like \"#d08030\"; give "
                         "it the one it has in the picture");
    const auto label = static_cast<std::uint8_t>(regions.size() + 1);
    const bool is_new = colour ? table.colours.emplace(*colour, label).second
                               : table.labels.emplace(static_cast<Mark>(*level), label).second;
    if (!is_new) refuse(file, which + " has the level or colour of another; give each its own");
    regions.push_back({name, text});
}

Table table_of(const fs::path& file) try {
    const auto text = small_text_in(file);
    if (!text) refuse(file, "cannot be read as text of up to 1 MB; make it readable");
    const toml::table said = toml::parse(*text, file.string());
    Table table;
    const toml::array* const list = said["region"].as_array();
    if (list == nullptr || list->empty() || list->size() > Regions::kMost)
        refuse(file, "has no region, or more than 255; write [[region]], name and level for each");
    for (const toml::node& node : *list) {
        const toml::table* const region = node.as_table();
        if (region == nullptr) refuse(file, "region is no table; write [[region]] for each");
        take_region(*region, file, table);
    }
    const auto pictures = said["labels"]["pictures"].value_or(std::int64_t{1});
    const double rate = said["labels"]["per-second"].value_or(0.0);
    if (pictures < 1 || pictures > 100'000 || !(rate >= 0.0 && rate <= kMostPictures_per_s) ||
        (pictures > 1 && !(rate > 0.0)))
        refuse(file,
               "labels.pictures is not 1 to 100000, or per-second not above 0; say how many label "
               "pictures stand one below the other, and how many of them a second");
    table.regions.pictures = static_cast<int>(pictures);
    table.regions.pictures_per_s = rate;
    return table;
} catch (const toml::parse_error& error) {
    refuse(file, "line " + std::to_string(error.source().begin.line) + " cannot be understood (" +
                     one_line(error.description(), 200) + "); correct or remove it");
}

/// Pixels as marks: a level of one channel, or a colour. Alpha counts as none below half.
class Labels {
  public:
    Labels(const cv::Mat& picture, const Table& table) : picture_(picture), table_(table) {
        of_level_.resize(picture.depth() == CV_8U ? 256 : 65536);
        for (Mark level = 0; level < of_level_.size(); ++level)
            of_level_[level] = find_level(level);
    }

    [[nodiscard]] std::uint8_t at(int j, int i) const {
        const int channels = picture_.channels();
        if (channels == 1) return of_level_[channel(j, i, 0)];
        if (channels == 4 && channel(j, i, 3) < half()) return 0;
        const std::array<Mark, 3> bgr{channel(j, i, 0), channel(j, i, 1), channel(j, i, 2)};
        const auto found = table_.colours.find((bgr[2] << 16U) | (bgr[1] << 8U) | bgr[0]);
        if (found != table_.colours.end()) return found->second;
        return bgr[0] == bgr[1] && bgr[1] == bgr[2] ? of_level_[bgr[0]] : std::uint8_t{0};
    }

  private:
    [[nodiscard]] Mark channel(int j, int i, int c) const {
        const int at = i * picture_.channels() + c;
        return picture_.depth() == CV_8U ? Mark{picture_.ptr<std::uint8_t>(j)[at]}
                                         : Mark{picture_.ptr<std::uint16_t>(j)[at]};
    }
    [[nodiscard]] Mark half() const { return picture_.depth() == CV_8U ? 128 : 32768; }
    [[nodiscard]] std::uint8_t find_level(Mark level) const {
        const auto found = table_.labels.find(level);
        if (found != table_.labels.end()) return found->second;
        const auto grey = table_.colours.find(level * 0x010101U);  // "#141414" of a grey picture
        return grey == table_.colours.end() || level > 255 ? std::uint8_t{0} : grey->second;
    }

    const cv::Mat& picture_;
    const Table& table_;
    std::vector<std::uint8_t> of_level_{};
};

/// Throws InputError for a picture that does not fit the depth.
void require_fit(const cv::Mat& picture, const Table& table, const fs::path& file, int columns,
                 int rows) {
    const int pictures = table.regions.pictures;
    const bool has_marks = picture.depth() == CV_8U || picture.depth() == CV_16U;
    if (picture.empty() || !has_marks || picture.channels() == 2)
        refuse(file, "a label picture has 8 or 16 bits a pixel; save it as such a PNG");
    if (picture.rows % pictures != 0)
        refuse(file, "its " + std::to_string(picture.rows) + " rows are not " +
                         std::to_string(pictures) + " pictures; correct labels.pictures");
    const double aspect = static_cast<double>(picture.cols) * pictures / picture.rows;
    if (std::abs(aspect * rows / columns - 1.0) > kAspectTolerance)
        refuse(file, "a label picture must be as wide to its height as the depth, " +
                         std::to_string(columns) + " x " + std::to_string(rows) +
                         "; save it in that shape");
}

/// The level of a label in the picture: so far apart that they are seen, where there is room.
int level_of(std::size_t label, std::size_t regions) {
    constexpr std::size_t kApart = 20;
    return static_cast<int>(regions * kApart <= 255 ? label * kApart : label);
}

/// In quotes, as TOML reads it.
std::string toml_text(const std::string& text) {
    std::ostringstream out;
    out << toml::value<std::string>(text);
    return out.str();
}

std::string table_text(const Regions& regions) {
    std::ostringstream out;
    out << "# The regions of the picture beside this file: the level of each in it, its name, and "
           "what is said of it.\n";
    if (regions.pictures > 1)
        out << "\n[labels]\npictures = " << regions.pictures
            << "\nper-second = " << toml::value<double>(regions.pictures_per_s) << "\n";
    for (std::size_t k = 0; k < regions.regions.size(); ++k) {
        const Region& region = regions.regions[k];
        out << "\n[[region]]\nlevel = " << level_of(k + 1, regions.regions.size())
            << "\nname = " << toml_text(region.name) << "\n";
        if (!region.text.empty()) out << "text = " << toml_text(region.text) << "\n";
    }
    return out.str();
}

/// Nothing: there is no such file.
std::optional<std::string> bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(in), {});
}

void remove_file(const fs::path& file) {
    std::error_code failed;
    fs::remove(file, failed);
    if (failed) refuse(file, "cannot be removed (" + failed.message() + "); remove it yourself");
}

}  // namespace

std::shared_ptr<const Regions> read_regions(const fs::path& depth, int columns, int rows) {
    if (depth.empty()) return nullptr;
    const fs::path names = beside_recording(depth, "_regions.toml");
    if (!is_file(names)) return nullptr;
    const fs::path file = fs::path(names).replace_extension(".png");
    if (!is_file(file)) refuse(file, "is missing; " + shown(names) + " names its regions");
    Table table = table_of(names);
    const cv::Mat picture = read_still(file, PictureRole::depth).picture;
    require_fit(picture, table, file, columns, rows);
    Regions& regions = table.regions;
    regions.columns = picture.cols;
    regions.rows = picture.rows / regions.pictures;
    regions.labels.resize(picture.total());
    const Labels labels(picture, table);
    auto to = regions.labels.begin();
    for (int j = 0; j < picture.rows; ++j)
        for (int i = 0; i < picture.cols; ++i) *to++ = labels.at(j, i);
    return std::make_shared<const Regions>(std::move(regions));
}

void write_regions(const Regions* regions, const fs::path& depth) {
    const fs::path names = beside_recording(depth, "_regions.toml");
    const fs::path file = fs::path(names).replace_extension(".png");
    if (regions == nullptr) {
        remove_file(names);
        remove_file(file);
        return;
    }
    if (is_file(file) && !is_file(names))
        refuse(file, "is there without a table of regions; move it away, then paint again");
    std::vector<std::uint8_t> levels(regions->labels.size());
    std::ranges::transform(regions->labels, levels.begin(), [&](std::uint8_t label) {
        return static_cast<std::uint8_t>(level_of(label, regions->regions.size()));
    });
    const std::optional<std::string> before = bytes_of(file);
    write_file(file, png_of(levels, regions->columns, regions->rows * regions->pictures));
    try {
        write_file(names, table_text(*regions));
    } catch (const InputError&) {  // the old table names the levels of the old picture
        if (before) write_file(file, *before);
        throw;
    }
}

}  // namespace dibhr
