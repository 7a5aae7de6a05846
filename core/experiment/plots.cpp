// Writes the evaluation's pictures into a folder.
#include "core/experiment/plots.hpp"

#include <system_error>

#include "core/error.hpp"
#include "core/video/input_file.hpp"
#include "core/video/media.hpp"

namespace dibhr {
namespace {

void make_folder(const std::filesystem::path& folder) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed || !std::filesystem::is_directory(folder, failed))
        throw InputError(shown(folder) + " cannot be made" +
                         (failed ? " (" + failed.message() + ")" : "") +
                         ": choose a folder you may write to");
}

}  // namespace

void write_plots(const std::vector<PathRun>& paths, const ColourImage* torso_colour,
                 const std::filesystem::path& folder) {
    make_folder(folder);
    for (const PathRun& path : paths) {
        const ColourImage* under = path.name == "human" ? torso_colour : nullptr;
        write_png(plot_paths(path, under), folder / ("paths-" + path.name + ".png"));
        write_png(plot_force(path), folder / ("force-" + path.name + ".png"));
        if (path.name == "circle") write_png(plot_explanation(path), folder / "explained.png");
        if (!path.exact_proxies.empty())
            write_png(plot_error(path), folder / ("error-" + path.name + ".png"));
    }
}

void write_sweep_plot(const std::vector<SweepPoint>& points, const std::filesystem::path& folder) {
    make_folder(folder);
    write_png(plot_sweep(points), folder / "sweep.png");
}

}  // namespace dibhr
