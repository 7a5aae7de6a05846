// `dibhr study`: a protocol checked, run with one participant, its answers reported and its
// sessions taken out.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/commands/command_line.hpp"
#include "app/commands/output.hpp"
#include "app/commands/study/study_check.hpp"
#include "app/commands/study/study_pilot.hpp"
#include "app/commands/study/study_report.hpp"
#include "app/settings/assets_path.hpp"
#include "app/settings/command_options.hpp"
#include "app/settings/consent.hpp"
#include "app/settings/material.hpp"
#include "app/settings/settings.hpp"
#include "app/settings/study_values.hpp"
#include "app/study/study_window.hpp"
#include "app/window/crash_handler.hpp"
#include "app/window/crash_note.hpp"
#include "app/window/shutdown_watchdog.hpp"
#include "core/error.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/spelling.hpp"
#include "core/haptics/enum_names.hpp"
#include "core/realtime/now.hpp"
#include "core/report/report_sentences.hpp"
#include "core/study/protocol.hpp"
#include "core/study/study_file.hpp"
#include "core/study/study_run.hpp"
#include "core/study_report/study_plan.hpp"
#include "core/video/frames/cleaning_options.hpp"
#include "core/video/sources/media.hpp"
#include "core/video/sources/picture_files.hpp"
#include "device/hand/guardian.hpp"
#include "device/hand_device.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

struct StudyOptions {
    std::string action{};
    /// A protocol or its name; of sessions a study file, of report study files and folders of them.
    std::vector<fs::path> files{};
    std::string participant{};
    std::optional<int> number{};
    fs::path out{};  ///< a folder
    std::string pilot{};
    std::string device{"auto"};
    fs::path firmware{};
    bool mute{false};
    bool must_be_sure{false};  ///< --sure
    std::optional<std::pair<int, int>> size{};
    AnalysisSettings analysis{};
    PlanSettings plan{};
    std::vector<PlotFormat> plot_formats{PlotFormat::png};
    PictureHook after_picture{};

    [[nodiscard]] const fs::path& file() const { return files.front(); }
    [[nodiscard]] fs::path folder() const { return out.empty() ? fs::path(".") : out; }
};

/// Opens media as a trial does. A page cannot state what its depth means.
void require_media(const fs::path& colour, const fs::path& depth, bool must_be_sure) {
    const auto media = open_media(colour, depth, usual_depth_request());
    report_doubt(media->description(), must_be_sure, StatedBy::sidecar);
}

/// `files`: also opens media, pictures and bump maps, so that errors are reported before a
/// participant sits down.
AllowedNames allowed_names(bool files, bool must_be_sure = false) {
    AllowedNames names;
    const MaterialNames materials = material_names();
    names.materials = materials.shipped;
    names.materials->insert(names.materials->end(), materials.own.begin(), materials.own.end());
    names.materials->emplace_back(kAsRecorded);
    names.thickest_finger_mm = kThickestFinger_mm;
    names.checks.values = validate_values;
    if (!files) return names;
    names.checks.media = [must_be_sure](const StudyMedia& media) {
        require_media(media.colour, media.depth, must_be_sure);
    };
    names.checks.picture = [](const fs::path& picture) {
        static_cast<void>(read_colour_picture(picture));
    };
    names.checks.bump = [](const fs::path& bump) { static_cast<void>(read_bump_map(bump)); };
    return names;
}

/// A file, or a study that comes with the program by its name.
fs::path protocol_named(const fs::path& name) {
    std::error_code failed;
    if (fs::exists(name, failed)) return name;
    const fs::path folder = shipped_studies_folder();
    const std::vector<std::string> shipped = toml_names_in(folder);
    if (std::ranges::find(shipped, name.string()) != shipped.end())
        return folder / (name.string() + ".toml");
    throw InputError(shown(name) + " is neither a file nor a study that comes with the program (" +
                     listed(shipped) + ")" + did_you_mean(name.string(), shipped));
}

/// Checks the built-in sample, which a page does not list.
void require_sample(bool must_be_sure) {
    const SampleFiles files = sample_files();
    require_media(files.colour, files.depth, must_be_sure);
}

int check(const StudyOptions& options) {
    const fs::path file = protocol_named(options.file());
    const Protocol protocol = read_protocol(file, allowed_names(true, options.must_be_sure));
    require_sample(options.must_be_sure);
    print_protocol(protocol);
    std::cout << "media, materials and pictures are there\n";
    for (const UnsafeSetting& doubt : unsafe_settings_of(protocol, Consent()))
        std::cout << "protects the hand less: " << doubt.what << ' ' << doubt.requested
                  << ", to be agreed to before its first page\n";
    print_readiness(protocol);
    return 0;
}

int number_of(const StudyOptions& options) {
    if (options.number) return *options.number;
    if (const auto number = number_in(options.participant)) return *number;
    throw UsageError(
        "the label " + in_quotes(options.participant) +
        " does not end in a number from 1 to 1000000: give --number, which chooses the order");
}

