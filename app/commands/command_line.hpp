// The commands of the program: found by name, their options declared where they are used.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/panels/picture_hook.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace dibhr {

using Arguments = std::vector<std::string>;

/// `arguments` without the program's own name. The exit code of the command; throws UsageError for
/// a wrong command line, and what the command throws. `after_picture`: of a window.
int run_command_line(const Arguments& arguments, const PictureHook& after_picture = {});

// For the commands.

/// False when the help was asked for, which is then printed. Throws UsageError.
[[nodiscard]] bool parse(CLI::App& app, const Arguments& arguments);

/// "; did you mean touch?" of a word that is nearly a command, or nothing.
[[nodiscard]] std::string meant_command(const std::string& word);

/// An option, or an argument, that names a file. `file` must outlive the parsing of `app`.
CLI::Option* add_file(CLI::App& app, const std::string& name, std::filesystem::path& file,
                      const std::string& help, const std::string& type = "FILE");
CLI::Option* add_session(CLI::App& app, std::filesystem::path& file);
CLI::Option* add_firmware(CLI::App& app, std::filesystem::path& file);
/// --size WxH.
CLI::Option* add_size_option(CLI::App& app, std::optional<std::pair<int, int>>& size,
                             const std::string& help);
/// --device, as make_hand_device() has it.
CLI::Option* add_device_option(CLI::App& app, std::string& device);

// Each declares its options in `app`, parses `arguments` after its name and runs. The exit code;
// throws Error.

/// The settings file first, then the command line, then the window.
int run_view(CLI::App& app, const Arguments& arguments, const PictureHook& after_picture);
/// One row an update, computed by the core alone.
int run_touch(CLI::App& app, const Arguments& arguments);
/// A surface at one moment as a file of another form. Prints its size and how high it is.
int run_surface(CLI::App& app, const Arguments& arguments);
/// Depth for a colour video by an estimator, or what is kept of such. Prints where it is.
int run_depth(CLI::App& app, const Arguments& arguments);
/// Whether the runs that change nothing gave the recorded bits, and a table of all runs. 1 when
/// those bits differ.
int run_replay(CLI::App& app, const Arguments& arguments);
int run_experiment(CLI::App& app, const Arguments& arguments);
/// Every tick, by the names of the session's view `tick`.
int run_export(CLI::App& app, const Arguments& arguments);
/// Prints where the page of the report is.
int run_report(CLI::App& app, const Arguments& arguments);
/// Checks a protocol, runs it with one participant, or takes sessions out of a study file.
int run_study(CLI::App& app, const Arguments& arguments, const PictureHook& after_picture);
/// Describes each file; says on stderr which could not be read. 1 when there are any.
int run_info(CLI::App& app, const Arguments& arguments);
/// 0: a device can be used, or none is attached and the mouse can be. Throws DeviceError when
/// devices are attached and none can be used. With --check, leads a person through the check; with
/// --simulate, stands in for a service until its input ends.
int run_devices(CLI::App& app, const Arguments& arguments);
int run_bench(CLI::App& app, const Arguments& arguments);

}  // namespace dibhr
