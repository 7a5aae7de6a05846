// Searches and parses files of stamps, and recognises stamps in names.
#include "core/video/sources/layouts/picture_times.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/files/json.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/text_file.hpp"
#include "core/video/formats/file_bytes.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLongestStamps_bytes = 8 << 20;  ///< a hundred thousand lines
constexpr double kEarliest_s = 1.1e9;                  ///< 2004; the time since 1970 of a recording
constexpr double kLatest_s = 4.1e9;                    ///< 2099
constexpr double kMostSpan_s = 1e6;                    ///< of a video
constexpr std::array kStampUnits_s{1.0, 1e-3, 1e-6, 1e-9};
/// Of Windows and .NET: 100 ns since the years 1601 and 1.
constexpr double kTick_s = 1e-7;
constexpr std::array kTickEpochs_s{11'644'473'600.0, 62'135'596'800.0};
/// The interval of frames, of a quick camera and of a slow one.
constexpr double kShortestStep_s = 0.004;
constexpr double kLongestStep_s = 1.0;

using Cells = std::vector<std::string>;

/// A text table: its header, where it has one, and its lines.
struct StampTable {
    Cells header{};
    bool of_comment{false};  ///< the header may be any words
    std::vector<Cells> lines{};
};

bool is_cell_end(char c) {
    return c == ',' || c == ';' || c == ' ' || c == '\t' || c == '\r';
}

/// Without quotation marks and brackets around a cell; the first ones of a line.
Cells stamp_cells(std::string_view line) {
    constexpr std::size_t kMostCells = 256;
    Cells cells;
    std::string cell;
    const auto end_cell = [&] {
        if (!cell.empty()) cells.push_back(std::exchange(cell, {}));
    };
    for (const char c : line) {
        if (cells.size() == kMostCells) return cells;
        if (is_cell_end(c))
            end_cell();
        else if (c != '"' && c != '\'' && c != '[' && c != ']')
            cell += c;
    }
    end_cell();
    return cells;
}

/// The whole number in these characters of a text; nothing where one is no digit.
std::optional<int> digits_at(const std::string& text, std::size_t at, std::size_t count) {
    int number = 0;
    for (std::size_t k = at; k < at + count; ++k) {
        if (k >= text.size() || !is_decimal_digit(text[k])) return std::nullopt;
        number = 10 * number + (text[k] - '0');
    }
    return number;
}

/// "2011-09-26" and "13:02:25.964389" since 1970 [s].
std::optional<double> seconds_of_date(const std::string& date, const std::string& clock) {
    if (date.size() != 10 || date[4] != '-' || date[7] != '-') return std::nullopt;
    if (clock.size() < 8 || clock[2] != ':' || clock[5] != ':') return std::nullopt;
    const auto year = digits_at(date, 0, 4);
    const auto month = digits_at(date, 5, 2);
    const auto day = digits_at(date, 8, 2);
    const auto hour = digits_at(clock, 0, 2);
    const auto minute = digits_at(clock, 3, 2);
    const auto second = number_of_text(std::string_view(clock).substr(6));
    if (!year || !month || !day || !hour || !minute || !second) return std::nullopt;
    const std::chrono::year_month_day named{std::chrono::year(*year),
                                            std::chrono::month(static_cast<unsigned>(*month)),
                                            std::chrono::day(static_cast<unsigned>(*day))};
    if (!named.ok()) return std::nullopt;
    const auto days = std::chrono::sys_days(named).time_since_epoch().count();
    return 86400.0 * static_cast<double>(days) + 3600.0 * *hour + 60.0 * *minute + *second;
}

