// The session file's tables: made once, filled tick by tick, within transactions.
#include "core/session/session_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <system_error>

#include "core/error.hpp"
#include "core/haptics/primitive.hpp"
#include "core/haptics/safety.hpp"

namespace dibhr {

namespace {

struct Column {
    std::string_view name;
    std::string_view type;
    std::string_view unit;
    std::string_view meaning;
};

// The output rows' columns first, by the same names and in the same order; `add` binds in this
// order.
constexpr std::array kColumns{
    Column{"t", "REAL", "s", "monotonic time since the recording's clock began"},
    Column{"gx", "REAL", "px", "goal, x (column)"},
    Column{"gy", "REAL", "px", "goal, y (row)"},
    Column{"gz", "REAL", "px", "goal, z (elevation towards the viewer)"},
    Column{"px", "REAL", "px", "proxy, x"},
    Column{"py", "REAL", "px", "proxy, y"},
    Column{"pz", "REAL", "px", "proxy, z"},
    Column{"fx", "REAL", "N", "spring force before the safety stage, x"},
    Column{"fy", "REAL", "N", "spring force before the safety stage, y"},
    Column{"fz", "REAL", "N", "spring force before the safety stage, z"},
    Column{"cx", "REAL", "N", "force sent to the device, x"},
    Column{"cy", "REAL", "N", "force sent to the device, y"},
    Column{"cz", "REAL", "N", "force sent to the device, z"},
    Column{"contact", "INTEGER", "", "1 while the proxy touches the surface"},
    Column{"primitive", "TEXT", "", "what the proxy rests on: none, triangle, edge or vertex"},
    Column{"i", "INTEGER", "", "the primitive's column, -1 for none"},
    Column{"j", "INTEGER", "", "the primitive's row, -1 for none"},
    Column{"moves", "INTEGER", "", "primitives visited in the update"},
    Column{"ns", "INTEGER", "ns", "time of the update"},
    Column{"tick", "INTEGER", "", "number of the tick in its loop"},
    Column{"playback_s", "REAL", "s", "time on the video's playback line"},
    Column{"blend", "REAL", "", "0: depth frame `frame`, 1: the one after it"},
    Column{"frame", "INTEGER", "", "number of the depth frame in its file, from 0"},
    Column{"dt_s", "REAL", "s", "since the tick before began"},
    Column{"lateness_us", "REAL", "us", "how long after its deadline the tick began"},
    Column{"buttons", "INTEGER", "", "bit 0: the device's main button"},
    Column{"cut", "INTEGER", "", "why the force was cut: code in table cut"},
};

/// "tick(t REAL, gx REAL, ...)"
std::string tick_table() {
    std::string text;
    for (const Column& column : kColumns) {
        text += (text.empty() ? "tick(" : ", ") + std::string(column.name) + " " +
                std::string(column.type);
    }
    return text + ")";
}

/// "INSERT INTO tick VALUES (?, ?, ...)"
std::string insert_tick() {
    std::string marks = "?";
    for (std::size_t k = 1; k < kColumns.size(); ++k) marks += ", ?";
    return "INSERT INTO tick VALUES (" + marks + ")";
}

PrimitiveKind primitive_of(const TickRecord& record) {
    constexpr auto kLast = static_cast<std::uint8_t>(PrimitiveKind::vertex);
    return record.primitive > kLast ? PrimitiveKind::none
                                    : static_cast<PrimitiveKind>(record.primitive);
}

/// Makes an empty file where there was none; the name of a file that exists is safe from us.
const std::filesystem::path& made(const std::filesystem::path& file) {
    const int descriptor = open(file.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
        close(descriptor);
        return file;
    }
    if (errno == EEXIST) {
        throw InputError(file.string() + ": exists already; choose another name for the session");
    }
    throw InputError(file.string() + ": the session cannot be recorded there (" +
                     std::strerror(errno) + "); choose a folder that can be written to");
}

void make_tables(Database& database) {
    database.execute("PRAGMA application_id = " + std::to_string(kSessionApplicationId));
    database.execute("PRAGMA user_version = " + std::to_string(kSessionSchemaVersion));
    database.execute("CREATE TABLE session(key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID");
    database.execute("CREATE TABLE " + tick_table());
    database.execute(
        "CREATE TABLE tick_column(name TEXT PRIMARY KEY, unit TEXT, meaning TEXT) WITHOUT ROWID");
    database.execute("CREATE TABLE cut(code INTEGER PRIMARY KEY, name TEXT)");

    Statement describe(database, "INSERT INTO tick_column VALUES (?, ?, ?)");
    for (const Column& column : kColumns) {
        describe.bind(1, column.name);
        describe.bind(2, column.unit);
        describe.bind(3, column.meaning);
        describe.run();
    }
    Statement name_cut(database, "INSERT INTO cut VALUES (?, ?)");
    for (int code = 0; code <= static_cast<int>(SafetyCut::goal_jump); ++code) {
        name_cut.bind(1, std::int64_t{code});
        name_cut.bind(2, std::string_view(name_of(static_cast<SafetyCut>(code))));
        name_cut.run();
    }
}

void remove_traces(const std::filesystem::path& file) {
    std::error_code ignored;
    for (const char* ending : {"", "-wal", "-shm", "-journal"}) {
        std::filesystem::remove(file.string() + ending, ignored);
    }
}

/// A new session file with its tables, in write-ahead mode: readers do not stop the recording.
Database made_database(const std::filesystem::path& file) {
    Database database(made(file));
    database.execute("PRAGMA journal_mode = WAL");
    database.execute("PRAGMA synchronous = NORMAL");
    database.execute("BEGIN");
    make_tables(database);
    database.execute("COMMIT");
    return database;
}

}  // namespace

SessionFile::SessionFile(const std::filesystem::path& file, const SessionFacts& facts) try
    : path_(file),
      database_(made_database(file)),
      insert_tick_(database_, insert_tick()),
      insert_fact_(database_, "INSERT OR REPLACE INTO session VALUES (?, ?)") {
    begin();
    for (const auto& [key, value] : facts) set_fact(key, value);
    set_fact("schema_version", std::to_string(kSessionSchemaVersion));
    set_fact("units", "pixels of the depth image, newtons, seconds; see table tick_column");
    set_fact("complete", "0");
    commit();
} catch (const DatabaseError& error) {
    remove_traces(file);
    throw InputError(file.string() + ": the session cannot be recorded there (" + error.what() +
                     "); choose another disk");
}

void SessionFile::begin() {
    database_.execute("BEGIN");
}

void SessionFile::add(const TickRecord& record) {
    int column = 0;
    const auto real = [&](double value) { insert_tick_.bind(++column, value); };
    const auto integer = [&](std::int64_t value) { insert_tick_.bind(++column, value); };
    const auto vector = [&](const double(&values)[3]) {
        for (const double value : values) real(value);
    };
    real(record.t_s);
    vector(record.goal);
    vector(record.proxy);
    vector(record.spring_newton);
    vector(record.sent_newton);
    integer(record.contact);
    insert_tick_.bind(++column, std::string_view(name_of(primitive_of(record))));
    integer(record.i);
    integer(record.j);
    integer(record.moves);
    integer(std::isfinite(record.update_us) ? std::llround(record.update_us * 1000.0) : -1);
    integer(record.tick);
    real(record.playback_s);
    real(record.blend);
    integer(record.frame);
    real(record.dt_s);
    real(record.lateness_us);
    integer(record.buttons);
    integer(record.cut);
    insert_tick_.run();
}

void SessionFile::commit() {
    database_.execute("COMMIT");
    std::error_code ignored;
    if (!std::filesystem::exists(path_, ignored)) {
        throw DatabaseError("the file is gone from its place");
    }
}

void SessionFile::set_fact(const std::string& key, const std::string& value) {
    insert_fact_.bind(1, std::string_view(key));
    insert_fact_.bind(2, std::string_view(value));
    insert_fact_.run();
}

void SessionFile::merge_log() {
    database_.execute("PRAGMA wal_checkpoint(TRUNCATE)");
}

std::uint64_t SessionFile::bytes() const {
    std::uint64_t total = 0;
    for (const char* ending : {"", "-wal"}) {
        std::error_code error;
        const auto size = std::filesystem::file_size(path_.string() + ending, error);
        if (!error) total += size;
    }
    return total;
}

}  // namespace dibhr
