// `dibhr report`: reads the session, finds the pictures that were touched, writes the report.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "app/commands/batch/session_batch.hpp"
#include "app/commands/batch/stoppable_work.hpp"
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

void write_report(const Session& session, const std::filesystem::path& folder,
                  const std::vector<PlotFormat>& plot_formats, const WorkProgress& progress) {
    write_session_report(session, {folder, "dibhr " DIBHR_VERSION,
                                   [&session](const SessionSource& source, double media_s) {
                                       return picture_of(session, source, media_s);
                                   },
                                   progress, plot_formats, force_device_names()});
}

/// Into a folder of the session's name.
SessionWork report_into(const std::filesystem::path& folder, const GivenFile& file,
                        const std::vector<PlotFormat>& plot_formats, const WorkProgress& progress) {
    Session session(file.file);
    session.rescue_if_damaged();
    SessionWork done = summary_of(session);
    done.warnings.push_back(session.warning());
    write_report(session, folder / file.name, plot_formats, progress);
    done.files.push_back(file.name + "/report.html");
    done.cells.push_back({"report", done.files.front(), true});
    return done;
}

void report_one(const std::filesystem::path& file, const std::filesystem::path& folder,
                const std::vector<PlotFormat>& plot_formats) {
    Session session(file);
    session.rescue_if_damaged();
    print_warning(session.warning());
    {
        StoppableWork work("reading the session", folder);
        write_report(session, folder, plot_formats, [&work](double share) { work.show(share); });
    }
    std::cout << (folder / "report.html").string() << '\n';
}

}  // namespace

int run_report(CLI::App& app, const Arguments& arguments) {
    BatchOptions batch;
    std::vector<PlotFormat> plot_formats{PlotFormat::png};
    add_sessions(app, batch,
                 "Folder for report.html, report.json and the pictures; of several sessions for "
                 "a folder of each, and report.csv, their summary");
    add_plot_format_option(app, plot_formats);
    app.footer(
        "The folder is made if it is missing; an earlier report in it is replaced. The pictures "
        "in the page are PNG in any case.\n\n"
        "Examples:\n"
        "  dibhr report mine.dibhr --out mine-report\n"
        "  dibhr report mine.dibhr --out mine-report --plot-format png,pdf\n"
        "  dibhr report recordings --out reports");
    if (!parse(app, arguments)) return 0;
    if (batch.out.empty() && !batch.list)
        throw UsageError("--out is required (see dibhr report --help)");
    if (!are_many(batch.given) && !batch.list) {
        report_one(batch.file(), batch.out, plot_formats);
        return 0;
    }
    return run_batch(app,
                     {.command = "report",
                      .title = "Reporting",
                      .work =
                          [&plot_formats](const GivenFile& file, const auto& folder,
                                          const WorkProgress& progress) {
                              return report_into(folder, file, plot_formats, progress);
                          }},
                     batch);
}

}  // namespace dibhr
