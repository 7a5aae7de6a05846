// `dibhr report`: reads the session, finds the pictures that were touched, writes the report.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/commands/command_line.hpp"
#include "app/commands/output.hpp"
#include "app/settings/command_options.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/replay/frames.hpp"
#include "core/report/session_report.hpp"
#include "core/session/session.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/sidecar.hpp"
#include "device/force_devices.hpp"

namespace dibhr {

namespace {

/// Where files are missing or have changed, the report has no picture.
RecordedPicture picture_of(const Session& session, const SessionSource& source,
                           double media_s) try {
    SessionMediaFinder finder(session.file(), false);
    RecordedPicture picture;
    const std::filesystem::path depth = finder.find(source.depth, "depth video");
    std::filesystem::path colour;  // of depth alone there is none
    if (!source.colour.file.empty()) colour = finder.find(source.colour, "colour video");
    DepthRequest request;
    if (!source.depth_meaning.empty())
        request.recorded = statement_in(source.depth_meaning, session.file().string());
    const std::unique_ptr<Media> media = open_media(colour, depth, request);
    picture.columns = media->description().depth_columns;
    picture.rows = media->description().depth_rows;
    media->seek(media_s);
    std::optional<RawFrame> frame = media->next();
    if (!frame) throw InputError(depth.string() + " holds no frame");
    picture.colour = std::move(frame->colour);
    picture.warning = finder.warning();
    return picture;
} catch (const InputError& error) {
    RecordedPicture none;
    none.remark = error.what();
    return none;
}

}  // namespace

int run_report(CLI::App& app, const Arguments& arguments) {
    std::filesystem::path file;
    std::filesystem::path out;  // folder
    std::vector<PlotFormat> plot_formats{PlotFormat::png};
    add_session(app, file);
    add_file(app, "--out", out, "Folder for report.html, report.json and the pictures", "DIR")
        ->required();
    add_plot_format_option(app, plot_formats);
    app.footer(
        "The folder is made if it is missing; an earlier report in it is replaced. The pictures "
        "in the page are PNG in any case.\n\n"
        "Examples:\n"
        "  dibhr report mine.dibhr --out mine-report\n"
        "  dibhr report mine.dibhr --out mine-report --plot-format png,pdf");
    if (!parse(app, arguments)) return 0;
    const Session session(file);
    print_warning(session.warning());
    {
        ProgressBar bar("reading the session");
        write_session_report(session, {out, "dibhr " DIBHR_VERSION,
                                       [&session](const SessionSource& source, double media_s) {
                                           return picture_of(session, source, media_s);
                                       },
                                       [&bar](double share) { bar.show(share); }, plot_formats,
                                       force_device_names()});
    }
    std::cout << (out / "report.html").string() << '\n';
    return 0;
}

}  // namespace dibhr
