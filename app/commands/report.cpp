// `dibhr report`: reads the session, finds the pictures that were touched, writes the report.
#include "app/commands/report.hpp"

#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "app/commands/progress_bar.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/replay/media.hpp"
#include "core/report/session_report.hpp"
#include "core/session/session.hpp"
#include "core/video/media.hpp"

namespace dibhr {

namespace {

RecordedPicture picture_of(SessionMediaFinder& finder, const SessionSource& source,
                           double media_s) {
    RecordedPicture picture;
    const std::filesystem::path depth = finder.find(source.depth, "depth video");
    const std::filesystem::path colour = finder.find(source.colour, "colour video");
    const std::unique_ptr<Media> media = open_media(colour, depth);
    picture.columns = media->description().depth_columns;
    picture.rows = media->description().depth_rows;
    media->seek(media_s);
    std::optional<RawFrame> frame = media->next();
    if (!frame) throw InputError(colour.string() + " holds no frame");
    picture.colour = std::move(frame->colour);
    picture.warning = finder.warning();
    return picture;
}

/// Files that are gone or have changed are no reason to have no report.
RecordedPicture picture_or_remark(const Session& session, const SessionSource& source,
                                  double media_s) {
    SessionMediaFinder finder(session.file(), false);
    try {
        return picture_of(finder, source, media_s);
    } catch (const InputError& error) {
        RecordedPicture none;
        none.remark = error.what();
        return none;
    }
}

}  // namespace

int run_report(const ReportOptions& options) {
    const Session session(options.session);
    print_warning(session.warning());
    {
        ProgressBar bar("reading the session");
        write_session_report(session,
                             {options.out, "dibhr " DIBHR_VERSION,
                              [&session](const SessionSource& source, double media_s) {
                                  return picture_or_remark(session, source, media_s);
                              },
                              [&bar](double share) { bar.show(share); }, options.plot_formats});
    }
    std::cout << (options.out / "report.html").string() << '\n';
    return 0;
}

}  // namespace dibhr
