// Parses lists line by line, and ignores lines that do not name a time and a picture.
#include "core/video/sources/layouts/picture_lists.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/video/formats/file_bytes.hpp"
#include "core/video/sources/media_names.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kListBegin_bytes = 1 << 16;  ///< searched for a first line after comments
constexpr std::size_t kLongestList_bytes = 256 << 20;
constexpr double kLargestNumber = 1e20;    ///< more than nanoseconds since 1970
constexpr double kSurenessOfLists = 0.95;  ///< people's own recorders write millimetres

/// A time and a picture's name, of a line.
struct Entry {
    double time{0.0};
    bool decimal{false};  ///< written with a point
    std::string_view name{};
};

/// One entry, or two that belong together; none when the line names no picture.
using Line = std::vector<Entry>;

// As associate.py: commas and tabs are spaces.
bool is_space(char c) {
    return c == ' ' || c == ',' || c == '\t' || c == '\r';
}

std::string_view without_spaces(std::string_view text) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

std::vector<std::string_view> cells_of(std::string_view text) {
    std::vector<std::string_view> cells;
    while (!(text = without_spaces(text)).empty()) {
        const auto end = std::find_if(text.begin(), text.end(), is_space);
        const auto length = static_cast<std::size_t>(end - text.begin());
        cells.push_back(text.substr(0, length));
        text.remove_prefix(length);
    }
    return cells;
}

std::optional<Entry> entry_of(std::string_view time, std::string_view name) {
    Entry entry;
    entry.name = name;
    entry.decimal = time.find('.') != std::string_view::npos;
    const auto number = number_of_text(time);
    if (!number || !(std::abs(*number) < kLargestNumber)) return std::nullopt;
    entry.time = *number;
    if (!named_picture(fs::path(name))) return std::nullopt;
    return entry;
}

bool is_comment(std::string_view text) {
    text = without_spaces(text);
    return text.empty() || text.front() == '#';
}

/// The name of a single picture may hold spaces.
Line line_of(std::string_view text) {
    text = without_spaces(text);
    const std::vector<std::string_view> cells = cells_of(text);
    if (cells.size() == 4) {
        const auto first = entry_of(cells[0], cells[1]);
        const auto second = entry_of(cells[2], cells[3]);
        if (first && second) return {*first, *second};
    }
    if (cells.size() < 2) return {};
    const auto only = entry_of(cells[0], without_spaces(text.substr(cells[0].size())));
    return only ? Line{*only} : Line{};
}

std::string_view without_byte_order_mark(std::string_view text) {
    return text.substr(text.starts_with("\xef\xbb\xbf") ? 3 : 0);
}

template <typename Take>
void for_each_line(std::string_view text, Take take) {
    text = without_byte_order_mark(text);
    while (!text.empty()) {
        const std::size_t length = std::min(text.find('\n'), text.size());
        if (!is_comment(text.substr(0, length))) take(text.substr(0, length));
        text.remove_prefix(std::min(length + 1, text.size()));
    }
}

/// The role by the words of a name, else of the folders in it.
enum class Kind { colour, depth, unnamed };
Kind kind_of(const fs::path& name) {
    for (fs::path part = name; !part.empty() && part != part.parent_path();
         part = part.parent_path()) {
        if (named_depth(part)) return Kind::depth;
        if (named_colour(part)) return Kind::colour;
    }
    return Kind::unnamed;
}

/// Counts of ignored entries, for the notice.
struct IgnoredEntries {
    std::size_t lines{0};
    std::size_t missing{0};
    std::size_t repeated{0};
    std::string first_missing{};
};

std::string sentence(const fs::path& list, const IgnoredEntries& ignored) {
    std::string said;
    const auto add = [&said](std::size_t count, const std::string& what) {
        if (count == 0) return;
        said += (said.empty() ? "" : ", ") + std::to_string(count) + " " + what;
    };
    add(ignored.lines, "lines that do not name a time and a picture");
    add(ignored.missing, "missing pictures (the first: " + shown(ignored.first_missing) + ")");
    add(ignored.repeated, "pictures with the time of another picture");
    return said.empty() ? said : shown(list) + ": dibhr ignores " + said;
}

/// Sorts by time, and keeps each time once.
void put_in_order(PictureRow& row, IgnoredEntries& ignored) {
    const auto by_time = [](const NumberedPicture& a, const NumberedPicture& b) {
        return *a.number < *b.number;
    };
    const auto same_time = [](const NumberedPicture& a, const NumberedPicture& b) {
        return *a.number == *b.number;
    };
    std::stable_sort(row.begin(), row.end(), by_time);
    const auto repeated = std::unique(row.begin(), row.end(), same_time);
    ignored.repeated += static_cast<std::size_t>(row.end() - repeated);
    row.erase(repeated, row.end());
}