/// A date of one or two cells becomes one cell of seconds.
void join_date(Cells& cells) {
    for (std::size_t k = 0; k < cells.size(); ++k) {
        const bool has_clock = cells[k].size() > 11 && (cells[k][10] == 'T');
        const std::string date = cells[k].substr(0, std::min<std::size_t>(cells[k].size(), 10));
        std::string clock =
            has_clock ? cells[k].substr(11) : (k + 1 < cells.size() ? cells[k + 1] : std::string());
        if (clock.ends_with('Z')) clock.pop_back();
        if (!has_clock && cells[k].size() != 10) continue;
        const auto seconds = seconds_of_date(date, clock);
        if (!seconds) continue;
        cells[k] = number_text(*seconds);
        if (!has_clock) cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(k) + 1);
        return;
    }
}

StampTable stamp_table(std::string_view text) {
    StampTable table;
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    while (!text.empty()) {
        const std::size_t length = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, length);
        text.remove_prefix(std::min(length + 1, text.size()));
        const bool is_comment = line.starts_with('#');
        if (is_comment) line.remove_prefix(1);
        Cells cells = stamp_cells(line);
        join_date(cells);
        if (cells.empty()) continue;
        const bool has_numbers = std::any_of(cells.begin(), cells.end(), [](const auto& cell) {
            return number_of_text(cell).has_value();
        });
        if (!is_comment && (has_numbers || !table.lines.empty())) {
            table.lines.push_back(std::move(cells));
        } else {
            table.header = std::move(cells);
            table.of_comment = is_comment;
        }
    }
    return table;
}

/// The title of a column: "timestamp [ns]" and "timestamp_ns" have two words.
bool names_time(const std::string& title) {
    const std::vector<std::string> words = plain_words_of(title);
    const bool is_entry =  // "t_00" of a matrix
        std::any_of(words.begin(), words.end(), [](const std::string& word) {
            return std::all_of(word.begin(), word.end(), is_decimal_digit);
        });
    return !is_entry && std::any_of(words.begin(), words.end(), [](const std::string& word) {
        return word == "t" || word == "ts" || word.starts_with("time") || word.ends_with("stamp");
    });
}

bool names_frame(const std::string& title) {
    const std::vector<std::string> words = plain_words_of(title);
    return std::any_of(words.begin(), words.end(), [](const std::string& word) {
        return word.starts_with("frame") || word == "index" || word == "id" || word == "number";
    });
}

/// The unit that a title states [s].
std::optional<double> titled_unit_s(const std::string& title) {
    for (const std::string& word : plain_words_of(title)) {
        if (word == "ns" || word.starts_with("nano")) return 1e-9;
        if (word == "us" || word.starts_with("micro")) return 1e-6;
        if (word == "ms" || word.starts_with("milli")) return 1e-3;
        if (word == "s" || word == "sec" || word.starts_with("second")) return 1.0;
    }
    return std::nullopt;
}

/// A time of a file, for the picture of that name or number, or for the next one in order.
struct StampEntry {
    double time{0.0};
    std::string name{};              ///< without folders; empty: not stated
    std::optional<double> number{};  ///< of the frame
};

/// The stamps of the row's pictures, in the file's unit; nothing where one is missing.
std::optional<std::vector<double>> stamps_for(const PictureRow& row,
                                              const std::vector<StampEntry>& entries) {
    std::vector<double> stamps;
    const bool in_order =
        entries.empty() || (entries.front().name.empty() && !entries.front().number.has_value());
    if (in_order) {
        if (entries.size() != row.size()) return std::nullopt;
        for (const StampEntry& entry : entries) stamps.push_back(entry.time);
        return stamps;
    }
    std::map<std::string, double> by_name;
    std::map<double, double> by_number;
    for (const StampEntry& entry : entries) {
        if (!entry.name.empty()) by_name.emplace(entry.name, entry.time);
        if (entry.number) by_number.emplace(*entry.number, entry.time);
    }
    for (const NumberedPicture& picture : row) {
        const auto whole = by_name.find(picture.file.filename().string());
        const auto stem = by_name.find(picture.file.stem().string());
        if (whole != by_name.end()) {
            stamps.push_back(whole->second);
        } else if (stem != by_name.end()) {
            stamps.push_back(stem->second);
        } else {
            const auto number = picture.number ? by_number.find(*picture.number) : by_number.end();
            if (number == by_number.end()) return std::nullopt;
            stamps.push_back(number->second);
        }
    }
    return stamps;
}

