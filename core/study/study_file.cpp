// The tables of a study, written trial by trial and read back.
#include "core/study/study_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/json.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/write_failure.hpp"
#include "core/sqlite/database.hpp"
#include "core/study/toml_page.hpp"

namespace dibhr {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLongestLabel = 40;
constexpr int kMostNumber = 1000000;            ///< of a participant
constexpr int kLongestSession_bytes = 1 << 30;  ///< a trial's; an hour's recording has less

constexpr const char* kTables =
    "CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID;"
    "CREATE TABLE trial (trial INTEGER PRIMARY KEY, block INTEGER, position INTEGER, "
    "practice INTEGER, form TEXT, item INTEGER, repetition INTEGER, target INTEGER, "
    "track INTEGER, level REAL, choice INTEGER, number REAL, right INTEGER, reaction_s REAL, "
    "utc_s REAL, early INTEGER);"
    "CREATE TABLE interval (trial INTEGER, interval INTEGER, condition TEXT, value REAL, "
    "\"values\" TEXT, PRIMARY KEY (trial, interval)) WITHOUT ROWID;"
    "CREATE TABLE session (trial INTEGER PRIMARY KEY, file BLOB);"
    "CREATE TABLE explanation (\"table\" TEXT, \"column\" TEXT, meaning TEXT);"
    "INSERT INTO explanation VALUES "
    "('trial', 'trial', 'number in this study, from 0'),"
    "('trial', 'block', 'in the protocol, from 0'),"
    "('trial', 'position', 'in its block, from 0'),"
    "('trial', 'practice', '1: counts for nothing'),"
    "('trial', 'item', 'condition or pair of the block, from 0'),"
    "('trial', 'repetition', 'how often it came before'),"
    "('trial', 'target', 'interval of the comparison, or the odd one; -1: none'),"
    "('trial', 'track', 'of interleaved staircases; -1: none'),"
    "('trial', 'level', 'comparison minus reference in the varied parameter; NULL: none varies'),"
    "('trial', 'choice', 'interval or answer, from 0; -1: none'),"
    "('trial', 'number', 'rating, or value turned to'),"
    "('trial', 'right', '1: right, 0: wrong, NULL: nothing is'),"
    "('trial', 'reaction_s', 'from when the question was on the screen, or an adjustment was first "
    "felt, until the key or button went down'),"
    "('trial', 'utc_s', 'of the answer, since 1970'),"
    "('interval', 'value', 'of the varied parameter; NULL: none varies'),"
    "('interval', 'values', 'all that was set, as JSON'),"
    "('session', 'file', 'the trial''s ticks: a file that ends in .dibhr');";

/// Since version 2.
constexpr const char* kExplainEarly =
    "INSERT INTO explanation VALUES ('trial', 'early', 'keys and buttons of an answer that were "
    "pressed before the question was on the screen, and dropped; NULL: not counted');";

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
    throw InputError(one_line(file.string() + ": " + what));
}

/// Turns SQLite's error into an InputError with the file and the next step.
Database::ErrorHandler refusal_of(const fs::path& file) {
    return [file](const DatabaseError& error) {
        const std::string words = error.what();
        if (words.find("locked") != std::string::npos)
            refuse(file, "is being run by another program: end that first");
        refuse(file, "cannot be used (" + words + "): make room, or take a copy that is whole");
    };
}

/// A file that holds nothing is an empty database.
void make_if_missing(const fs::path& file) {
    const int made = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (made < 0) refuse(file, write_failure(errno) + " (--out)");
    ::close(made);
}

std::string json_text(const TouchValues& values) {
    Json json = Json::object();
    for (const auto& [name, number] : values.numbers) json[name] = number;
    for (const auto& [name, word] : values.words) json[name] = word;
    return json_line(json);
}

TouchValues values_in(const std::string& text, const fs::path& file) {
    TouchValues values;
    const auto json = parsed_json(text);
    if (!json.is_object()) refuse(file, "is damaged: the values of an interval are no JSON object");
    for (const auto& [name, value] : json.items()) {
        if (value.is_number()) values.numbers[name] = value.get<double>();
        if (value.is_string()) values.words[name] = value.get<std::string>();
    }
    return values;
}

/// The facts of table study, in the order in which they are written.
std::vector<std::pair<const char*, std::string>> facts_of(const StudyIdentity& identity) {
    return {{"participant", identity.participant},
            {"number", std::to_string(identity.number)},
            {"program", identity.program},
            {"protocol_name", identity.protocol_name},
            {"protocol", identity.protocol_text},
            {"protocol_sha256", identity.protocol_sha256},
            {"seed", std::to_string(identity.seed)},
            {"created_s", number_text(identity.created_s)},
            {"pilot", identity.pilot},
            {"schema_version", std::to_string(kStudySchemaVersion)},
            {"units", "s, and those of dibhr's options"}};
}

