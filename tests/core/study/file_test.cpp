// The study file: whole after every answer, one program at a time, and not another study's.
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/sqlite/database.hpp"
#include "core/study/study_file.hpp"
#include "tests/core/study/pages.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace dibhr;

StudyIdentity identity() {
    return {.participant = "P07",
            .number = 7,
            .program = "dibhr 0",
            .protocol_name = "study.toml",
            .protocol_text = "title = \"T\"",
            .protocol_sha256 = "abc",
            .seed = 12345678901U,
            .created_s = 1.7e9 + 0.123};
}

AnsweredTrial some_trial(int number) {
    return {.trial = {.number = number,
                      .block = 1,
                      .position = number,
                      .form = TrialForm::two_interval,
                      .item = 2,
                      .repetition = 1,
                      .intervals = {{"a", {.numbers = {{"friction", 0.1}}}, 0.1},
                                    {"b",
                                     {.numbers = {{"friction", 0.1 + 0.2}},
                                      .words = {{"algorithm", "pga"}}},
                                     0.1 + 0.2}},
                      .target = 1,
                      .track = 0,
                      .level = 0.1 + 0.2 - 0.1},
            .answer = {.choice = 1, .reaction_s = 0.7, .early = 3},
            .right = true,
            .utc_s = 1.7e9 + 1.0 / 3.0};
}

std::map<std::string, std::string> facts_in(const std::filesystem::path& session) {
    Database database(session);
    Statement rows(database, "SELECT key, value FROM session");
    std::map<std::string, std::string> facts;
    while (rows.next()) facts[rows.text(0)] = rows.text(1);
    return facts;
}