StudyIdentity identity_of(const StudyOptions& options, const Protocol& protocol,
                          const fs::path& file) {
    return {.participant = options.participant,
            .number = number_of(options),
            .program = "dibhr " DIBHR_VERSION,
            .protocol_name = file.filename().string(),
            .protocol_text = protocol.text,
            .protocol_sha256 = protocol.sha256,
            .seed = protocol.seed,
            .created_s = utc_now_s(),
            .pilot = options.pilot};
}

/// Runs the study in a window until the person finishes or leaves.
void run_with_person(const StudyOptions& options, StudyRun& run, StudyFile& file) {
    CrashNote crash_note;
    const CrashHandler crash(crash_note, &Guardian::alarm);
    ShutdownWatchdog shutdown(crash_note);
    StudyWindowOptions window_options{.size = options.size,
                                      .settings = load_settings(settings_path()),
                                      .after_picture = options.after_picture};
    if (moves_hand(options.device)) {
        Consent().replace_unsafe_and_warn(window_options.settings, settings_path());
        window_options.unsafe_settings = unsafe_settings_of(run.protocol(), Consent());
    }
    if (options.mute) window_options.settings.mute = true;
    HandDevice hand =
        make_hand_device(options.device, {window_options.settings.devices, options.firmware});
    StudyWindow window(window_options, run, file, std::move(hand), shutdown);
    window.lead();
}

int run(const StudyOptions& options) {
    if (options.participant.empty())
        throw UsageError("run needs --participant LABEL (see dibhr study --help)");
    require_label(options.participant);
    const fs::path page = protocol_named(options.file());
    const bool with_person = options.pilot.empty();
    const Protocol protocol = read_protocol(page, allowed_names(with_person, options.must_be_sure));
    std::optional<Pilot> pilot;
    if (with_person)
        require_sample(options.must_be_sure);
    else
        pilot = parse_pilot(options.pilot, protocol);
    std::error_code ignored;
    make_folders(options.folder(), ignored);
    StudyFile file(study_file_of(options.folder(), options.participant),
                   identity_of(options, protocol, page));
    StudyRun steps(protocol, file.identity().number, file.answered());
    const bool finished = steps.step() == StudyStep::thanks;
    if (finished) {
        file.finish();
        std::cout << file.file().string() << ": is finished\n";
        return 0;
    }
    const std::vector<std::string> others = labels_of_number(options.folder(), file.identity());
    if (file.answered().empty() && !others.empty())
        print_warning("the number " + std::to_string(file.identity().number) +
                      " chooses the order of " + listed(others) +
                      ", too. To give another person another order, leave the study, delete " +
                      file.file().string() + " and give another --participant or --number");
    if (!file.answered().empty())
        std::cout << "goes on at trial " << file.answered().size() + 1 << '\n';
    pilot ? run_pilot(steps, file, *pilot) : run_with_person(options, steps, file);
    std::cout << file.file().string() << ": "
              << counted(static_cast<std::int64_t>(steps.answered().size()), "trial")
              << (steps.step() == StudyStep::finished
                      ? ""
                      : "; run it again with the same label to go on")
              << '\n';
    return 0;
}

int extract_sessions(const StudyOptions& options) {
    const StudyRecord study = read_study(options.file());
    print_warning(study.warning);
    std::error_code ignored;
    make_folders(options.folder(), ignored);
    int written = 0;
    for (std::size_t k = 0; k < study.answered.size(); ++k) {
        const int trial = study.answered[k].trial.number;
        if (study.session_bytes[k] == 0) continue;
        if (write_study_session(options.file(), trial,
                                options.folder() / session_name(study, trial)))
            ++written;
    }
    if (written == 0)
        throw InputError(shown(options.file()) +
                         " holds no session: a pilot that only answers records none");
    std::cout << counted(written, "session") << " in " << options.folder().string() << '\n';
    return 0;
}

int report(const StudyOptions& options) {
    if (options.out.empty())
        throw UsageError("report needs --out DIR, the folder it is written to");
    return report_studies(options.files, {.folder = options.out,
                                          .program = "dibhr " DIBHR_VERSION,
                                          .analysis = options.analysis,
                                          .plot_formats = options.plot_formats});
}

constexpr std::array<NamedValue<Curve>, 3> kCurves{
    {{Curve::logistic, "logistic", "Logistic"},
     {Curve::cumulative_gaussian, "gaussian", "Cumulative Gaussian"},
     {Curve::weibull, "weibull", "Weibull"}}};

Curve curve_named(const std::string& name) {
    if (const auto curve = value_named(kCurves, name)) return *curve;
    throw UsageError("--curve is one of " + listed(all_names(kCurves)) + ", not " +
                     in_quotes(name) + did_you_mean(name, all_names(kCurves)));
}

int plan(const StudyOptions& options) {
    if (options.pilot.empty())
        throw UsageError(
            "plan needs --pilot, the effect that is to be found, as "
            "prefer=CONDITION,share=0.7,spread=0.1 (see dibhr study --help)");
    const Protocol protocol = read_protocol(protocol_named(options.file()), allowed_names(false));
    PlanSettings settings = options.plan;
    settings.effect = simulated_participant(options.pilot);
    require_preferred(protocol, settings.effect);
    std::vector<PlanLine> lines;
    {
        ProgressBar bar("simulating studies");
        settings.progress = [&bar](double share) { bar.show(share); };
        lines = plan_of(protocol, settings);
    }
    std::cout << plan_text(lines, settings);
    return 0;
}

