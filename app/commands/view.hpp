// `dibhr view`: settings file first, then the command line, then the window.
#pragma once

#include <optional>
#include <utility>

#include "app/settings/command_options.hpp"
#include "app/viewer/view_options.hpp"

namespace dibhr {

/// What the command line asked for, before the settings file was read.
struct ViewRequest {
    ViewOptions options{};
    TouchRequest touch{};
    std::optional<std::pair<int, int>> size{};  ///< --size: width and height
};

/// The exit code; throws Error.
int run_view(const ViewRequest& request);

}  // namespace dibhr