/// The cameras of TUM's benchmark, by the names of its sequences
/// (cvg.cit.tum.de/data/datasets/rgbd-dataset/file_formats).
LayoutFacts facts_of_tum(const fs::path& list) {
    struct Camera {
        std::string_view name;
        Intrinsics intrinsics;
    };
    static constexpr std::array kCameras{Camera{"freiburg1", {517.3, 516.5, 318.6, 255.3}},
                                         Camera{"freiburg2", {520.9, 521.0, 325.1, 249.7}},
                                         Camera{"freiburg3", {535.4, 539.2, 320.1, 247.6}}};
    LayoutFacts facts;
    facts.finding.statement = {.unit = DepthUnit::m, .scale = 0.0002, .no_data = std::vector{0.0}};
    facts.finding.sureness = kSurenessOfLists;
    facts.finding.reason = "TUM lists";
    // A Kinect in rooms: what is all nearer is in millimetres.
    facts.finding.usual = {"TUM's camera", 0.4, 14.0, 1.2};
    std::error_code gone;
    const std::string place = lower_case(fs::absolute(list, gone).string());
    for (const Camera& camera : kCameras) {
        if (place.find(camera.name) == std::string::npos) continue;
        facts.finding.sureness = kSurenessOfMetadata;
        facts.finding.statement.intrinsics = camera.intrinsics;
        facts.columns = 640;
        facts.rows = 480;
    }
    return facts;
}

/// Reads one list into a set.
class ListReader {
  public:
    explicit ListReader(const fs::path& list)
        : list_(list), folder_(list.parent_path()), kind_of_list_(kind_of(list.filename())) {}

    void take(std::string_view text) {
        const Line line = line_of(text);
        if (line.empty()) ++ignored_.lines;
        if (line.size() == 1) add(line[0], kind_of_single(line[0].name), line[0].time);
        if (line.size() != 2) return;
        const bool depth_first =
            kind_of(line[0].name) == Kind::depth ||
            (kind_of(line[0].name) == Kind::unnamed && kind_of(line[1].name) == Kind::colour);
        const Entry& depth = line[depth_first ? 0 : 1];
        add(depth, Kind::depth, depth.time);
        add(line[depth_first ? 1 : 0], Kind::colour, depth.time);
    }

    PictureSet finish() {
        PictureRow* const rows[] = {&set_.colour, &set_.depth, &set_.unnamed};
        for (PictureRow* const row : rows) {
            for (NumberedPicture& picture : *row) picture.decimal = decimal_;
            put_in_order(*row, ignored_);
        }
        if (set_.colour.empty() && set_.depth.empty() && set_.unnamed.empty())
            throw InputError(shown(list_) + " names no picture that is there" +
                             (ignored_.missing > 0
                                  ? " (the first: " + shown(ignored_.first_missing) + ")"
                                  : std::string()) +
                             ": put it beside the folders of its pictures");
        set_.facts = facts_of_tum(list_);
        set_.facts.notice = sentence(list_, ignored_);
        set_.facts.list = list_;
        return std::move(set_);
    }

  private:
    [[nodiscard]] Kind kind_of_single(std::string_view name) const {
        return kind_of_list_ == Kind::unnamed ? kind_of(name) : kind_of_list_;
    }

    void add(const Entry& entry, Kind kind, double time) {
        fs::path file = folder_ / entry.name;
        if (!is_file(file)) {
            if (ignored_.missing++ == 0) ignored_.first_missing = std::string(entry.name);
            return;
        }
        decimal_ = decimal_ || entry.decimal;
        PictureRow& row = kind == Kind::depth    ? set_.depth
                          : kind == Kind::colour ? set_.colour
                                                 : set_.unnamed;
        row.push_back({std::move(file), time, false});
    }

    fs::path list_;
    fs::path folder_;
    Kind kind_of_list_;
    PictureSet set_{};
    IgnoredEntries ignored_{};
    bool decimal_{false};
};

}  // namespace

bool is_picture_list(const fs::path& file) {
    const std::string text = beginning_of(file, kListBegin_bytes);
    if (text.find('\0') != std::string::npos) return false;
    bool found = false;
    for_each_line(text,
                  [&found](std::string_view line) { found = found || !line_of(line).empty(); });
    return found;
}

PictureSet read_picture_list(const fs::path& list) {
    std::error_code failed;
    if (fs::file_size(list, failed) > kLongestList_bytes && !failed)
        throw InputError(shown(list) +
                         " is a list of more than 256 megabytes: give one of fewer pictures");
    ListReader reader(list);
    for_each_line(beginning_of(list, kLongestList_bytes),
                  [&reader](std::string_view line) { reader.take(line); });
    return reader.finish();
}

std::optional<PictureSet> read_lists_in(const fs::path& folder) {
    for (const char* const name :
         {"associations.txt", "associate.txt", "associated.txt", "association.txt"}) {
        if (!is_picture_list(folder / name)) continue;
        PictureSet set = read_picture_list(folder / name);
        if (!set.colour.empty() && !set.depth.empty()) return set;
    }
    if (!is_picture_list(folder / "depth.txt")) return std::nullopt;
    PictureSet set = read_picture_list(folder / "depth.txt");
    if (!is_picture_list(folder / "rgb.txt")) return set;
    PictureSet colour = read_picture_list(folder / "rgb.txt");
    set.colour = std::move(colour.colour);
    add_clause(set.facts.notice, colour.facts.notice);
    return set;
}

}  // namespace dibhr
