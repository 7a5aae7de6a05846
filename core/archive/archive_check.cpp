// Checks an archive: its sums, its names, and that its tables say what the recordings say.
#include <algorithm>
#include <fstream>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "core/archive/archive.hpp"
#include "core/archive/archive_layout.hpp"
#include "core/archive/dictionary.hpp"
#include "core/error.hpp"
#include "core/files/content_hash.hpp"
#include "core/files/names.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/scratch_folder.hpp"
#include "core/session/session.hpp"
#include "core/study/study_file.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

/// The column names and the number of rows of a table.
struct TableShape {
    std::vector<std::string> columns{};
    std::int64_t rows{0};
};

TableShape shape_of(const fs::path& table) {
    TableShape shape;
    std::ifstream in(table, std::ios::binary);
    std::string line;
    std::getline(in, line);
    for (std::size_t at = 0; at <= line.size();) {
        const std::size_t end = std::min(line.find(',', at), line.size());
        shape.columns.push_back(line.substr(at, end - at));
        at = end + 1;
    }
    while (std::getline(in, line)) ++shape.rows;
    return shape;
}

Json json_in(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    Json json = parsed_json(std::string(std::istreambuf_iterator<char>(in), {}));
    return json.is_object() ? json : Json::object();
}

/// The columns that a sidecar explains, in order.
std::vector<std::string> explained_columns(const Json& sidecar) {
    std::vector<std::string> columns;
    for (const auto& [name, member] : sidecar.items())
        if (member.is_object() && member.contains(kDescription)) columns.push_back(name);
    return columns;
}

class ArchiveChecker {
  public:
    ArchiveChecker(const fs::path& folder, const std::function<void(double)>& progress)
        : folder_(folder), progress_(progress), manifest_(read_manifest(folder)) {}

    ArchiveCheck check() {
        list_files();
        check_sums();
        check_participants();
        for (const std::string& file : there_)
            if (file.ends_with(".csv")) guarded(file, [&] { check_sidecar(file); });
        for (const std::string& file : there_)
            if (file.starts_with(std::string(kSources) + "/"))
                guarded(file, [&] { check_source(file); });
        check_.found.files = manifest_.size();
        return std::move(check_);
    }

  private:
    void fault(const std::string& file, const std::string& what) {
        check_.faults.push_back(one_line(file) + ": " + what);
    }

    /// A file that cannot be read is a fault, and the next one is checked.
    template <typename Work>
    void guarded(const std::string& file, const Work& work) {
        try {
            work();
        } catch (const InputError& error) {
            fault(file, error.what());
        } catch (const fs::filesystem_error& error) {
            fault(file, error.what());
        }
    }

    void list_files() {
        for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
            if (entry.is_directory() && !entry.is_symlink()) continue;
            const std::string file = entry.path().lexically_relative(folder_).generic_string();
            if (file == kManifest) continue;
            if (!manifest_.contains(file))
                fault(file, "is not in the manifest; remove it");
            else
                there_.insert(file);
        }
    }

    void check_sums() {
        constexpr double kOfWork = 0.7;
        std::size_t done = 0;
        for (const auto& [file, sum] : manifest_) {
            if (!there_.contains(file))
                fault(file, "is missing; copy it again");
            else
                guarded(file, [&, &name = file, &expected = sum] {
                    if (sha256_of_file(folder_ / name) != expected)
                        fault(name, "has changed since the archive was made; copy it again");
                });
            progress_(kOfWork * static_cast<double>(++done) /
                      static_cast<double>(manifest_.size()));
        }
    }

    void check_participants() {
        std::set<std::string> listed;
        std::ifstream in(folder_ / kParticipants);
        std::string line;
        std::getline(in, line);
        while (std::getline(in, line)) listed.insert(line.substr(0, line.find('\t')));
        check_.found.participants = listed.size();
        std::set<std::string> folders;
        for (const fs::path& entry : entries_of(folder_))
            if (const std::string name = entry.filename().string();
                is_folder(entry) && name.starts_with("sub-"))
                folders.insert(name);
        for (const std::string& name : listed)
            if (!folders.contains(name))
                fault(kParticipants, "names " + one_line(name) + ", which has no folder");
        for (const std::string& name : folders)
            if (!listed.contains(name))
                fault(kParticipants, "does not name " + one_line(name) + ", which has a folder");
    }

    void check_sidecar(const std::string& table) {
        const fs::path sidecar = sidecar_of(folder_ / table);
        if (explained_columns(json_in(sidecar)) != shape_of(folder_ / table).columns)
            fault(table, "has other columns than " + sidecar.filename().string() + " explains");
    }

    void check_rows(const fs::path& table, std::int64_t expected, const std::string& whose) {
        const std::string name = table.generic_string();
        // One that the manifest has and the folder has not is a fault already.
        if (!there_.contains(name)) {
            if (!manifest_.contains(name)) fault(whose, "has no table " + name);
            return;
        }
        const std::int64_t rows = shape_of(folder_ / table).rows;
        if (rows != expected)
            fault(name, "has " + std::to_string(rows) + " rows, and " + whose + " has " +
                            std::to_string(expected));
    }

    void check_source(const std::string& file) {
        const fs::path place = folder_ / file;
        const std::string participant = place.parent_path().filename().string();
        if (file.ends_with(kStudyEnding)) {
            check_study(file, participant);
        } else if (file.ends_with(kSessionEnding)) {
            check_session(place, participant, place.stem().string(), file);
        } else {
            fault(file, "is neither a session nor a study; remove it");
        }
    }

    void check_session(const fs::path& session, const std::string& participant,
                       const std::string& run, const std::string& whose) {
        const Session recorded(session);
        recorded.check();
        ++check_.found.sessions;
        check_rows(table_of(participant, run, "ticks"), recorded.rows(), whose);
        check_rows(table_of(participant, run, "marks"), std::ssize(recorded.marks()), whose);
    }

    void check_study(const std::string& file, const std::string& participant) {
        const StudyRecord study = read_study(folder_ / file);
        const fs::path trials = table_of(participant, fs::path(file).stem().string(), "trials");
        check_rows(trials, std::ssize(study.answered), file);
        const Json sidecar = json_in(sidecar_of(folder_ / trials));
        const Json runs = sidecar.contains(kRuns) ? sidecar[kRuns] : Json::object();
        const auto recorded = std::ranges::count_if(study.session_bytes,
                                                    [](std::int64_t bytes) { return bytes > 0; });
        if (std::ssize(runs) != recorded)
            fault(file, "holds " + std::to_string(recorded) + " sessions, and " +
                            sidecar_of(trials).generic_string() + " names " +
                            std::to_string(runs.size()) + " runs");
        const ScratchFolder scratch("the sessions of studies are read from there");
        const fs::path session = scratch.path() / "trial.dibhr";
        for (const auto& [run, trial] : runs.items()) {
            const std::string whose = file + ", the session of " + run + ",";
            if (trial.is_number_integer() &&
                write_study_session(folder_ / file, trial.get<int>(), session))
                check_session(session, participant, run, whose);
            else
                fault(file, "holds no session for " + run);
        }
    }

    fs::path folder_;
    const std::function<void(double)>& progress_;
    Manifest manifest_;
    std::set<std::string> there_{};  ///< files of the manifest
    ArchiveCheck check_{};
};

}  // namespace

ArchiveCheck check_archive(const fs::path& folder, const std::function<void(double)>& progress) {
    return ArchiveChecker(folder, progress).check();
}

}  // namespace dibhr
