// The line under a plot's title: what the path was run with.
#include "core/experiment/plot_settings.hpp"

#include "core/plot/axes.hpp"

namespace dibhr {

std::string settings_of(const PathRun& path) {
    const bool mean = path.exact_proxies.empty();
    return "friction \u03bc " + tick_text(path.mu) + ",  " + (mean ? "mean depth " : "depth ") +
           tick_text(path.depth_px) + " px,  1 kHz,  " + path.source;
}

}  // namespace dibhr