std::string fact(const Database& database, const std::string& key) {
    Statement rows(database, "SELECT value FROM study WHERE key = '" + key + "'");
    return rows.next() ? rows.text(0) : std::string();
}

double number_fact(const Database& database, const std::string& key) {
    return number_of_text(fact(database, key)).value_or(0.0);
}

/// Repeats the checks of a new study: the file may be damaged or made by hand.
StudyIdentity identity_in(const Database& database, const fs::path& file) {
    const double number = number_fact(database, "number");
    if (!(number >= 1.0 && number <= kMostNumber))
        refuse(file, "is damaged or made by hand: the participant's number is not one from 1 to " +
                         std::to_string(kMostNumber));
    StudyIdentity identity{
        .participant = fact(database, "participant"),
        .number = static_cast<int>(number),
        .program = fact(database, "program"),
        .protocol_name = fact(database, "protocol_name"),
        .protocol_text = fact(database, "protocol"),
        .protocol_sha256 = fact(database, "protocol_sha256"),
        .seed = static_cast<std::uint64_t>(std::clamp(number_fact(database, "seed"), 0.0, 0x1p63)),
        .created_s = number_fact(database, "created_s"),
        .pilot = fact(database, "pilot")};
    try {
        require_label(identity.participant);
    } catch (const InputError& error) {
        refuse(file, std::string("is damaged or made by hand: ") + error.what());
    }
    return identity;
}

std::vector<StudyInterval> intervals_in(const Database& database, int trial, const fs::path& file) {
    std::vector<StudyInterval> intervals;
    Statement rows(database, "SELECT condition, value, \"values\" FROM interval WHERE trial = " +
                                 std::to_string(trial) + " ORDER BY interval");
    while (rows.next()) {
        StudyInterval interval{.condition = rows.text(0), .values = values_in(rows.text(2), file)};
        if (rows.has(1)) interval.value = rows.real(1);
        intervals.push_back(std::move(interval));
    }
    return intervals;
}

std::int64_t version_of(const Database& database) {
    return database.number("PRAGMA user_version");
}

std::vector<AnsweredTrial> answered_in(const Database& database, const fs::path& file) {
    std::vector<AnsweredTrial> all;
    Statement rows(
        database, std::string("SELECT trial, block, position, practice, form, item, repetition, "
                              "target, track, level, choice, number, right, reaction_s, utc_s, ") +
                      (version_of(database) < 2 ? "NULL" : "early") + " FROM trial ORDER BY trial");
    const auto whole = [&rows](int column) { return static_cast<int>(rows.integer(column)); };
    while (rows.next()) {
        if (rows.integer(0) != static_cast<std::int64_t>(all.size()))
            refuse(file, "is damaged: the trial after " + std::to_string(all.size()) +
                             " others has the number " + std::to_string(rows.integer(0)));
        const auto form = value_named(kTrialForms, rows.text(4));
        if (!form) refuse(file, "is damaged: a trial has the form " + in_quotes(rows.text(4)));
        AnsweredTrial one{.trial = {.number = whole(0),
                                    .block = whole(1),
                                    .position = whole(2),
                                    .practice = whole(3) != 0,
                                    .form = *form,
                                    .item = whole(5),
                                    .repetition = whole(6),
                                    .target = whole(7),
                                    .track = whole(8)},
                          .answer = {.choice = whole(10), .reaction_s = rows.real(13)},
                          .utc_s = rows.real(14)};
        if (rows.has(9)) one.trial.level = rows.real(9);
        if (rows.has(11)) one.answer.number = rows.real(11);
        if (rows.has(12)) one.right = whole(12) != 0;
        if (rows.has(15)) one.answer.early = whole(15);
        one.trial.intervals = intervals_in(database, one.trial.number, file);
        all.push_back(std::move(one));
    }
    return all;
}

void require_kind(const Database& database, const fs::path& file) {
    if (database.number("PRAGMA application_id") != kStudyApplicationId || version_of(database) < 1)
        refuse(file, "is not a study of dibhr: name a file that dibhr study run made");
}

/// Only the dibhr of its version, or a later one, writes into a study.
void require_writable_version(const Database& database, const fs::path& file) {
    const std::int64_t version = version_of(database);
    if (version > kStudySchemaVersion)
        refuse(file, "is a study of another version (" + std::to_string(version) + "; this is " +
                         std::to_string(kStudySchemaVersion) + "): use the program that made it");
}

