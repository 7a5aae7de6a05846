// `dibhr info`: describes media and session files.
#include "app/command_info.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include "app/error_line.hpp"
#include "core/error.hpp"
#include "core/session/session_summary.hpp"
#include "core/video/media.hpp"

namespace dibhr {
namespace {

namespace fs = std::filesystem;

void print_fact(std::string_view name, std::string_view value) {
    constexpr int kNameWidth = 17;
    std::cout << "  " << std::left << std::setw(kNameWidth) << name << ' ' << value << '\n';
}

std::string rounded(double value, int digits) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(digits) << value;
    return text.str();
}

bool is_session(const fs::path& file) {
    if (file.extension() == ".dibhr") return true;
    if (!fs::is_regular_file(file)) return false;  // a pipe would be waited for
    constexpr std::string_view kSqliteMagic = "SQLite format 3";
    std::array<char, kSqliteMagic.size()> start{};
    std::ifstream stream(file, std::ios::binary);
    return stream.read(start.data(), start.size()) &&
           std::equal(start.begin(), start.end(), kSqliteMagic.begin());
}

void describe_session(const fs::path& file) {
    const SessionSummary summary = summarise_session(file);
    std::cout << file.string() << '\n';
    print_fact("kind", "dibhr session");
    print_fact("rows", std::to_string(summary.rows));
    print_fact("duration", rounded(summary.duration_s, 3) + " s");
    for (const auto& [name, value] : summary.facts) print_fact(name, value);
}

void describe_partner(const fs::path& file) {
    std::string looked_for;
    const std::optional<fs::path> depth = find_depth_beside(file, looked_for);
    if (depth) {
        print_fact("depth", depth->string());
    } else {
        print_fact("depth",
                   looked_for.empty() ? "none found" : "none found; looked for " + looked_for);
    }
}

void describe_pictures(const fs::path& file) {
    const MediaDescription media = describe_media(file);
    const bool is_colour = media.colour_columns > 0;
    const int columns = is_colour ? media.colour_columns : media.depth_columns;
    const int rows = is_colour ? media.colour_rows : media.depth_rows;
    const std::string& codec = is_colour ? media.colour_codec : media.depth_codec;

    std::cout << file.string() << '\n';
    print_fact("kind", media.still ? "image" : "video");
    print_fact("size", std::to_string(columns) + "x" + std::to_string(rows));
    if (!codec.empty()) print_fact("codec", codec);
    print_fact("bits", std::to_string(media.depth_bits) + " a channel");
    if (!media.still) {
        print_fact("frames", (media.frames_exact ? "" : "about ") + std::to_string(media.frames));
        print_fact("duration", rounded(media.duration_s, 3) + " s");
        print_fact("rate", rounded(media.frames_per_s, 2) + " frames/s");
    }
    if (!media.remark.empty()) print_fact("remark", media.remark);
    if (is_colour) describe_partner(file);
}

}  // namespace

int run_info(const std::vector<fs::path>& files) {
    int exit_code = 0;
    for (const fs::path& file : files) {
        try {
            if (is_session(file)) {
                describe_session(file);
            } else {
                describe_pictures(file);
            }
        } catch (const Error& error) {
            std::cout.flush();
            print_error_line(error.what());
            exit_code = 1;
        }
    }
    return exit_code;
}

}  // namespace dibhr
