// `dibhr view`: puts the settings file and the command line together and opens the window.
#include "app/command_view.hpp"

#include "app/settings.hpp"

namespace dibhr {

int run_view(const ViewRequest& request) {
    ViewOptions options = request.options;
    options.settings = load_settings(settings_path());
    options.parameters = options.settings.touch;
    request.touch.given.apply(options.parameters);
    options.width = request.size ? request.size->first : options.settings.width;
    options.height = request.size ? request.size->second : options.settings.height;
    options.bump = request.touch.bump;
    options.raw_depth = request.touch.raw_depth;
    return run_viewer(options);
}

}  // namespace dibhr