std::string refusal_of(const std::filesystem::path& file, const StudyIdentity& who) {
    try {
        const StudyFile study(file, who);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

}  // namespace

TEST_CASE("what is answered is read back to the last bit, with its session", "[study]") {
    const test::TemporaryFolder folder;
    const auto file = study_file_of(folder.path(), "P07");
    AnsweredTrial rated{
        .trial = {.number = 1, .form = TrialForm::rating, .intervals = {{"c", {}, {}}}},
        .answer = {.number = 4.0, .reaction_s = 1.25},
        .utc_s = 1.7e9};
    {
        StudyFile study(file, identity());
        const auto session = study.new_session_file();
        std::ofstream(session).flush();
        Database(session).execute(
            "CREATE TABLE session(key TEXT PRIMARY KEY, value TEXT); "
            "INSERT INTO session VALUES ('participant', ''), ('device', 'mouse')");
        study.add(some_trial(0), session);
        CHECK_FALSE(std::filesystem::exists(session));
        study.add(rated);
        study.finish();
    }
    const StudyRecord record = read_study(file);
    CHECK(record.identity == identity());
    CHECK(record.finished);
    CHECK(record.answered == std::vector<AnsweredTrial>{some_trial(0), rated});
    CHECK(record.session_bytes.at(0) > 0);
    CHECK(record.session_bytes.at(1) == 0);
    CHECK(session_name(record, 0) == "P07-001.dibhr");
    CHECK(write_study_session(file, 0, folder.path() / "s.dibhr"));
    CHECK(facts_in(folder / "s.dibhr") ==
          std::map<std::string, std::string>{
              {"device", "mouse"}, {"note", "T, trial 1"}, {"participant", "P07"}});
    CHECK_FALSE(write_study_session(file, 1, folder.path() / "none.dibhr"));
    CHECK_FALSE(std::filesystem::exists(folder / "none.dibhr"));
    const StudyFile again(file, identity());
    CHECK(again.answered() == record.answered);
}

TEST_CASE("a study that was begun before early keys were counted is read, and goes on", "[study]") {
    const test::TemporaryFolder folder;
    const auto file = study_file_of(folder.path(), "P07");
    StudyFile(file, identity()).add(some_trial(0));
    Database(file).execute(
        "ALTER TABLE trial DROP COLUMN early; DELETE FROM explanation WHERE \"column\" = 'early';"
        "UPDATE study SET value = '1' WHERE key = 'schema_version'; PRAGMA user_version = 1");
    CHECK(read_study(file).answered.at(0).answer.early == std::nullopt);
    StudyFile(file, identity()).add(some_trial(1));
    const std::vector<AnsweredTrial> answered = read_study(file).answered;
    REQUIRE(answered.size() == 2);
    CHECK(answered[0].answer.early == std::nullopt);
    CHECK(answered[1] == some_trial(1));
    CHECK(Database(file).number("PRAGMA user_version") == kStudySchemaVersion);
}

TEST_CASE("a study of a schema to come is read, said to be one, and not written to", "[study]") {
    const test::TemporaryFolder folder;
    const auto file = study_file_of(folder.path(), "P07");
    StudyFile(file, identity()).add(some_trial(0));
    CHECK(read_study(file).warning.empty());
    Database(file).execute("ALTER TABLE trial ADD COLUMN glove; PRAGMA user_version = 3");
    const StudyRecord record = read_study(file);
    CHECK(record.answered == std::vector<AnsweredTrial>{some_trial(0)});
    CHECK(record.warning.find("by a newer dibhr (format 3, this one reads 2)") !=
          std::string::npos);
    CHECK_THROWS_AS(StudyFile(file, identity()), InputError);
}

TEST_CASE("labels that end in the same number are told of each other", "[study]") {
    const test::TemporaryFolder folder;
    const auto begin = [&](const char* label, int number, const char* protocol) {
        StudyIdentity who = identity();
        who.participant = label;
        who.number = number;
        who.protocol_sha256 = protocol;
        return StudyFile(study_file_of(folder.path(), label), who);
    };
    const auto others = [&](const char* label, int number) {
        StudyIdentity who = identity();
        who.participant = label;
        who.number = number;
        return labels_of_number(folder.path(), who);
    };
    CHECK(others("P21", 21).empty());
    begin("P21", 21, "abc");
    begin("P021", 21, "abc");
    begin("R7", 21, "abc");     // by --number
    begin("Q21", 4, "abc");     // by --number
    begin("S21", 21, "other");  // another study
    CHECK(others("P21", 21) == std::vector<std::string>{"P021", "R7"});
    CHECK(others("P22", 22).empty());
    const StudyFile running = begin("P4", 4, "abc");
    CHECK(others("X4", 4) == std::vector<std::string>{"P4", "Q21"});
}

TEST_CASE("a study file is run by one program at a time", "[study]") {
    const test::TemporaryFolder folder;
    const auto file = study_file_of(folder.path(), "P07");
    const StudyFile study(file, identity());
    CHECK(refusal_of(file, identity()).find("run by another program") != std::string::npos);
}

TEST_CASE("a study file is not gone on with by another study", "[study]") {
    const test::TemporaryFolder folder;
    const auto file = study_file_of(folder.path(), "P07");
    { const StudyFile study(file, identity()); }
    StudyIdentity other = identity();
    other.protocol_sha256 = "def";
    CHECK(refusal_of(file, other).find("another protocol") != std::string::npos);
    other = identity();
    other.number = 8;
    CHECK(refusal_of(file, other).find("number 7") != std::string::npos);
    other = identity();
    other.pilot = "guess";
    CHECK(refusal_of(file, other).find("is a person's") != std::string::npos);
    CHECK(refusal_of(file, identity()).empty());
}

TEST_CASE("what is no study is refused in one line", "[study]") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "x.dibhr-study";
    CHECK_THROWS_AS(read_study(file), InputError);
    std::ofstream(file) << "not a database, and longer than a header of SQLite would be: "
                        << std::string(200, 'x');
    CHECK_THROWS_AS(read_study(file), InputError);
    CHECK_FALSE(refusal_of(file, identity()).empty());
}

