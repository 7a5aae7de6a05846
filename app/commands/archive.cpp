// `dibhr archive`: sessions and studies as a folder to publish, and the check of such a folder.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "app/commands/batch/stoppable_work.hpp"
#include "app/commands/command_line.hpp"
#include "app/commands/output.hpp"
#include "app/settings/command_options.hpp"
#include "core/archive/archive.hpp"
#include "core/files/plain_text.hpp"
#include "core/report/report_sentences.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

std::string counts_of(const ArchiveSummary& summary) {
    const auto of = [](std::size_t count, const char* thing) {
        return counted(static_cast<std::int64_t>(count), thing);
    };
    return of(summary.sessions, "session") + ", " + of(summary.participants, "participant") + ", " +
           of(summary.files, "file");
}

int check_folder(const fs::path& folder) {
    ArchiveCheck result;
    {
        ProgressBar bar("Checking");
        result = check_archive(folder, [&bar](double share) { bar.show(share); });
    }
    for (const std::string& fault : result.faults) print_error_line(fault);
    if (!result.faults.empty()) return 1;
    std::cout << "complete: " << counts_of(result.found) << '\n';
    return 0;
}

void write_folder(const ArchiveRequest& wanted) {
    ArchiveSummary summary;
    {
        StoppableWork work("Archiving", wanted.folder);
        ArchiveRequest request = wanted;
        request.progress = [&work](double share) { work.show(share); };
        summary = write_archive(request);
    }
    for (const std::string& warning : summary.warnings) print_warning(warning);
    std::cout << wanted.folder.string() << ": " << counts_of(summary) << '\n';
}

}  // namespace

int run_archive(CLI::App& app, const Arguments& arguments) {
    ArchiveRequest request{.program = DIBHR_VERSION};
    std::vector<std::string> files;
    fs::path checked;
    app.add_option("FILES", files, "Sessions and studies, at least one")->type_name("");
    add_file(app, "--out", request.folder, "The new folder", "FOLDER");
    app.add_option_function<std::string>(
           "--media",
           [&request](const std::string& word) {
               if (word != "hashes" && word != "copy")
                   throw CLI::ValidationError("--media",
                                              in_quotes(word) + " is neither hashes nor copy");
               request.copy_media = word == "copy";
           },
           "What it holds of the videos: hashes, or the files, too, where they have not changed")
        ->default_str("hashes")
        ->type_name("hashes|copy");
    app.add_option("--licence,--license", request.licence,
                   "What others may do with the data, such as CC-BY-4.0")
        ->type_name("TEXT");
    app.add_option("--name", request.name, "Name of the data; else the folder's")
        ->type_name("TEXT");
    app.add_option("--author", request.authors, "An author; may be given several times")
        ->type_name("TEXT")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_file(app, "--check", checked, "Checks a folder that this command made", "FOLDER");
    app.footer(
        "The copies name no folder of the computer that recorded them; README.md in the folder "
        "says what is in it.\n\n"
        "Examples:\n"
        "  dibhr archive *.dibhr --out shared --licence CC-BY-4.0 --author \"A. Researcher\"\n"
        "  dibhr archive answers/*.dibhr-study --out shared --media copy\n"
        "  dibhr archive --check shared");
    if (!parse(app, arguments)) return 0;
    if (!checked.empty()) {
        if (!files.empty() || !request.folder.empty())
            throw UsageError("--check takes a folder and nothing else (see dibhr archive --help)");
        return check_folder(checked);
    }
    if (files.empty() || request.folder.empty())
        throw UsageError(
            "archive needs sessions or studies, and --out FOLDER (see dibhr archive --help)");
    request.files.assign(files.begin(), files.end());
    write_folder(request);
    return 0;
}

}  // namespace dibhr