void add_options(CLI::App& app, StudyOptions& options) {
    app.add_option("ACTION", options.action,
                   "check a protocol, plan how many people it needs, run it with one participant, "
                   "report what was answered, or take the sessions out of a study file")
        ->required()
        ->type_name("");
    app.add_option_function<std::vector<std::string>>(
           "FILE",
           [&options](const std::vector<std::string>& files) {
               options.files.assign(files.begin(), files.end());
           },
           "The protocol: a file, or a study that comes with dibhr; for sessions a study file; for "
           "report study files, or folders of them")
        ->required()
        ->type_name("...");
    app.add_option("--participant", options.participant,
                   "Label of who takes part: letters, digits, - and _; never a name")
        ->type_name("LABEL");
    app.add_option_function<int>(
           "--number", [&options](int number) { options.number = number; },
           "Chooses the order; without it the number at the label's end")
        ->check(CLI::Range(1, 1000000))
        ->type_name("N");
    add_file(app, "--out", options.out,
             "Folder for study files (run), for sessions (sessions; by default the current "
             "folder), or for the report (report)",
             "DIR");
    app.add_option_function<std::string>(
           "--pilot",
           [&options](const std::string& how) {
               if (how.empty())
                   throw CLI::ValidationError(
                       "--pilot", "is empty: give guess, hand or NAME=VALUE, or leave it out");
               options.pilot = how;
           },
           "A simulated participant: guess, hand, or "
           "threshold=..,slope=..,lapse=..,prefer=CONDITION,share=..; for plan the effect that is "
           "to be found, with spread=.. for how people differ")
        ->type_name("HOW");
    add_device_option(app, options.device);
    add_firmware(app, options.firmware);
    app.add_flag("--mute", options.mute, "Touch makes no sound");
    add_size_option(
        app, options.size,
        "Size of the window for the participant; without this option the window fills the screen");
    add_number_option(app, "--power", 0.5, 0.999,
                      "Share of studies that are to find the effect (power)",
                      [&options](double power) { options.plan.power = power; })
        ->default_str("0.8")
        ->type_name("SHARE");
    app.add_option("--studies", options.plan.studies,
                   "Studies that are simulated for each line of a plan")
        ->check(CLI::Range(20, 100000))
        ->default_str("400")
        ->type_name("N");
    app.add_option_function<std::string>(
           "--curve",
           [&options](const std::string& name) { options.analysis.curve = curve_named(name); },
           "Psychometric function of a report: " + listed(all_names(kCurves)))
        ->default_str("logistic")
        ->type_name("NAME");
    app.add_option(
           "--bootstraps", options.analysis.bootstraps,
           "Simulated studies from which the interval of each threshold is made (bootstrap)")
        ->check(CLI::Range(19, 100000))
        ->default_str("399")
        ->type_name("N");
    add_plot_format_option(app, options.plot_formats);
    add_sure_option(app, options.must_be_sure);
    app.footer(
        "A study file is made for each participant, LABEL.dibhr-study; the same label goes on "
        "where "
        "it stopped.\n\n"
        "Examples:\n"
        "  dibhr study check paper-question\n"
        "  dibhr study plan paper-question --pilot prefer=dibhr,share=0.7,spread=0.1\n"
        "  dibhr study run paper-question --participant P07 --out answers\n"
        "  dibhr study run paper-question --participant P90 --out pilots --pilot guess\n"
        "  dibhr study run mine.toml --participant P08 --pilot threshold=0.1,slope=20,lapse=0.02\n"
        "  dibhr study report answers --out answers/report\n"
        "  dibhr study sessions answers/P07.dibhr-study --out sessions");
}

}  // namespace

int run_study(CLI::App& app, const Arguments& arguments, const PictureHook& after_picture) {
    StudyOptions options;
    options.after_picture = after_picture;
    add_options(app, options);
    if (!parse(app, arguments)) return 0;
    if (options.action == "report") return report(options);
    const std::vector<std::pair<std::string, int (*)(const StudyOptions&)>> of_one_file{
        {"check", check}, {"plan", plan}, {"run", run}, {"sessions", extract_sessions}};
    for (const auto& [name, act] : of_one_file) {
        if (options.action != name) continue;
        if (options.files.size() > 1)
            throw UsageError("study " + name + " takes one file, not " +
                             std::to_string(options.files.size()) + " (see dibhr study --help)");
        return act(options);
    }
    const std::vector<std::string> actions{"check", "plan", "run", "report", "sessions"};
    throw UsageError("study does not know " + in_quotes(options.action) +
                     ": its words are check, plan, run, report and sessions" +
                     did_you_mean(options.action, actions) + " (see dibhr study --help)");
}

}  // namespace dibhr
