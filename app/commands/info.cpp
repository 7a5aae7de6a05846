// `dibhr info`: describes media and session files.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/commands/command_line.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/replay/frames.hpp"
#include "core/report/report_words.hpp"
#include "core/session/session.hpp"
#include "core/video/media.hpp"
#include "core/video/media_names.hpp"

namespace dibhr {
namespace {

namespace fs = std::filesystem;

void print_fact(std::string_view name, std::string_view value) {
    constexpr int kNameWidth = 17;
    std::cout << "  " << std::left << std::setw(kNameWidth) << one_line(name) << ' '
              << one_line(value) << '\n';
}

void print_media(std::string_view name, const SessionMedia& media) {
    if (media.file.empty()) return;
    print_fact(name,
               media.file.string() + (media.sha256.empty() ? "" : ", SHA-256 " + media.sha256));
}

void describe_session(const fs::path& file) {
    const Session session(file);
    session.check();
    print_warning(session.warning());
    std::cout << one_line(file.string()) << '\n';
    print_fact("kind", "dibhr session");
    print_fact("rows", std::to_string(session.rows()));
    print_fact("duration", number_text(session.end_s() - session.begin_s(), 3) + " s");
    if (session.missing() > 0) print_fact("missing rows", std::to_string(session.missing()));
    for (const SessionSource& source : session.sources()) {
        print_media("colour", source.colour);
        print_media("depth", source.depth);
    }
    for (const SessionMark& mark : session.marks()) {
        print_fact("mark", number_text(mark.t_s - session.begin_s(), 3) + " s  " + mark.tag +
                               (mark.text.empty() ? "" : ": " + mark.text));
    }
    for (const auto& [name, value] : session.facts()) {
        const bool told = !session.sources().empty() && (name == "colour" || name == "depth");
        if (told) continue;
        print_fact(name,
                   name == "device" ? device_text(value, hand_ticks(session.reader())) : value);
    }
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
    const bool has_depth = media.depth_columns > 0;
    const int columns = is_colour ? media.colour_columns : media.depth_columns;
    const int rows = is_colour ? media.colour_rows : media.depth_rows;
    const std::string& codec = is_colour ? media.colour_codec : media.depth_codec;

    std::cout << one_line(file.string()) << '\n';
    print_fact("kind", media.still ? "image" : "video");
    print_fact("size", std::to_string(columns) + "x" + std::to_string(rows));
    if (!codec.empty()) print_fact("codec", codec);
    print_fact("bits", std::to_string(media.depth_bits) + " a channel");
    if (is_colour && has_depth) {
        print_fact("depth", std::to_string(media.depth_columns) + "x" +
                                std::to_string(media.depth_rows) + ", " + media.depth_codec);
    }
    if (!media.still) {
        print_fact("frames", (media.frames_exact ? "" : "about ") + std::to_string(media.frames));
        print_fact("duration", number_text(media.duration_s, 3) + " s");
        print_fact("rate", number_text(media.frames_per_s, 2) + " frames/s");
    }
    if (is_colour && !has_depth) describe_partner(file);
}

}  // namespace

int run_info(CLI::App& app, const Arguments& arguments) {
    std::vector<std::string> files;
    app.add_option("FILE", files, "Videos, images and session files")->type_name("")->required();
    app.footer("Example:\n  dibhr info color.mp4 depth.mp4 mine.dibhr");
    if (!parse(app, arguments)) return 0;
    int exit_code = 0;
    for (const fs::path file : files) {
        try {
            if (names_session(file)) {
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