/// Whether numbers of a column without a title may as well count frames, some of them left out.
bool may_count_frames(const std::vector<double>& stamps, bool titled) {
    constexpr double kLeastStep = 8.0;  // of ms: 120 frames a second
    const bool whole = std::all_of(stamps.begin(), stamps.end(),
                                   [](double stamp) { return stamp == std::floor(stamp); });
    const double step = (stamps.back() - stamps.front()) / static_cast<double>(stamps.size() - 1);
    const bool counts = stamps.front() <= 1.0 && step == 1.0;
    return whole && (counts || (!titled && step < kLeastStep && stamps.back() < kEarliest_s));
}

/// In seconds, where they rise by plausible steps. `titled`: known to be times.
std::optional<std::vector<double>> in_seconds(std::vector<double> stamps,
                                              std::optional<double> unit_s, bool titled) {
    if (stamps.size() < 2 || !is_rising(stamps)) return std::nullopt;
    if (!unit_s && may_count_frames(stamps, titled)) return std::nullopt;
    if (!unit_s) unit_s = stamp_unit_s(stamps.front(), stamps.back(), stamps.size(), true);
    if (!unit_s) return std::nullopt;
    for (double& stamp : stamps) stamp *= *unit_s;
    const bool is_video = is_rising(stamps) && stamps.back() - stamps.front() <= kMostSpan_s;
    if (!is_video) return std::nullopt;
    return stamps;
}

/// Columns of a table.
struct StampColumns {
    std::size_t time{0};
    std::optional<std::size_t> picture{};
    std::optional<double> unit_s{};
    bool titled{false};  ///< the header names the column of times
};

/// The names of pictures with and without their endings.
std::set<std::string> names_of(const PictureRow& row) {
    std::set<std::string> names;
    for (const NumberedPicture& picture : row) {
        names.insert(picture.file.filename().string());
        names.insert(picture.file.stem().string());
    }
    return names;
}

/// Whether the column holds names of pictures, with or without folders.
bool holds_names(const StampTable& table, std::size_t column,
                 const std::set<std::string>& pictures) {
    const Cells& first = table.lines.front();
    return column < first.size() && pictures.contains(fs::path(first[column]).filename().string());
}

/// Whether the column counts 0, 1, 2 or 1, 2, 3.
bool counts_lines(const StampTable& table, std::size_t column) {
    double wanted = 0.0;
    for (std::size_t k = 0; k < table.lines.size(); ++k, wanted += 1.0) {
        const Cells& line = table.lines[k];
        const auto number = column < line.size() ? number_of_text(line[column]) : std::nullopt;
        if (!number) return false;
        if (k == 0 && *number == 1.0) wanted = 1.0;
        if (*number != wanted) return false;
    }
    return table.lines.size() > 1;
}

/// Nothing where the header names no time.
std::optional<StampColumns> stamp_columns(const StampTable& table, const PictureRow& row) {
    StampColumns columns;
    const std::size_t count = table.lines.front().size();
    const bool has_titles =
        !table.of_comment || std::any_of(table.header.begin(), table.header.end(), names_time);
    const bool titled = table.header.size() == count && has_titles;
    // mkvextract: "# timestamp format v2", milliseconds.
    if (count == 1 && table.header.size() == 3 && table.header[1] == "format")
        columns.unit_s = 1e-3;
    for (std::size_t k = 0; k < count && titled && !columns.titled; ++k) {
        columns.titled = names_time(table.header[k]);
        if (columns.titled) columns.time = k;
    }
    if (titled && !columns.titled) return std::nullopt;
    const bool is_counted = !titled && count > 1 && counts_lines(table, 0);
    if (is_counted) columns.time = 1;
    if (titled) columns.unit_s = titled_unit_s(table.header[columns.time]);
    const std::set<std::string> pictures = names_of(row);
    for (std::size_t k = count; k-- > 0;) {
        const bool is_number = titled && names_frame(table.header[k]);
        if (k != columns.time && (holds_names(table, k, pictures) || is_number))
            columns.picture = k;
    }
    if (columns.picture) return columns;
    if (is_counted)
        columns.picture = 0;
    else if (!titled && count == 2)
        columns.picture = 1;
    return columns;
}

