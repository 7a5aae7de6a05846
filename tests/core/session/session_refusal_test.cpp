// The errors for files that are no session, or an incomplete one.
#include <sqlite3.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/session/recorder.hpp"
#include "core/session/session.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;

namespace {

/// The error of opening and checking the file.
std::string refusal_of(const std::filesystem::path& file) {
    try {
        const Session session(file);
        session.check();
        Session::Ticks ticks(session);
        for (TickRecord tick; ticks.next(tick);) {
        }
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing";
}

void run_sql(const std::filesystem::path& file, const std::string& sql) {
    CHECK(change(file, sql));
}

}  // namespace

TEST_CASE("a file that is none is refused with one line that says which and what it is",
          "[session]") {
    const SessionFolder folder;
    const auto refusal = [&folder] { return refusal_of(folder.file()); };
    const auto is_one_line = [&folder](const std::string& text) {
        return contains(text, folder.file().string() + ": ") && !contains(text, "\n");
    };
    SECTION("missing") {
        CHECK(refusal() == folder.file().string() + ": no such file; check its name");
    }
    SECTION("a folder") {
        std::filesystem::create_directory(folder.file());
        CHECK(contains(refusal(), "not an ordinary file"));
    }
    SECTION("empty") {
        std::ofstream(folder.file()).flush();
        CHECK(contains(refusal(), "it is empty"));
    }
    SECTION("text") {
        std::ofstream(folder.file()) << std::string(5000, 'x');
        CHECK(contains(refusal(), "no SQLite file"));
        CHECK(is_one_line(refusal()));
    }
    SECTION("another program's database") {
        run_sql(folder.file(), "CREATE TABLE song(name TEXT)");
        CHECK(contains(refusal(), "another program's database"));
        CHECK(is_one_line(refusal()));
    }
    SECTION("of a version that there never was") {
        record_ticks(folder.file(), 10);
        run_sql(folder.file(), "PRAGMA user_version = 0");
        CHECK(contains(refusal(), "its format has the number 0"));
        CHECK(is_one_line(refusal()));
    }
    SECTION("of the first version, without its tables") {
        record_ticks(folder.file(), 10);
        run_sql(folder.file(), "PRAGMA user_version = 1");
        CHECK(contains(refusal(), "its tables are not those of a recording"));
    }
    SECTION("of its version, without its tables") {
        record_ticks(folder.file(), 10);
        run_sql(folder.file(), "DROP TABLE clock");
        CHECK(is_one_line(refusal()));
    }
}

TEST_CASE(
    "wherever a session was cut off or overwritten, that is said in one line, or nothing of "
    "it is lost",
    "[session]") {
    const SessionFolder folder;
    record_ticks(folder.file(), 6000);  // many more pages than those of tables without rows
    const std::string whole = read_text(folder.file());
    const auto damaged = folder.path() / "damaged.dibhr";
    std::mt19937 random(11);
    std::uniform_int_distribution<std::size_t> place(0, whole.size() - 1);
    int refused = 0;
    for (int k = 0; k < 80; ++k) {
        std::string bytes = whole;
        const std::size_t at = place(random);
        if (k % 2 == 0) {
            bytes.resize(at);
        } else {
            for (std::size_t n = at; n < std::min(at + 600, bytes.size()); ++n) {
                bytes[n] = static_cast<char>(random());
            }
        }
        std::ofstream(damaged, std::ios::binary) << bytes;
        const std::string refusal = refusal_of(damaged);
        CAPTURE(k, at, refusal);
        CHECK_FALSE(contains(refusal, "\n"));
        if (k % 2 == 0) CHECK(contains(refusal, damaged.string() + ": "));
        refused += refusal == "nothing" ? 0 : 1;
    }
    CHECK(refused > 60);  // reals in the middle of a row may well be others
}

TEST_CASE("a recording copied without its log says so, and a whole one says nothing", "[session]") {
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(folder.file(), *ring, {{"note", "hello"}});
    push(*ring, tick_record(0));
    REQUIRE(eventually([&] { return recorder.status().rows == 1; }));
    const auto copied = folder.path() / "copied.dibhr";
    std::filesystem::copy_file(folder.file(), copied);  // what is left without the log
    const Session broken_off(copied);
    CHECK(broken_off.fact("note") == "hello");
    CHECK(contains(broken_off.warning(), copied.string()));
    CHECK(contains(broken_off.warning(), "copied.dibhr-wal"));
    CHECK_FALSE(contains(broken_off.warning(), "\n"));
    CHECK(Session(folder.file()).warning().empty());  // its log is beside it
    recorder.finish();
    CHECK(Session(folder.file()).warning().empty());
}

TEST_CASE("the log of another recording beside one that has ended is not read, and told",
          "[session]") {
    const SessionFolder folder;
    const auto record = [](const std::filesystem::path& file, std::uint64_t ticks) {
        const auto ring = std::make_unique<TickRing>();
        auto recorder = std::make_unique<Recorder>(file, *ring, SessionFacts{{"note", "hello"}});
        for (std::uint64_t n = 0; n < ticks; ++n)
            push(*ring, tick_record(static_cast<std::int64_t>(n)));
        REQUIRE(eventually([&] { return recorder->status().rows == ticks; }));
        const std::filesystem::path log = file.string() + "-wal";
        std::filesystem::copy_file(log, file.string() + "-copy");
    };
    record(folder.path() / "older.dibhr", 30);
    record(folder.file(), 500);
    const std::string log = folder.file().string() + "-wal";
    std::filesystem::rename(folder.path() / "older.dibhr-copy", log);
    const auto bytes = std::filesystem::file_size(log);

    const Session session(folder.file());
    CHECK(session.rows() == 500);
    CHECK(session.fact("complete") == "1");
    CHECK(contains(session.warning(), log.substr(log.rfind('/') + 1)));
    CHECK(contains(session.warning(), "move it away"));
    CHECK(std::filesystem::file_size(log) == bytes);
}

TEST_CASE("a file all of whose recording is in a log that is not there names the log",
          "[session]") {
    const SessionFolder folder;
    sqlite3* database = nullptr;
    REQUIRE(sqlite3_open(folder.file().c_str(), &database) == SQLITE_OK);
    const auto run = [&](const char* sql) {
        CHECK(sqlite3_exec(database, sql, nullptr, nullptr, nullptr) == SQLITE_OK);
    };
    run("PRAGMA journal_mode = WAL");
    run("PRAGMA application_id = 0x64686170; CREATE TABLE session(key, value)");
    const auto copied = folder.path() / "copied.dibhr";
    std::filesystem::copy_file(folder.file(), copied);
    sqlite3_close(database);
    CHECK(contains(refusal_of(copied), "copied.dibhr-wal, which is not here"));
    // Another program's, whole.
    const auto foreign = folder.path() / "foreign.dibhr";
    run_sql(foreign, "PRAGMA journal_mode = WAL; CREATE TABLE a(b)");
    CHECK(contains(refusal_of(foreign), "another program"));
}

TEST_CASE("an empty file with a log beside it is refused, and the log stays as it is",
          "[session]") {
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(folder.file(), *ring, {});
    push(*ring, tick_record(0));
    REQUIRE(eventually([&] { return recorder.status().rows == 1; }));
    const auto copied = folder.path() / "copied.dibhr";
    const std::string log = copied.string() + "-wal";
    std::filesystem::copy_file(folder.file().string() + "-wal", log);
    std::ofstream(copied).flush();
    const auto bytes = std::filesystem::file_size(log);
    CHECK(refusal_of(copied) == copied.string() +
                                    ": is empty, and only copied.dibhr-wal, the log of its "
                                    "recording, is beside it; copy both again from where it was "
                                    "recorded");
    CHECK(std::filesystem::file_size(log) == bytes);
    std::filesystem::copy_file(folder.file(), copied,
                               std::filesystem::copy_options::overwrite_existing);
    CHECK(Session(copied).rows() == 1);
}

TEST_CASE("a recording that was killed before it had written anything is called one", "[session]") {
    const SessionFolder folder;
    run_sql(folder.file(), "PRAGMA journal_mode = WAL; VACUUM");
    std::ofstream(folder.file().string() + "-wal") << std::string(100, 'x');  // of a torn write
    const std::string refusal = refusal_of(folder.file());
    CHECK(contains(refusal, "broken off before anything was written"));
    CHECK(contains(refusal, "touch.dibhr-wal"));
}

TEST_CASE("a session made to keep its reader busy for ever is refused, in one line", "[session]") {
    const SessionFolder folder;
    record_ticks(folder.file(), 10);
    const std::string endless = "WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) ";
    const auto& [sql,
                 words] = GENERATE_COPY(from_range(std::vector<std::pair<std::string, std::string>>{
        {"DROP TABLE session; CREATE VIEW session AS " + endless +
             "SELECT 'k' || x AS key, hex(zeroblob(1000)) AS value FROM c",
         "its tables"},
        {"ALTER TABLE tick_data RENAME TO ticks; CREATE VIEW tick_data AS SELECT a.* FROM "
         "ticks a, ticks b, ticks c, ticks d, ticks e, ticks f, ticks g, ticks h",
         "its tables"},
        {"DROP TABLE mark; CREATE TABLE mark(id INTEGER PRIMARY KEY, t REAL, tag TEXT, "
         "text TEXT AS (hex(zeroblob(400000000))))",
         "its tables"},
        {"DROP TABLE mark; CREATE VIRTUAL TABLE mark USING fts5(t, tag, text)", "its tables"},
        {"DROP TABLE mark", "its tables"},
        {"INSERT INTO session VALUES('note', hex(zeroblob(1000000)))", "a megabyte"},
        {"INSERT INTO mark(t, tag, text) " + endless +
             "SELECT x, 'a', hex(zeroblob(100000)) FROM c LIMIT 200",
         "more notes"},
        {"INSERT INTO session " + endless + "SELECT x, 'fact' FROM c LIMIT 400000", "more notes"},
    }));
    CAPTURE(sql);
    run_sql(folder.file(), sql);
    const std::string refusal = refusal_of(folder.file());
    CHECK(contains(refusal, folder.file().string() + ": "));
    CHECK(contains(refusal, words));
    CHECK_FALSE(contains(refusal, "\n"));
}

TEST_CASE("a question that would not end is ended by the bound of its work", "[session]") {
    const SessionFolder folder;
    record_ticks(folder.file(), 10);
    const SessionReader reader(folder.file());
    Statement endless = reader.rows(
        "WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) SELECT sum(x) "
        "FROM c");
    std::string refusal;
    try {
        (void)endless.next();
    } catch (const InputError& error) {
        refusal = error.what();
    }
    CHECK(contains(refusal, "reading it would not end"));
    Statement next = reader.rows("SELECT count(*) FROM tick");
    REQUIRE(next.next());
    CHECK(next.integer(0) == 10);
}

TEST_CASE("what others add to a session does not keep it from being read", "[session]") {
    const SessionFolder folder;
    record_ticks(folder.file(), 10);
    run_sql(folder.file(),
            "CREATE VIEW mine AS SELECT t, pz FROM tick; CREATE TABLE rating(a, b);"
            "CREATE INDEX by_time ON tick_data(t)");
    CHECK(refusal_of(folder.file()) == "nothing");
}

TEST_CASE("a session that does not say by which algorithm it was felt is refused", "[session]") {
    const SessionFolder folder;
    record_ticks(folder.file(), 10);
    REQUIRE(refusal_of(folder.file()) == "nothing");
    run_sql(folder.file(), "ALTER TABLE parameters DROP COLUMN algorithm");
    CHECK(contains(refusal_of(folder.file()), "algorithm"));
}

TEST_CASE("ticks with numbers that no recording reaches are refused", "[session]") {
    const SessionFolder folder;
    record_ticks(folder.file(), 10);
    const std::string number =
        GENERATE(as<std::string>{}, "9223372036854775807", "-9223372036854775807", "-1");
    run_sql(folder.file(), "UPDATE tick_data SET tick = " + number + " WHERE tick = 9");
    const std::string refusal = refusal_of(folder.file());
    CHECK(contains(refusal, folder.file().string() + ": is damaged"));
    CHECK(contains(refusal, number));
}