TEST_CASE("a study file whose trials never end is refused, and soon", "[study]") {
    const test::TemporaryFolder folder;
    const auto file = folder / "P07.dibhr-study";
    StudyFile(file, identity()).add(some_trial(0));
    Database(file).execute(
        "DROP TABLE trial; CREATE VIEW trial AS WITH RECURSIVE c(x) AS (SELECT 0 UNION ALL "
        "SELECT x + 1 FROM c) SELECT sum(x) AS trial, 1 AS block, 0 AS position, 0 AS practice, "
        "'explore' AS form, 0 AS item, 0 AS repetition, 0 AS target, 0 AS track, 0 AS level, "
        "0 AS choice, 0 AS number, 0 AS right, 0 AS reaction_s, 0 AS utc_s, 0 AS early FROM c");
    std::string refusal;
    try {
        (void)read_study(file);
    } catch (const InputError& error) {
        refusal = error.what();
    }
    CHECK(refusal.find(file.string() + ": cannot be used (interrupted)") == 0);
}

TEST_CASE("a study file whose label is no label is refused, and nothing is written", "[study]") {
    const test::TemporaryFolder folder;
    const auto file = folder / "P07.dibhr-study";
    StudyFile(file, identity()).add(some_trial(0));
    const std::string elsewhere = (folder / "elsewhere").string();
    const std::vector<std::string> labels{elsewhere,
                                          "../P07",
                                          "../../P07",
                                          "a/../../b",
                                          "/tmp/P07",
                                          "./P07",
                                          "..",
                                          ".",
                                          ".hidden",
                                          "",
                                          "~/P07",
                                          "P07/",
                                          "P 07",
                                          "P07\n",
                                          "P07\t",
                                          "=cmd|' /C calc'!A0",
                                          "+1",
                                          "@x",
                                          "-rf",
                                          "_x",
                                          "P07;x",
                                          "\xc3\xa4",
                                          "%2e%2e%2fP07",
                                          "..\\P07",
                                          std::string(41, 'a'),
                                          "P07.dibhr"};
    for (const std::string& label : labels) {
        CAPTURE(label);
        {
            Database database(file);
            Statement row(database, "UPDATE study SET value = ? WHERE key = 'participant'");
            row.run(std::string_view(label));
        }
        CHECK_THROWS_AS(read_study(file), InputError);
        CHECK_THROWS_AS(write_study_session(file, 0, folder / "s.dibhr"), InputError);
        CHECK_FALSE(refusal_of(file, identity()).empty());
    }
    CHECK(test::names_in(folder.path()) == std::vector<std::string>{"P07.dibhr-study"});
}

TEST_CASE("a study file of a number or of trials that cannot be is refused", "[study]") {
    const test::TemporaryFolder folder;
    const auto file = folder / "P07.dibhr-study";
    const auto refused_after = [&](const char* change) {
        std::filesystem::remove(file);
        StudyFile(file, identity()).add(some_trial(0));
        Database(file).execute(change);
        CHECK_THROWS_AS(read_study(file), InputError);
    };
    for (const char* const number : {"0", "-1", "1000001", "1e300", "x", ""})
        refused_after(
            ("UPDATE study SET value = '" + std::string(number) + "' WHERE key = 'number'")
                .c_str());
    for (const char* const trial : {"1", "-1", "4294967296"})
        refused_after(("UPDATE trial SET trial = " + std::string(trial)).c_str());
}

TEST_CASE("a label is letters, digits, - and _", "[study]") {
    for (const char* const good : {"P07", "a-b_c", "7"}) CHECK_NOTHROW(require_label(good));
    for (const char* const bad : {"", "Anna B.", "../x", "P/7", "\xc3\xa4", "P07\n", "-1", "_a"})
        CHECK_THROWS_AS(require_label(bad), InputError);
    CHECK(number_in("P07") == 7);
    CHECK(number_in("P1000000") == 1000000);
    CHECK_FALSE(number_in("P00"));
    CHECK_FALSE(number_in("P1000001"));
    CHECK_FALSE(number_in("Pilot"));
}
