// The commands of the program. Each declares its own options.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/panels/picture_hook.hpp"
#include "core/replay/frames.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace dibhr {

using Arguments = std::vector<std::string>;

/// `arguments` without the program's own name. Returns the command's exit code. Throws UsageError
/// for a wrong command line, and what the command throws. `after_picture`: of a window.
int run_command_line(const Arguments& arguments, const PictureHook& after_picture = {});

// For the commands.

/// Exit code of a command that Ctrl+C ended.
inline constexpr int kInterrupted = 130;

/// False after a request for help, which is printed. Throws UsageError.
[[nodiscard]] bool parse(CLI::App& app, const Arguments& arguments);

/// "; did you mean touch?" for a word that is nearly a command; else empty.
[[nodiscard]] std::string command_suggestion(const std::string& word);

/// An option, or an argument, that names a file. `file` must outlive the parsing of `app`.
CLI::Option* add_file(CLI::App& app, const std::string& name, std::filesystem::path& file,
                      const std::string& help, const std::string& type = "FILE");
/// --surface-from: where a replay's surfaces come from.
CLI::Option* add_surfaces_option(CLI::App& app, SurfacesFrom& from);
CLI::Option* add_firmware(CLI::App& app, std::filesystem::path& file);
/// --size WxH.
CLI::Option* add_size_option(CLI::App& app, std::optional<std::pair<int, int>>& size,
                             const std::string& help);
/// --speed X.
CLI::Option* add_speed_option(CLI::App& app, const std::function<void(double)>& set);
/// --device: a name that make_hand_device() accepts.
CLI::Option* add_device_option(CLI::App& app, std::string& device);

// Each declares its options in `app`, parses `arguments` (without its name), runs, and returns the
// exit code. Throws Error.

/// The settings file first, then the command line, then the window.
int run_view(CLI::App& app, const Arguments& arguments, const PictureHook& after_picture);
/// One row an update, computed by the core alone.
int run_touch(CLI::App& app, const Arguments& arguments);
/// Writes the surface of one moment to a file. Prints its size and elevations.
int run_surface(CLI::App& app, const Arguments& arguments);
/// Draws a clip off line. Prints its size and length.
int run_clip(CLI::App& app, const Arguments& arguments);
/// Prepares recordings, or lists or removes what is kept of them. Prints a line for each.
int run_prepare(CLI::App& app, const Arguments& arguments);
/// Makes depth for a colour video, or lists or removes stored depth. Prints its path.
int run_depth(CLI::App& app, const Arguments& arguments);
/// Prints a table of all runs. 1 when a run that changes nothing does not give the recorded bits.
int run_replay(CLI::App& app, const Arguments& arguments);
int run_experiment(CLI::App& app, const Arguments& arguments);
/// Writes every tick, with the column names of the session's view `tick`.
int run_export(CLI::App& app, const Arguments& arguments);
/// Writes sessions and studies as a folder to publish, or checks one: prints on stderr what is
/// wrong, and returns 1 when there is anything.
int run_archive(CLI::App& app, const Arguments& arguments);
/// Writes a report and prints the path of its page.
int run_report(CLI::App& app, const Arguments& arguments);
/// Checks a protocol, runs it with one participant, or takes sessions out of a study file.
int run_study(CLI::App& app, const Arguments& arguments, const PictureHook& after_picture);
/// Describes each file; prints on stderr which cannot be read. 1 when there are any.
int run_info(CLI::App& app, const Arguments& arguments);
/// 0: a device can be used, or none is attached and the mouse can be. Throws DeviceError when
/// devices are attached and none can be used. With --check, guides a person through the check; with
/// --simulate, simulates a service until its input ends.
int run_devices(CLI::App& app, const Arguments& arguments);
int run_bench(CLI::App& app, const Arguments& arguments);

}  // namespace dibhr