/// Empty: the file is of this version or an earlier one.
std::string later_version(const Database& database, const fs::path& file) {
    const std::int64_t version = version_of(database);
    if (version <= kStudySchemaVersion) return {};
    return one_line(file.string()) + ": was made by a newer dibhr (format " +
           std::to_string(version) + ", this one reads " + std::to_string(kStudySchemaVersion) +
           "); tables and columns that are new in it are not read; update dibhr";
}

/// Opens a study file for reading, and checks it like a new one.
Database opened_study(const fs::path& file) {
    Database database(file, refusal_of(file));
    database.restrict_untrusted(kLongestSession_bytes);
    require_kind(database, file);
    return database;
}

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream bytes;
    bytes << in.rdbuf();
    if (!in || bytes.fail()) refuse(file, "the trial's session cannot be read: check the disk");
    return bytes.str();
}

/// Writes participant and trial into a session, as the facts of an ordinary recording.
void label_session(Database database, const StudyIdentity& identity, int trial,
                   const fs::path& study) {
    const std::string title =
        page_of(identity.protocol_text, study)["title"].value_or(std::string());
    database.restrict_untrusted(kLongestSession_bytes);
    Statement row(database, "INSERT OR REPLACE INTO session(key, value) VALUES (?, ?)");
    row.run("participant", identity.participant);
    row.run("note", title + ", trial " + std::to_string(trial + 1));
}

}  // namespace

void require_label(const std::string& label) {
    const bool fits = is_bare_name(label) && label.size() <= kLongestLabel &&
                      label.front() != '-' && label.front() != '_';
    if (!fits)
        throw InputError(
            in_quotes(label) +
            " is not a label of a participant: use letters, digits, - and _, at most 40, "
            "and a letter or a digit first");
}

std::optional<int> number_in(const std::string& label) {
    std::size_t digits = label.size();
    while (digits > 0 && std::isdigit(static_cast<unsigned char>(label[digits - 1])) != 0) --digits;
    const std::string text = label.substr(digits);
    if (text.empty() || text.size() > 7) return std::nullopt;
    const int number = std::stoi(text);
    if (number < 1 || number > kMostNumber) return std::nullopt;
    return number;
}

fs::path study_file_of(const fs::path& folder, const std::string& label) {
    return folder / (label + kStudyEnding);
}

std::vector<std::string> labels_of_number(const fs::path& folder, const StudyIdentity& identity) {
    std::vector<std::string> labels;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(folder, failed)) {
        const std::string label = entry.path().stem().string();
        if (entry.path().extension() != kStudyEnding || label == identity.participant) continue;
        std::optional<int> number = number_in(label);
        bool same_study = true;
        try {
            const StudyRecord other = read_study(entry.path());
            number = other.identity.number;
            same_study = other.identity.protocol_sha256 == identity.protocol_sha256;
        } catch (const InputError&) {
            // Another program has it open, or it is no study: only its label is known.
        }
        if (same_study && number == identity.number) labels.push_back(label);
    }
    std::sort(labels.begin(), labels.end());
    return labels;
}

struct StudyFile::Implementation {
    fs::path file;
    Database database;
    StudyIdentity identity{};
    std::vector<AnsweredTrial> answered{};

    explicit Implementation(const fs::path& path) : file(path), database(path, refusal_of(path)) {}

    /// Locks the file until the process ends. A pilot can be run again, so only a person's answers
    /// wait for the disk.
    void lock(bool pilot) {
        database.execute(std::string("PRAGMA busy_timeout = 0; PRAGMA locking_mode = EXCLUSIVE; "
                                     "PRAGMA synchronous = ") +
                         (pilot ? "OFF" : "FULL"));
        database.restrict_untrusted(kLongestSession_bytes);
        database.execute("BEGIN EXCLUSIVE; COMMIT");
    }

    void begin(const StudyIdentity& wanted) {
        database.execute(
            "BEGIN IMMEDIATE; PRAGMA application_id = " + std::to_string(kStudyApplicationId) +
            "; PRAGMA user_version = " + std::to_string(kStudySchemaVersion) + ";" + kTables +
            kExplainEarly);
        Statement row(database, "INSERT INTO study VALUES (?, ?)");
        for (const auto& [key, value] : facts_of(wanted)) row.run(key, value);
        database.execute("COMMIT");
        identity = wanted;
    }