std::optional<std::vector<double>> stamps_in_table(const std::string& text, const PictureRow& row) {
    const StampTable table = stamp_table(text);
    if (table.lines.empty()) return std::nullopt;
    const auto found = stamp_columns(table, row);
    if (!found) return std::nullopt;
    const StampColumns& columns = *found;
    std::vector<StampEntry> entries;
    for (const Cells& line : table.lines) {
        if (columns.time >= line.size()) return std::nullopt;
        const auto time = number_of_text(line[columns.time]);
        if (!time) return std::nullopt;
        StampEntry entry{.time = *time};
        if (columns.picture) {
            if (*columns.picture >= line.size()) return std::nullopt;
            const std::string& cell = line[*columns.picture];
            entry.name = fs::path(cell).filename().string();
            entry.number = number_of_text(cell);
        }
        entries.push_back(std::move(entry));
    }
    auto stamps = stamps_for(row, entries);
    // A counter may begin anywhere: then lines go by their order.
    if (!stamps && columns.picture && entries.size() == row.size()) {
        for (StampEntry& entry : entries) entry = {.time = entry.time};
        stamps = stamps_for(row, entries);
    }
    if (!stamps) return std::nullopt;
    return in_seconds(std::move(*stamps), columns.unit_s, columns.titled);
}

/// The number at the first key that names a time, and its unit.
std::optional<std::pair<double, std::optional<double>>> stamp_of(const Json& frame) {
    if (frame.is_number()) return std::pair(frame.get<double>(), std::optional<double>());
    if (!frame.is_object()) return std::nullopt;
    for (const auto& [key, value] : frame.items()) {
        if (names_time(key) && value.is_number())
            return std::pair(value.get<double>(), titled_unit_s(key));
    }
    return std::nullopt;
}

/// The list of frames: the value itself, or the longest list or object in it.
const Json& frames_in(const Json& json) {
    if (!json.is_object()) return json;
    const Json* longest = &json;
    for (const auto& [key, value] : json.items()) {
        const bool is_list = value.is_array() && !value.empty() && stamp_of(value.front());
        if (is_list && (longest == &json || value.size() > longest->size())) longest = &value;
    }
    return *longest;
}

/// The name of one of these pictures among the texts of a frame.
std::string name_in(const Json& frame, const std::set<std::string>& pictures) {
    if (!frame.is_object()) return {};
    for (const auto& [key, value] : frame.items()) {
        if (!value.is_string()) continue;
        const std::string name = fs::path(value.get<std::string>()).filename().string();
        if (pictures.contains(name)) return name;
    }
    return {};
}

std::optional<std::vector<double>> stamps_in_json(const std::string& text, const PictureRow& row) {
    const Json json = parsed_json(text);
    if (json.is_discarded()) return std::nullopt;
    const std::set<std::string> pictures = names_of(row);
    const Json& frames = frames_in(json);
    std::vector<StampEntry> entries;
    std::optional<double> unit_s;
    bool titled = false;
    for (const auto& [key, frame] : frames.items()) {
        const auto stamp = stamp_of(frame);
        if (!stamp) continue;
        titled = frame.is_object();
        unit_s = stamp->second;
        StampEntry entry{.time = stamp->first, .name = name_in(frame, pictures)};
        if (entry.name.empty() && frames.is_object() && pictures.contains(key)) entry.name = key;
        if (frame.is_object())
            for (const auto& [name, value] : frame.items())
                if (names_frame(name) && value.is_number()) entry.number = value.get<double>();
        entries.push_back(std::move(entry));
    }
    auto stamps = stamps_for(row, entries);
    if (!stamps) return std::nullopt;
    return in_seconds(std::move(*stamps), unit_s, titled);
}

