// Writes an archive: every session and study, then the media, the pages and the manifest.
#include "core/archive/archive.hpp"

#include <map>
#include <system_error>
#include <utility>

#include "core/archive/archive_layout.hpp"
#include "core/archive/archive_media.hpp"
#include "core/archive/archive_pages.hpp"
#include "core/archive/trial_table.hpp"
#include "core/archive/without_folders.hpp"
#include "core/error.hpp"
#include "core/files/content_hash.hpp"
#include "core/files/csv_table.hpp"
#include "core/files/new_folder.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/session/session.hpp"
#include "core/session/session_schema.hpp"
#include "core/sqlite/csv_rows.hpp"
#include "core/study/study_file.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

// Shares of the work.
constexpr double kTables = 0.7;
constexpr double kMedia = 0.2;

constexpr const char* kProtocols = "protocols";

std::string text_in(const fs::path& file) {
    return one_line(file.string());
}

/// What this dibhr does not know, it cannot clear of folders.
void require_known_schema(const Session& session) {
    Statement row = session.reader().rows("PRAGMA user_version");
    if (row.next() && row.integer(0) <= kSessionSchemaVersion) return;
    throw InputError(session.file().string() +
                     ": was recorded by a newer dibhr, whose facts this one cannot clear of "
                     "folders; update dibhr");
}

class ArchiveWriter {
  public:
    explicit ArchiveWriter(const ArchiveRequest& request)
        : request_(request), folder_(request.folder) {}

    ArchiveSummary write() {
        for (const fs::path& file : request_.files) {
            if (file.extension() == kStudyEnding)
                add_study(file);
            else
                add_session(file);
            ++files_done_;
        }
        summary_.participants = participants_.all().size();
        if (request_.copy_media)
            for (std::string& sentence : media_.copy(archive(), [this](double share) {
                     request_.progress(kTables + kMedia * share);
                 }))
                summary_.warnings.push_back(std::move(sentence));
        media_.write_list(archive());
        write_pages(archive(), request_, summary_, participants_.all());
        write_manifest();
        request_.progress(1.0);
        folder_.commit();
        return summary_;
    }

  private:
    [[nodiscard]] const fs::path& archive() const noexcept { return folder_.written(); }

    void show(double share_of_file) const {
        request_.progress(kTables * (static_cast<double>(files_done_) + share_of_file) /
                          static_cast<double>(request_.files.size()));
    }

    /// Where a session or study is kept; makes its folder.
    [[nodiscard]] fs::path source_place(const std::string& participant, const std::string& name) {
        const fs::path place = fs::path(kSources) / participant / name;
        std::error_code failed;
        make_folders((archive() / place).parent_path(), failed);
        return place;
    }

    void add_session(const fs::path& file) {
        std::string participant;
        std::string run;
        fs::path place;
        {
            Session original(file);
            original.rescue_if_damaged();
            require_known_schema(original);
            if (!original.warning().empty()) summary_.warnings.push_back(original.warning());
            participant = participants_.name_of(original.fact("participant"));
            run = run_name(participant, kTouchTask, ++runs_[participant]);
            place = source_place(participant, run + kSessionEnding);
            copy(original, archive() / place);
        }
        remove_folders_of(archive() / place, file);
        add_tables(archive() / place, participant, run, {.file = place.generic_string()});
    }

    /// Of a damaged one, what can be read.
    void copy(const Session& session, const fs::path& to) const {
        const SessionReader& reader = session.reader();
        if (!reader.is_rescued())
            return copy_database(reader.file(), to, reader.log() != SessionReader::Log::needed);
        try {
            Statement copy = reader.rows("VACUUM INTO ?");
            copy.bind(std::string_view(to.native()));
            static_cast<void>(copy.next());
        } catch (const InputError&) {  // what it reads are tables of dibhr's own
            throw InputError(text_in(request_.folder) + ": what can be read of " +
                             text_in(session.file()) +
                             " cannot be written there; make room, also in TMPDIR");
        }
    }

    void remove_folders_of(const fs::path& session, const fs::path& original) {
        remove_folders(session,
                       [&](const FileContent& media) { return media_.name_for(media, original); });
    }

    /// Tables of ticks and marks.
    void add_tables(const fs::path& file, const std::string& participant, const std::string& run,
                    const TableSource& source) {
        const Session session(file);
        const fs::path ticks = table_of(participant, run, "ticks");
        write_table(archive(), ticks, {}, tick_dictionary(session, source));
        write_ticks(session, archive() / ticks);
        std::string marks = "t,utc_s,tag,text\n";
        for (const SessionMark& mark : session.marks()) {
            append_number(marks, mark.t_s);
            marks += ',';
            if (const auto utc_s = session.utc_at(mark.t_s)) append_number(marks, *utc_s);
            marks += ',' + csv_cell(mark.tag) + ',' + csv_cell(mark.text) + '\n';
        }
        write_table(archive(), table_of(participant, run, "marks"), marks,
                    mark_dictionary(session, source));
        ++summary_.sessions;
    }

