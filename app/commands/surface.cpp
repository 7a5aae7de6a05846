// `dibhr surface`: a surface as it is felt at one moment, for other programs, printers and mills.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands/command_line.hpp"
#include "app/commands/given_media.hpp"
#include "app/commands/output.hpp"
#include "app/settings/command_options.hpp"
#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/surface_files/surface_file.hpp"
#include "core/video/playing/frame_reader.hpp"

namespace dibhr {
namespace {

namespace fs = std::filesystem;

constexpr double kLongestMedia_s = 1e6;
constexpr int kDigits = 5;  ///< of a printed elevation

struct SurfaceOptions {
    fs::path colour{};
    fs::path depth{};  ///< empty: found beside the colour file, or `colour` is depth itself
    fs::path out{};
    double time_s{0.0};
    bool must_be_sure{false};  ///< --sure
    TouchRequest touch{};
    TouchParameters parameters{};
};

/// The frame shown at `time_s` of the media and the next one, if any. The last frame is shown until
/// the media ends; InputError for a later time.
std::vector<Frame> frames_around(FrameReader& reader, double time_s) {
    const WorkingLine line("Reading the surface");
    const fs::path& file = reader.description().depth_path;
    if (reader.description().live && time_s > 0.0)
        throw InputError(shown(file) + " is live: leave --time out");
    std::optional<Frame> now = reader.at(time_s);
    if (!now) throw InputError(shown(file) + " holds no picture: give another depth file");
    now->time_s = now->media_s;
    std::vector<Frame> frames{*now};
    if (reader.description().still) {
        if (time_s > 0.0) throw InputError(shown(file) + " is a still picture: leave --time out");
        return frames;
    }
    std::optional<Frame> next = reader.after(now->media_s);
    if (!next) {
        const double end_s = now->media_s + reader.last_interval_s(now->media_s);
        constexpr double kRoundOff_s = 1e-6;
        if (time_s >= end_s - kRoundOff_s)
            throw InputError(shown(file) + " lasts " + short_text(end_s) +
                             " s: give --time less than that instead of " + short_text(time_s));
        return frames;
    }
    next->time_s = next->media_s;
    reader.connect(frames.back(), *next);
    frames.push_back(std::move(*next));
    return frames;
}

std::string range_text(double lowest, double highest, const std::string& unit) {
    return short_text(lowest, kDigits) + " to " + short_text(highest, kDigits) + ' ' + unit;
}

std::string summary_text(const ExportedSurface& exported, SurfaceFormat format) {
    const ElevationRange range = elevation_range(exported.surface);
    const double pitch_mm = exported.pixel_pitch_mm;
    std::string text = std::to_string(exported.surface.columns()) + " x " +
                       std::to_string(exported.surface.rows()) + ", elevation " +
                       range_text(range.lowest_px, range.highest_px, "px") + ", " +
                       range_text(range.lowest_px * pitch_mm, range.highest_px * pitch_mm, "mm");
    if (format == SurfaceFormat::png)
        text += ", white is " + short_text(exported.surface.ceiling()) + " px";
    return text;
}

SurfaceFormat requested_format(const fs::path& out) {
    if (const auto format = surface_format_of(out)) return *format;
    throw UsageError("--out " + out.string() +
                     ": its ending says how the surface is written; give a name that ends in "
                     ".pfm, .png, .ply or .stl");
}

void write_felt_surface(const SurfaceOptions& options, SurfaceFormat format) {
    TouchParameters parameters = options.parameters;
    FrameReader reader(open_given(options.colour, options.depth, options.touch,
                                  options.must_be_sure, false, parameters));
    reader.set_cleaning(options.touch.cleaning(parameters, reader.description()));
    reader.set_maps(options.touch.read_maps(reader.description()));
    const std::shared_ptr<const BumpMap> bump = options.touch.given.read_bumps();
    const std::vector<Frame> frames = frames_around(reader, options.time_s);
    print_warning(reader.prepared().trouble());
    const DepthBlend blend = depth_at(frames, options.time_s);
    const std::shared_ptr<const ColourImage> colour = blend.colour_frame().rgb();
    const ExportedSurface exported{blend.surface(parameters.shape, bump.get()),
                                   parameters.coupling.pixel_pitch_mm, colour.get()};

    const MediaDescription& media = reader.description();
    refuse_overwriting(options.out,
                       {media.colour_path, media.depth_path, options.touch.given.bump_file()},
                       "is also read by this command; give --out another name");
    {
        const WorkingLine line("Writing " + one_line(options.out.string()));
        OutputFile file(options.out);
        write_surface(exported, format, file);
        file.commit();
    }
    std::cout << one_line(options.out.string()) << ": " << summary_text(exported, format) << '\n';
}

}  // namespace

int run_surface(CLI::App& app, const Arguments& arguments) {
    SurfaceOptions options;
    add_file(app, "COLOR", options.colour, "Colour video, image or folder, or depth alone", "")
        ->required();
    add_file(app, "DEPTH", options.depth, "Depth video, image or folder; else found beside COLOR",
             "");
    add_file(app, "--out", options.out,
             "By its ending: .pfm elevations (px), .png 16-bit relief, .ply coloured mesh (mm), "
             ".stl solid plate (mm)")
        ->required();
    add_number_option(app, "--time", 0.0, kLongestMedia_s,
                      "Seconds from the beginning; between two frames they are blended",
                      [&options](double time_s) { options.time_s = time_s; })
        ->type_name("S")
        ->default_str("0");
    add_shape_options(app, options.touch);
    add_sure_option(app, options.must_be_sure);
    add_decoder_option(app, options.touch.decoder);
    app.footer(
        "Examples:\n"
        "  dibhr surface color.mp4 depth.mp4 --time 2.5 --out hand.ply\n"
        "  dibhr surface depth.png --relief 60 --out plate.stl");
    if (!parse(app, arguments)) return 0;
    const SurfaceFormat format = requested_format(options.out);
    options.touch.given.apply(options.parameters);
    print_warning(roughness_warning(options.touch.given, !options.touch.given.bump_file().empty()));
    write_felt_surface(options, format);
    return 0;
}

}  // namespace dibhr