std::vector<fs::path> stamp_files(const fs::path& folder) {
    std::vector<fs::path> files;
    const fs::path above = folder.parent_path();
    const std::string own = folder.filename().string();
    for (const char* const ending : {"_timestamps.txt", "_timestamps.csv", "_times.txt",
                                     "_times.csv", ".txt", ".csv", ".json", "_timestamps.json"})
        if (!own.empty()) files.push_back(above / (own + ending));
    for (const fs::path& place : {folder, above}) {
        for (const char* const name :
             {"timestamps.txt", "timestamp.txt", "times.txt", "timestamps.csv", "timestamp.csv",
              "times.csv", "data.csv", "frames.csv", "index.csv", "odometry.csv", "frames.txt",
              "frames.json", "timestamps.json", "index.json", "pose_intrinsic_imu.json"})
            files.push_back(place / name);
    }
    return files;
}

/// Where the last digits of a name begin, and how many they are.
std::pair<std::size_t, std::size_t> last_digits(const std::string& name) {
    constexpr const char* kDigits = "0123456789";
    const std::size_t last = name.find_last_of(kDigits);
    if (last == std::string::npos) return {name.size(), 0};
    const std::size_t first = name.find_last_not_of(kDigits, last) + 1;  // npos + 1 is 0
    return {first, last + 1 - first};
}

/// The JSON files beside a row that may be of its first frame: of the picture's name, then those of
/// its number ("frame_00000.json" of "depth_00000.png").
std::vector<fs::path> first_frame_files(const NumberedPicture& first) {
    const fs::path own = fs::path(first.file).replace_extension(".json");
    const fs::path folder = own.has_parent_path() ? own.parent_path() : fs::path(".");
    std::vector<fs::path> files;
    std::error_code failed;
    for (fs::directory_iterator entry(folder, failed), end;
         first.number && !first.decimal && !failed && entry != end; entry.increment(failed)) {
        const fs::path& file = entry->path();
        const bool is_json = lower_case(file.extension().string()) == ".json";
        if (is_json && file != own && numbered(file).number == first.number) files.push_back(file);
    }
    std::sort(files.begin(), files.end());
    files.insert(files.begin(), own);
    return files;
}

/// The file named as `first`, with the last digits of a picture's name.
fs::path frame_file(const fs::path& first, const fs::path& picture) {
    const std::string own = picture.stem().string();
    std::string name = first.stem().string();
    const auto [own_begin, own_count] = last_digits(own);
    const auto [begin, count] = last_digits(name);
    name.replace(begin, count, own, own_begin, own_count);
    return first.parent_path() / (name + first.extension().string());
}

/// The stamps in JSON files beside a row, one a frame.
std::optional<ListedTimes> times_of_frames(const PictureRow& row) {
    for (const fs::path& first : first_frame_files(row.front())) {
        std::vector<double> stamps;
        std::optional<double> unit_s;
        for (const NumberedPicture& picture : row) {
            const fs::path file = frame_file(first, picture.file);
            const Json frame = parsed_json(small_text_in(file).value_or(""));
            const auto stamp = frame.is_object() ? stamp_of(frame) : std::nullopt;
            if (!stamp) break;
            stamps.push_back(stamp->first);
            unit_s = stamp->second;
        }
        if (stamps.size() != row.size()) continue;
        if (auto times = in_seconds(std::move(stamps), unit_s, true))
            return ListedTimes{std::move(*times), first, true};
    }
    return std::nullopt;
}

std::shared_ptr<const std::vector<double>> kept_numbers(std::vector<double> numbers) {
    return std::make_shared<const std::vector<double>>(std::move(numbers));
}

}  // namespace

