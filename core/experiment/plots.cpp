// Writes the evaluation's pictures into a folder.
#include "core/experiment/plots.hpp"

#include <string>
#include <system_error>

#include "core/error.hpp"
#include "core/files/output_file.hpp"
#include "core/video/input_file.hpp"

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

void write(const Canvas& plot, const PlotFiles& files, const std::string& name) {
    for (const PlotFormat format : files.formats) {
        OutputFile file(files.folder / (name + "." + std::string(name_of(format))));
        file.write(plot.encoded(format));
        file.commit();
    }
}

}  // namespace

void write_plots(const std::vector<PathRun>& paths, const ColourImage* torso_colour,
                 const PlotFiles& files) {
    make_folder(files.folder);
    for (const PathRun& path : paths) {
        const ColourImage* under = path.name == "human" ? torso_colour : nullptr;
        write(plot_paths(path, under), files, "paths-" + path.name);
        write(plot_force(path), files, "force-" + path.name);
        if (path.name == "circle") write(plot_explanation(path), files, "explained");
        if (!path.exact_proxies.empty()) write(plot_error(path), files, "error-" + path.name);
    }
}

void write_sweep_plot(const std::vector<SweepPoint>& points, const PlotFiles& files) {
    make_folder(files.folder);
    write(plot_sweep(points), files, "sweep");
}

}  // namespace dibhr