    void resume(const StudyIdentity& wanted) {
        require_kind(database, file);
        require_writable_version(database, file);
        identity = identity_in(database, file);
        if (identity.protocol_sha256 != wanted.protocol_sha256)
            refuse(file,
                   "is of another protocol, or another version of it: give another "
                   "--participant or --out, or the protocol it was begun with");
        if (identity.participant != wanted.participant || identity.number != wanted.number)
            refuse(file, "is of participant " + identity.participant + ", number " +
                             std::to_string(identity.number) + ": give these, or another --out");
        if (identity.pilot != wanted.pilot)
            refuse(file, identity.pilot.empty()
                             ? "is a person's: a pilot needs another --participant or --out"
                             : "is of the pilot " + in_quotes(identity.pilot) +
                                   ": give another --participant or --out");
        answered = answered_in(database, file);
        if (version_of(database) < 2) add_early();
    }

    void add_early() {
        database.execute(
            std::string("BEGIN IMMEDIATE; ALTER TABLE trial ADD COLUMN early INTEGER;") +
            kExplainEarly +
            "UPDATE study SET value = '2' WHERE key = 'schema_version';"
            "PRAGMA user_version = 2; COMMIT");
    }

    void insert(const AnsweredTrial& one, const fs::path& session) {
        const Trial& trial = one.trial;
        Statement row(database, "INSERT INTO trial VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)");
        row.run(trial.number, trial.block, trial.position, trial.practice, name_of(trial.form),
                trial.item, trial.repetition, trial.target, trial.track, SqlReal{trial.level},
                one.answer.choice, SqlReal{one.answer.number}, one.right,
                SqlReal{one.answer.reaction_s}, SqlReal{one.utc_s}, one.answer.early);
        Statement interval(database, "INSERT INTO interval VALUES (?,?,?,?,?)");
        int number = 0;
        for (const StudyInterval& felt : trial.intervals)
            interval.run(trial.number, number++, felt.condition, SqlReal{felt.value},
                         json_text(felt.values));
        if (session.empty()) return;
        const std::string bytes = bytes_of(session);
        Statement(database, "INSERT INTO session VALUES (?,?)").run(trial.number, SqlBytes{bytes});
    }
};

StudyFile::StudyFile(const fs::path& file, const StudyIdentity& identity) {
    require_label(identity.participant);
    make_if_missing(file);
    implementation_ = std::make_unique<Implementation>(file);
    implementation_->lock(!identity.pilot.empty());
    if (implementation_->database.number("SELECT count(*) FROM sqlite_master") == 0)
        implementation_->begin(identity);
    else
        implementation_->resume(identity);
}

StudyFile::~StudyFile() = default;

const fs::path& StudyFile::file() const noexcept {
    return implementation_->file;
}

const StudyIdentity& StudyFile::identity() const noexcept {
    return implementation_->identity;
}

const std::vector<AnsweredTrial>& StudyFile::answered() const noexcept {
    return implementation_->answered;
}

void StudyFile::add(const AnsweredTrial& answered, const fs::path& session) {
    Database& database = implementation_->database;
    database.execute("BEGIN IMMEDIATE");
    try {
        implementation_->insert(answered, session);
        database.execute("COMMIT");
    } catch (...) {
        database.execute("ROLLBACK");
        throw;
    }
    if (!session.empty()) remove_database(session);
}

void StudyFile::finish() {
    implementation_->database.execute("INSERT OR REPLACE INTO study VALUES ('finished', '1')");
}

fs::path StudyFile::new_session_file() const {
    fs::path session = file().string() + ".trial.dibhr";
    remove_database(session);
    return session;
}

StudyRecord read_study(const fs::path& file) {
    std::error_code failed;
    if (!fs::is_regular_file(file, failed)) refuse(file, "no such file; check its name");
    const Database database = opened_study(file);
    StudyRecord record{.file = file,
                       .identity = identity_in(database, file),
                       .finished = fact(database, "finished") == "1",
                       .answered = answered_in(database, file),
                       .warning = later_version(database, file)};
    Statement rows(database,
                   "SELECT trial.trial, length(session.file) FROM trial LEFT JOIN session USING "
                   "(trial) ORDER BY trial.trial");
    while (rows.next()) record.session_bytes.push_back(rows.integer(1));
    return record;
}

std::string session_name(const StudyRecord& study, int trial) {
    std::ostringstream name;
    name << study.identity.participant << '-' << std::setw(3) << std::setfill('0') << trial + 1
         << ".dibhr";
    return name.str();
}

bool write_study_session(const fs::path& study, int trial, const fs::path& session) {
    StudyIdentity identity;
    std::string bytes;
    {
        const Database database = opened_study(study);
        identity = identity_in(database, study);
        Statement rows(database, "SELECT file FROM session WHERE trial = " + std::to_string(trial));
        if (rows.next()) bytes = rows.bytes(0);
    }
    if (bytes.empty()) return false;
    OutputFile out(session);
    out.write(bytes);
    label_session(Database(out.written(), refusal_of(session)), identity, trial, study);
    out.commit();
    return true;
}

}  // namespace dibhr
