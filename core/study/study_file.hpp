// One participant's study in one SQLite file: the protocol as it was run, a row for every trial,
// and every trial's session. README.md describes the tables.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/sqlite/application_ids.hpp"
#include "core/study/protocol.hpp"
#include "core/study/trial.hpp"

namespace dibhr {

/// Counts changes of the tables (`PRAGMA user_version`).
inline constexpr int kStudySchemaVersion = 2;
/// "P07.dibhr-study".
inline constexpr const char* kStudyEnding = ".dibhr-study";

/// Whose study it is. Nothing else identifies a person.
struct StudyIdentity {
    std::string participant{};    ///< the label: letters, digits, - and _, at most 40
    int number{0};                ///< by which the order is chosen, from 1
    std::string program{};        ///< "dibhr 1.2.3"
    std::string protocol_name{};  ///< its file's name without folder
    std::string protocol_text{};
    std::string protocol_sha256{};
    std::uint64_t seed{0};  ///< the protocol's
    double created_s{0.0};  ///< wall time since 1970
    std::string pilot{};    ///< how a simulated participant answers; empty: a person does

    bool operator==(const StudyIdentity&) const = default;
};

/// Throws InputError that says what a label may be.
void require_label(const std::string& label);

/// "P07" is participant 7; nothing: it does not end in a number from 1 to 1000000.
[[nodiscard]] std::optional<int> number_in(const std::string& label);

/// The file of a participant in a folder.
[[nodiscard]] std::filesystem::path study_file_of(const std::filesystem::path& folder,
                                                  const std::string& label);

/// Labels of other study files in that folder whose order the same number chooses. For a file that
/// another program has open, the number in its label counts.
[[nodiscard]] std::vector<std::string> labels_of_number(const std::filesystem::path& folder,
                                                        const StudyIdentity& identity);

/// The file of a running study. One program at a time holds its lock, until that process ends.
/// Every call throws InputError: what, which file, what to do next.
class StudyFile {
  public:
    /// Makes the file, or goes on with one of the same participant, number, protocol text and
    /// pilot. Refused: a file of another protocol, and one that another program has open.
    StudyFile(const std::filesystem::path& file, const StudyIdentity& identity);
    ~StudyFile();
    StudyFile(const StudyFile&) = delete;
    StudyFile& operator=(const StudyFile&) = delete;

    [[nodiscard]] const std::filesystem::path& file() const noexcept;
    /// The identity in the file, with which the study began.
    [[nodiscard]] const StudyIdentity& identity() const noexcept;
    /// The trials in the file when it was opened, in order.
    [[nodiscard]] const std::vector<AnsweredTrial>& answered() const noexcept;
    /// A trial's answer and its session (empty: none was recorded), whole or not at all, on the
    /// disk when it returns. The session's file is then removed.
    void add(const AnsweredTrial& answered, const std::filesystem::path& session = {});
    /// The last trial was answered.
    void finish();
    /// Where the running trial's session is recorded: a path beside the file. Removes what a killed
    /// program left there.
    [[nodiscard]] std::filesystem::path new_session_file() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// A study file as it is read.
struct StudyRecord {
    std::filesystem::path file{};
    StudyIdentity identity{};
    bool finished{false};
    std::vector<AnsweredTrial> answered{};      ///< in order
    std::vector<std::int64_t> session_bytes{};  ///< of each of them; 0: none
    std::string warning{};  ///< of a later schema: what of it is not read; empty: all is
};

/// Reads all but the sessions; of a file of a later schema what is known here. Throws InputError
/// for a file that is missing, foreign, damaged or being run.
[[nodiscard]] StudyRecord read_study(const std::filesystem::path& file);

/// "P07-003.dibhr": participant and trial, from 1; never a condition's name.
[[nodiscard]] std::string session_name(const StudyRecord& study, int trial);

/// Writes one trial's session as a file of its own, which Session reads, with the label as its
/// participant and title and trial as its note. False: there is none.
/// Throws InputError.
bool write_study_session(const std::filesystem::path& study, int trial,
                         const std::filesystem::path& session);

}  // namespace dibhr
