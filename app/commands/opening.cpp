// Files are opened on another thread; meanwhile the window's thread makes the window.
#include "app/commands/opening.hpp"

#include <chrono>

#include "app/commands/output.hpp"
#include "app/viewer/files.hpp"
#include "core/error.hpp"
#include "core/replay/session_player.hpp"
#include "core/video/sources/media.hpp"

namespace dibhr {

namespace {

/// Whether the command line sets the relief, which then replaces the remembered one.
bool gives_relief(const TouchRequest& touch) {
    return touch.raw_depth || touch.given.fit_relief ||
           touch.given.value_of(*touch_number("relief")) != nullptr;
}

/// Opens what the command line names. May wait for disk and network: not for the window's thread.
void open_named(const ViewOptions& options, OpenedFiles& files) {
    if (is_session_file(options.open.colour)) {
        files.session = std::make_unique<OpenedSession>(options.open.colour, options.any_media,
                                                        options.surfaces);
        files.warnings = {files.session->session.warning(), files.session->frames.warning};
        files.guide = find_guide(files.session->frames.description);
        return;
    }
    files.media = open_request(options.open);
    const MediaDescription& media = files.media->description();
    if (options.must_be_sure || options.asks_nobody())
        files.doubt = report_doubt(media, options.must_be_sure);
    files.memory = memory_of(*files.media);
    files.maps = find_maps(media);
    files.guide = find_guide(media);
    if (gives_relief(options.touch)) files.memory.relief_px.reset();
    if (options.start_given || options.end_s || !options.clip.empty()) files.memory.at_s = 0.0;
    files.warnings = {media.notice};
}

}  // namespace

OpenedFiles open_files(const ViewOptions& options) {
    OpenedFiles files;
    try {
        open_named(options, files);
    } catch (const InputError& error) {
        if (!options.stays && !options.open.colour.empty()) throw;
        files = {};
        files.lacks_depth = dynamic_cast<const DepthMissing*>(&error) != nullptr;
        files.trouble = error.what();
    }
    return files;
}

std::unique_ptr<OpeningWindow> open_window(const ViewOptions& options, OpeningWindow::Time begin,
                                           std::exception_ptr& trouble) try {
    return std::make_unique<OpeningWindow>(options, begin);
} catch (const DeviceError&) {
    trouble = std::current_exception();
    return nullptr;
}

std::optional<OpenedFiles> wait_for_files(BackgroundTask<OpenedFiles>& opening,
                                          OpeningWindow* window, const ShutdownWatchdog& shutdown) {
    constexpr std::chrono::milliseconds kPause{20};
    std::optional<OpenedFiles> files;
    while (!(files = opening.take())) {
        if (shutdown.requested() || (window != nullptr && !window->wait())) break;
        opening.wait_until(std::chrono::steady_clock::now() + kPause);
    }
    return files;
}

}  // namespace dibhr