    void write_ticks(const Session& session, const fs::path& file) const {
        constexpr std::size_t kPiece_bytes = 1 << 20;
        Statement ticks = session.reader().rows("SELECT * FROM tick ORDER BY tick");
        OutputFile out(file);
        std::string rows;
        append_names(rows, ticks);
        for (std::int64_t done = 0; ticks.next(); ++done) {
            append_row(rows, ticks);
            if (rows.size() < kPiece_bytes) continue;
            out.write(rows);
            rows.clear();
            show(static_cast<double>(done) / static_cast<double>(session.rows()));
        }
        out.write(rows);
        out.commit();
    }

    void add_study(const fs::path& file) {
        std::string participant;
        fs::path place;
        {
            const StudyRecord original = read_study(file);
            if (!original.warning.empty())
                throw InputError(text_in(file) +
                                 ": was made by a newer dibhr, whose tables this one cannot clear "
                                 "of folders; update dibhr");
            participant = participants_.name_of(original.identity.participant);
            const std::string name = run_name(participant, kStudyTask, ++studies_[participant]);
            place = source_place(participant, name + kStudyEnding);
        }
        copy_database(file, archive() / place, false);
        std::map<int, std::string> runs;
        const fs::path scratch = archive() / "trial.dibhr";
        remove_study_folders(archive() / place, scratch, [&](int trial) {
            const TableSource source{.file = place.generic_string(), .trial = trial};
            runs[trial] = add_trial(scratch, participant, source, file);
        });
        const StudyRecord study = read_study(archive() / place);
        const TrialTable trials = trial_table(study, {.file = place.generic_string()},
                                              protocol_place(study.identity), runs);
        write_table(archive(), table_of(participant, place.stem().string(), "trials"), trials.rows,
                    trials.dictionary);
    }

    /// Clears the session of a trial of folders and adds its tables. Returns its run.
    [[nodiscard]] std::string add_trial(const fs::path& session, const std::string& participant,
                                        const TableSource& source, const fs::path& study) try {
        {
            const Session whole(session);
            whole.check();
            require_known_schema(whole);
        }
        remove_folders_of(session, study);
        const std::string run = run_name(participant, kTouchTask, ++runs_[participant]);
        add_tables(session, participant, run, source);
        return run;
    } catch (const InputError& error) {
        throw InputError(text_in(study) + ", trial " + std::to_string(source.trial + 1) + ": " +
                         error.what());
    }

    /// Writes the page of a study, once, and returns its place.
    [[nodiscard]] std::string protocol_place(const StudyIdentity& study) {
        const auto taken = [&](const std::string& name) {
            const auto there = protocols_.find(name);
            return name.empty() ||
                   (there != protocols_.end() && there->second != study.protocol_text);
        };
        const std::string name = free_name(study.protocol_name, taken);
        const fs::path place = fs::path(kProtocols) / name;
        if (protocols_.emplace(name, study.protocol_text).second) {
            std::error_code failed;
            make_folders(archive() / kProtocols, failed);
            write_file(archive() / place, study.protocol_text);
        }
        return place.generic_string();
    }

    void write_manifest() {
        std::vector<fs::path> files;
        for (const auto& entry : fs::recursive_directory_iterator(archive()))
            if (entry.is_regular_file()) files.push_back(entry.path());
        Manifest manifest;
        for (const fs::path& file : files) {
            manifest[file.lexically_relative(archive()).generic_string()] = sha256_of_file(file);
            request_.progress(kTables + kMedia +
                              (1.0 - kTables - kMedia) * static_cast<double>(manifest.size()) /
                                  static_cast<double>(files.size()));
        }
        summary_.files = manifest.size();
        write_file(archive() / kManifest, manifest_text(manifest));
    }

    const ArchiveRequest& request_;
    NewFolder folder_;
    ParticipantNames participants_{};
    ArchiveMedia media_{};
    std::map<std::string, std::size_t> runs_{};       ///< of each participant, so far
    std::map<std::string, std::size_t> studies_{};    ///< likewise
    std::map<std::string, std::string> protocols_{};  ///< texts by their names
    std::size_t files_done_{0};
    ArchiveSummary summary_{};
};

}  // namespace

ArchiveSummary write_archive(const ArchiveRequest& request) {
    return ArchiveWriter(request).write();
}

}  // namespace dibhr
