// `dibhr view`: puts the settings file and the command line together and opens the window.
#include "app/commands/view.hpp"

#include "app/settings/settings.hpp"
#include "core/replay/moments.hpp"

namespace dibhr {

namespace {

/// A replay is what was recorded: there is nothing to record, and its surface is given.
void require_replay_options(const ViewRequest& request) {
    const bool wrong = !request.options.depth.empty() || !request.options.record.empty() ||
                       !request.touch.bump.empty() || request.touch.raw_depth;
    if (!wrong) return;
    throw UsageError(request.options.colour.string() +
                     " is a session, which is replayed as it was recorded: leave away a depth "
                     "file, --record, --bump and --raw-depth");
}

}  // namespace

int run_view(const ViewRequest& request) {
    if (names_session(request.options.colour)) require_replay_options(request);
    ViewOptions options = request.options;
    options.settings = load_settings(settings_path());
    options.parameters = options.settings.touch;
    request.touch.given.apply(options.parameters);
    options.given = request.touch.given;
    options.width = request.size ? request.size->first : options.settings.width;
    options.height = request.size ? request.size->second : options.settings.height;
    options.bump = request.touch.bump;
    options.raw_depth = request.touch.raw_depth;
    return run_viewer(options);
}

}  // namespace dibhr
