// Opens everything a viewer needs before there is a window, so that what fails is told in one line.
#include <unistd.h>

#include <exception>
#include <filesystem>
#include <string>
#include <utility>

#include "app/settings/assets_path.hpp"
#include "app/viewer/viewer.hpp"
#include "core/error.hpp"
#include "core/files/plain_text.hpp"
#include "core/replay/session_player.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

void require_writable_folder(const fs::path& file, const char* option) {
    const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
    if (!fs::is_directory(folder) || ::access(folder.c_str(), W_OK) != 0 ||
        fs::is_directory(file)) {
        throw InputError("cannot write " + file.string() +
                         ": name a file in a folder that can be written with " + option);
    }
}

void require_writable_outputs(const ViewOptions& options) {
    if (!options.screenshot.empty()) require_writable_folder(options.screenshot, "--screenshot");
    if (options.record.empty()) return;
    require_writable_folder(options.record, "--record");
    if (options.record == options.screenshot) {
        throw InputError(options.record.string() +
                         " cannot be both recording and screenshot: give them two names");
    }
    if (fs::exists(options.record)) {
        throw InputError(options.record.string() +
                         " exists already: move it away or give --record another name");
    }
}

std::unique_ptr<Media> open_asked_media(const ViewOptions& options) {
    fs::path colour = options.colour;
    fs::path depth = options.depth;
    if (colour.empty()) {
        const SampleFiles sample = sample_files();
        colour = sample.colour;
        depth = sample.depth;
    }
    return open_media(colour, depth);
}

ViewerParts open_parts(const ViewOptions& options) {
    ViewerParts parts;
    if (names_session(options.colour)) {
        parts.session = std::make_unique<OpenedSession>(options.colour, options.any_media);
        print_warning(parts.session->session.warning());
        print_warning(parts.session->frames.warning());
    } else {
        parts.media = open_asked_media(options);
    }
    parts.hand =
        make_hand_device(options.device, {options.settings.falcon.connection, options.firmware});
    if (!options.bump.empty())
        parts.bump = std::make_shared<const BumpMap>(read_bump_map(options.bump));
    return parts;
}

}  // namespace

int run_viewer(const ViewOptions& options) {
    require_writable_outputs(options);
    EndingSignals signals;
    Viewer viewer(options, open_parts(options), signals);
    viewer.run();
    return 0;
}

}  // namespace dibhr