std::optional<double> stamp_unit_s(double first, double last, std::size_t count, bool are_times) {
    if (count < 2 || !(first < last)) return std::nullopt;
    const double step = (last - first) / static_cast<double>(count - 1);
    for (const double epoch_s : kTickEpochs_s)
        if (first * kTick_s - epoch_s > kEarliest_s && last * kTick_s - epoch_s < kLatest_s)
            return kTick_s;
    for (const double unit_s : kStampUnits_s) {
        const bool of_today = first * unit_s > kEarliest_s && last * unit_s < kLatest_s;
        // Numbers that follow each other count frames, also where they are as large as seconds.
        if (of_today && (unit_s < 1.0 || are_times || step != 1.0)) return unit_s;
    }
    if (are_times && step <= kLongestStep_s) return 1.0;
    for (const double unit_s : kStampUnits_s) {
        const bool is_plain = are_times || unit_s < 1e-4;
        if (is_plain && step * unit_s >= kShortestStep_s && step * unit_s <= kLongestStep_s)
            return unit_s;
    }
    // Of pictures that are seconds apart.
    return are_times && step < 1000.0 ? std::optional(1.0) : std::nullopt;
}

std::optional<std::vector<double>> read_stamps(const fs::path& file, const PictureRow& row) {
    if (row.size() < 2 || !is_file(file) || size_of(file) > kLongestStamps_bytes)
        return std::nullopt;
    const std::string text = beginning_of(file, kLongestStamps_bytes);
    if (text.find('\0') != std::string::npos) return std::nullopt;
    return lower_case(file.extension().string()) == ".json" ? stamps_in_json(text, row)
                                                            : stamps_in_table(text, row);
}

std::optional<ListedTimes> times_beside(const PictureRow& row) {
    if (row.size() < 2) return std::nullopt;
    for (const fs::path& file : stamp_files(row.front().file.parent_path())) {
        if (auto stamps = read_stamps(file, row)) return ListedTimes{std::move(*stamps), file};
    }
    return times_of_frames(row);
}

Timing timing_of(const PictureRow& row, const PictureRow& other, const fs::path& list) {
    const std::string listed = "stamps in " + shown(list.filename());
    const bool decimal = has_order(row, true);
    if (decimal && has_order(other, true)) {
        if (!list.empty()) return {.from = TimesFrom::list, .text = listed};
        return {.from = TimesFrom::names, .text = "stamps in the names"};
    }
    Timing timing = assumed_timing();
    if (times_s(row, other, kPicturesPerSecond) != times_s(row, {}, kPicturesPerSecond)) {
        timing.from = TimesFrom::other;
        timing.text += ", by numbers that colour and depth share";
    }
    std::vector<double> numbers;
    if (decimal || has_order(row, false))
        for (const NumberedPicture& picture : row) numbers.push_back(*picture.number);
    if (numbers.size() > 1 && !decimal) timing.numbers = kept_numbers(numbers);
    if (auto beside = list.empty() ? times_beside(row) : std::nullopt) {
        timing.stamps_s = kept_numbers(std::move(beside->times_s));
        timing.stamps_from = TimesFrom::list;
        timing.stamps_text = "stamps in " + shown(beside->file.filename()) +
                             (beside->is_of_frame ? " and the like, one a frame" : "");
        return timing;
    }
    if (numbers.size() < 2) return timing;
    const auto unit_s = decimal
                            ? std::optional(1.0)
                            : stamp_unit_s(numbers.front(), numbers.back(), numbers.size(), false);
    if (!unit_s) return timing;
    for (double& number : numbers) number *= *unit_s;
    const bool is_video = is_rising(numbers) && numbers.back() - numbers.front() <= kMostSpan_s;
    if (!is_video) return timing;
    timing.stamps_s = kept_numbers(std::move(numbers));
    timing.stamps_from = list.empty() ? TimesFrom::names : TimesFrom::list;
    timing.stamps_text = list.empty() ? "stamps in the names" : listed;
    return timing;
}

}  // namespace dibhr
