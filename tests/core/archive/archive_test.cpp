// An archive is whole or not there, says what the sessions say, and nothing of the computer.
#include "core/archive/archive.hpp"

#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/archive/archive_layout.hpp"
#include "core/archive/without_folders.hpp"
#include "core/error.hpp"
#include "core/files/content_hash.hpp"
#include "core/files/json.hpp"
#include "core/session/session.hpp"
#include "core/study/study_file.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using namespace dibhr::test;
namespace fs = std::filesystem;

namespace {

/// A folder name that no archive may hold.
constexpr const char* kHome = "somebody-at-home";

/// A folder of recordings below that name.
struct Recordings {
    TemporaryFolder folder{};
    fs::path home{folder / kHome};
    fs::path archive{folder / "archive"};

    Recordings() { fs::create_directories(home / "videos"); }

    [[nodiscard]] fs::path video(const std::string& name, const std::string& bytes) const {
        fs::create_directories((home / "videos" / name).parent_path());
        write_text(home / "videos" / name, bytes);
        return home / "videos" / name;
    }
    fs::path session(const std::string& name, const std::string& participant, int ticks,
                     const fs::path& depth) const {
        const fs::path file = home / name;
        fs::create_directories(file.parent_path());
        const auto ring = std::make_unique<TickRing>();
        Recorder recorder(file, *ring,
                          {{"participant", participant},
                           {"note", "from " + depth.string()},
                           {"device", "goals:" + (home / "my goals.csv").string()},
                           {"depth", depth.string()}});
        recorder.parameters({.version = 1});
        recorder.media(1, {}, depth);
        for (int n = 0; n < ticks; ++n) {
            TickRecord tick = tick_record(n);
            tick.settings = 1;
            tick.frames.source.media = 1;
            push(*ring, tick);
        }
        recorder.mark_at(0.001, "press", "a word, and another");
        recorder.finish();
        return file;
    }
    fs::path study(const std::string& label, int ticks) const {
        StudyFile study(study_file_of(home, label),
                        {.participant = label,
                         .number = 7,
                         .program = "dibhr 0",
                         .protocol_name = "study.toml",
                         .protocol_text = "title = \"T\"\ncolour = \"" + home.string() + "/c.mp4\"",
                         .protocol_sha256 = "abc",
                         .seed = 5,
                         .created_s = 1.7e9});
        for (int number = 0; number < 2; ++number) {
            const fs::path recorded = study.new_session_file();
            session(recorded.filename(), "", ticks, video("hill.png", "hill"));
            study.add({.trial = {.number = number,
                                 .form = TrialForm::two_interval,
                                 .intervals = {{"a", {.numbers = {{"friction", 0.1}}}, 0.1},
                                               {"b", {.words = {{"bump", home / "b.png"}}}, 0.3}},
                                 .target = 1},
                       .answer = {.choice = number, .reaction_s = 0.7},
                       .right = number == 1,
                       .utc_s = 1.7e9 + 1.0},
                      number == 0 ? fs::path() : recorded);
        }
        study.finish();
        return study.file();
    }
    [[nodiscard]] ArchiveRequest request(std::vector<fs::path> files) const {
        return {.files = std::move(files), .folder = archive, .program = "1.2.3"};
    }
};

ArchiveCheck check(const fs::path& folder) {
    return check_archive(folder, [](double) {});
}

std::vector<std::string> faults_of(const fs::path& folder) {
    return check(folder).faults;
}

/// Files of the archive that hold a text.
std::vector<std::string> files_with(const fs::path& folder, const std::string& text) {
    std::vector<std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && read_text(entry.path()).find(text) != std::string::npos)
            found.push_back(entry.path().string());
    return found;
}

std::string said_by_sha256sum(const fs::path& folder) {
    return output_of("cd '" + folder.string() + "' && sha256sum --strict --quiet -c " + kManifest +
                     " 2>&1 && echo good");
}

std::vector<TickRecord> ticks_of(const fs::path& file) {
    std::vector<TickRecord> all;
    const Session session(file);
    Session::Ticks ticks(session);
    for (TickRecord tick; ticks.next(tick);) all.push_back(tick);
    return all;
}

void require_same_ticks(const fs::path& a, const fs::path& b) {
    const auto first = ticks_of(a), second = ticks_of(b);
    REQUIRE(first.size() == second.size());
    for (std::size_t k = 0; k < first.size(); ++k) REQUIRE(same_record(first[k], second[k]));
}

const std::vector<std::string> kNone{};

std::string refusal_of(const ArchiveRequest& request) {
    try {
        write_archive(request);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

/// The sum of a changed file is made right, so that only the meaning is wrong.
void renew_sum(const fs::path& archive, const std::string& name) {
    Manifest manifest = read_manifest(archive);
    manifest[name] = sha256_of_file(archive / name);
    write_text(archive / kManifest, manifest_text(manifest));
}

}  // namespace

TEST_CASE("an archive has the ticks of its sessions and no folder of their computer", "[archive]") {
    const Recordings recordings;
    const fs::path video = recordings.video("hill.png", "hill");
    const fs::path one = recordings.session("a/mine.dibhr", "P-07", 50, video);
    const fs::path other = recordings.session("b/mine.dibhr", "P07", 20, video);
    const fs::path third = recordings.session("c/mine.dibhr", "", 10, video);
    const std::string before = sha256_of_file(one);
    const ArchiveSummary summary = write_archive(recordings.request({one, other, third}));
    CHECK(summary.sessions == 3);
    CHECK(summary.participants == 3);
    CHECK(summary.warnings == kNone);
    CHECK(sha256_of_file(one) == before);
    const fs::path& archive = recordings.archive;
    CHECK(files_with(archive, kHome) == kNone);
    CHECK(read_text(archive / kParticipants) ==
          "participant_id\nsub-P07\nsub-P07x2\nsub-unlabelled\n");
    const fs::path kept = archive / "sourcedata/sub-P07/sub-P07_task-touch_run-001.dibhr";
    require_same_ticks(one, kept);
    const Session session(kept);
    CHECK(session.fact("device") == "goals:my goals.csv");
    CHECK(session.fact("note") == "from hill.png");
    CHECK(session.parameters().size() == 1);
    CHECK(said_by_sha256sum(archive) == "good\n");
    CHECK(faults_of(archive) == kNone);
    const ArchiveCheck found = check(archive);
    CHECK(found.found.sessions == 3);
    CHECK(found.found.files == summary.files);
    const Json ticks =
        parsed_json(read_text(archive / "sub-P07/beh/sub-P07_task-touch_run-001_ticks.json"));
    CHECK(ticks["gx"]["Units"] == "px");
    CHECK(ticks["Rows"] == 50);
    CHECK(ticks["cut"]["Levels"].size() > 1);
    CHECK(contains(read_text(archive / "sub-P07/beh/sub-P07_task-touch_run-001_marks.csv"),
                   "press,\"a word, and another\""));
}

TEST_CASE("the check of an archive finds every fault", "[archive]") {
    const Recordings recordings;
    const fs::path session =
        recordings.session("mine.dibhr", "P07", 20, recordings.video("hill.png", "hill"));
    write_archive(recordings.request({session}));
    const fs::path& archive = recordings.archive;
    REQUIRE(faults_of(archive) == kNone);
    const std::string table = "sub-P07/beh/sub-P07_task-touch_run-001_ticks.csv";
    const std::string rows = read_text(archive / table);
    const auto require_fault_of = [&archive](const std::string& file) {
        const auto faults = faults_of(archive);
        REQUIRE(faults.size() == 1);
        CHECK(faults[0].starts_with(file));
        CHECK(faults[0].find('\n') == std::string::npos);
    };
    SECTION("a changed byte") {
        std::string changed = rows;
        changed[changed.size() / 2] = changed[changed.size() / 2] == '1' ? '2' : '1';
        write_text(archive / table, changed);
        require_fault_of(table);
    }
    SECTION("a missing file") {
        fs::remove(archive / table);
        require_fault_of(table);
    }
    SECTION("a file more") {
        const std::string file = "sub-P07/beh/more.csv";
        write_text(archive / file, "a\n");
        require_fault_of(file);
    }
    SECTION("a row less of which the manifest knows") {
        write_text(archive / table, rows.substr(0, rows.rfind('\n', rows.size() - 2) + 1));
        renew_sum(archive, table);
        require_fault_of(table);
    }
    SECTION("a column that the dictionary does not explain") {
        write_text(archive / table, "x" + rows);
        renew_sum(archive, table);
        require_fault_of(table);
    }
    SECTION("a participant who is not listed") {
        const std::string file = kParticipants;
        write_text(archive / file, "participant_id\n");
        renew_sum(archive, file);
        require_fault_of(file);
    }
    SECTION("a session that cannot be read") {
        const std::string file = "sourcedata/sub-P07/sub-P07_task-touch_run-001.dibhr";
        write_text(archive / file, "text");
        renew_sum(archive, file);
        require_fault_of(file);
    }
}

TEST_CASE("an archive holds the answers of two participants and the sessions of their trials",
          "[archive]") {
    const Recordings recordings;
    const fs::path one = recordings.study("P07", 30), other = recordings.study("P08", 40);
    const std::string before = sha256_of_file(one);
    const ArchiveSummary summary = write_archive(recordings.request({one, other}));
    const fs::path& archive = recordings.archive;
    CHECK(summary.sessions == 2);
    CHECK(summary.participants == 2);
    CHECK(sha256_of_file(one) == before);
    CHECK(files_with(archive, kHome) == kNone);
    CHECK(faults_of(archive) == kNone);
    CHECK(said_by_sha256sum(archive) == "good\n");
    const std::string rows =
        read_text(archive / "sub-P07/beh/sub-P07_task-study_run-001_trials.csv");
    CHECK(contains(rows, "condition_1,value_1,values_1,run\n"));
    CHECK(contains(rows, ",sub-P07_task-touch_run-001\n"));
    CHECK(contains(rows, "b.png"));
    CHECK(read_text(archive / "protocols/study.toml") == "title = \"T\"\ncolour = \"c.mp4\"");
    const fs::path kept = archive / "sourcedata/sub-P07/sub-P07_task-study_run-001.dibhr-study";
    CHECK(read_study(kept).answered.size() == 2);
    const fs::path first = recordings.folder / "first.dibhr",
                   second = recordings.folder / "second.dibhr";
    REQUIRE(write_study_session(one, 1, first));
    REQUIRE(write_study_session(kept, 1, second));
    require_same_ticks(first, second);
    REQUIRE(change(kept, "DELETE FROM session"));
    renew_sum(archive, kept.lexically_relative(archive));
    CHECK(faults_of(archive).size() == 2);
}

TEST_CASE("media are copied only with the bytes that were touched", "[archive]") {
    const Recordings recordings;
    const fs::path one = recordings.video("a/hill.png", "hill"),
                   other = recordings.video("b/hill.png", "dale");
    const std::vector<fs::path> sessions{recordings.session("1.dibhr", "P1", 5, one),
                                         recordings.session("2.dibhr", "P1", 5, other)};
    write_text(other, "ebbs");
    ArchiveRequest request = recordings.request(sessions);
    request.copy_media = true;
    const ArchiveSummary summary = write_archive(request);
    REQUIRE(summary.warnings.size() == 1);
    CHECK(summary.warnings[0].starts_with(other.string() + ": is not in the archive: has changed"));
    const fs::path stimuli = recordings.archive / "stimuli";
    CHECK(names_in(stimuli) == std::vector<std::string>{"hill.png", "media.csv", "media.json"});
    CHECK(read_text(stimuli / "hill.png") == "hill");
    CHECK(contains(read_text(stimuli / "media.csv"), "hill-2.png,4,"));
    CHECK(faults_of(recordings.archive) == kNone);
}

TEST_CASE("a folder of pictures that cannot be read is said, and the rest is archived",
          "[archive]") {
    const Recordings recordings;
    const fs::path picture = recordings.video("hills/1.png", "hill");
    ArchiveRequest request =
        recordings.request({recordings.session("1.dibhr", "P1", 5, picture.parent_path())});
    request.copy_media = true;
    fs::create_symlink("2.png", picture.parent_path() / "2.png");  // leads to itself
    const ArchiveSummary summary = write_archive(request);
    REQUIRE(summary.warnings.size() == 1);
    CHECK(summary.warnings[0] == picture.parent_path().string() +
                                     ": is not in the archive: cannot be read; make it readable");
    CHECK(faults_of(recordings.archive) == kNone);
}

TEST_CASE("of a damaged session is archived what can be read, and what is missing is said",
          "[archive]") {
    const Recordings recordings;
    const fs::path whole =
        recordings.session("whole.dibhr", "P1", 3000, recordings.video("hill.png", "hill"));
    const fs::path cut = recordings.home / "cut.dibhr";
    fs::copy_file(whole, cut);
    fs::resize_file(cut, fs::file_size(whole) * 3 / 4);
    const ArchiveSummary summary = write_archive(recordings.request({cut}));
    REQUIRE(summary.warnings.size() == 1);
    CHECK(summary.warnings[0].starts_with(cut.string() + ": is cut short ("));
    CHECK(contains(summary.warnings[0], " of 3000 ticks cannot be read (from "));
    CHECK(faults_of(recordings.archive) == kNone);
    const fs::path kept = recordings.archive / "sourcedata/sub-P1/sub-P1_task-touch_run-001.dibhr";
    CHECK(contains(Session(kept).warning(), "is of a recording that was damaged: "));
    const std::vector<TickRecord> all = ticks_of(whole), read = ticks_of(kept);
    REQUIRE(read.size() > 1000);
    REQUIRE(read.size() < all.size());
    for (std::size_t k = 0; k < read.size(); ++k) REQUIRE(same_record(read[k], all[k]));
}

TEST_CASE("a disk too full for what can be read of a damaged session is said of the archive",
          "[archive]") {
    const Recordings recordings;
    const fs::path cut =
        recordings.session("cut.dibhr", "P1", 3000, recordings.video("hill.png", "hill"));
    fs::resize_file(cut, fs::file_size(cut) * 3 / 4);
    rlimit before{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    const auto handled = std::signal(SIGXFSZ, SIG_IGN);
    rlimit small = before;
    small.rlim_cur = 65536;
    ::setrlimit(RLIMIT_FSIZE, &small);
    std::string said;
    try {
        static_cast<void>(write_archive(recordings.request({cut})));
    } catch (const InputError& error) {
        said = error.what();
    }
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handled);
    CHECK(said.starts_with(recordings.archive.string() + ": "));
    CHECK(contains(said, "make room"));
}

TEST_CASE("sessions of every schema are archived", "[archive]") {
    const Recordings recordings;
    const std::string name = GENERATE(as<std::string>(), "schema_1", "schema_2_first",
                                      "schema_2_first_view", "schema_3", "schema_4");
    CAPTURE(name);
    const fs::path file = recordings.home / "old.dibhr";
    REQUIRE(change(
        file, read_text(fs::path(DIBHR_SOURCE_DIR) / "tests/data/sessions" / (name + ".sql"))));
    CHECK(write_archive(recordings.request({file})).sessions == 1);
    CHECK(faults_of(recordings.archive) == kNone);
    const auto kept =
        recordings.archive / "sourcedata/sub-unlabelled/sub-unlabelled_task-touch_run-001.dibhr";
    if (fs::exists(kept)) require_same_ticks(file, kept);
}

TEST_CASE("an archive that cannot be whole is not there at all", "[archive]") {
    const Recordings recordings;
    const fs::path good =
        recordings.session("good.dibhr", "P07", 20, recordings.video("hill.png", "hill"));
    const fs::path bad = recordings.home / "bad.dibhr";
    ArchiveRequest request = recordings.request({good, bad});
    SECTION("a file that is no session") {
        write_text(bad, "text");
        CHECK(refusal_of(request).starts_with(bad.string() + ": is not a session"));
    }
    SECTION("a session of a newer dibhr") {
        fs::copy_file(good, bad);
        REQUIRE(change(bad, "PRAGMA user_version = 99"));
        CHECK(contains(refusal_of(request), "update dibhr"));
    }
    SECTION("work that is ended") {
        request.files = {good};
        const double last = GENERATE(0.0, 0.9, 1.0);
        request.progress = [last](double share) {
            if (share >= last) throw InputError("ended");
        };
        CHECK(refusal_of(request) == "ended");
    }
    CHECK(names_in(recordings.folder.path()) == std::vector<std::string>{kHome});
    SECTION("a folder that holds something") {
        fs::create_directory(recordings.archive);
        request.files = {good};
        CHECK(refusal_of(request).empty());
        CHECK(contains(refusal_of(request), "is there already"));
        CHECK(faults_of(recordings.archive) == kNone);
    }
}

TEST_CASE("a path in a text becomes a name", "[archive]") {
    const auto [text, plain] = GENERATE(table<std::string, std::string>(
        {{"/home/me/a b/c.mp4", "c.mp4"},
         {"goals:/home/me/g.csv", "goals:g.csv"},
         {"a = \"/x/y.png\"\nb = '/z/w.png'", "a = \"y.png\"\nb = 'w.png'"},
         {"3 N/mm, and/or 1 / 2", "3 N/mm, and/or 1 / 2"},
         {"see /home/me/x, then /tmp/y", "see x, then y"},
         {"/home/o'neil/Smith, Anna/skin.png", "skin.png"},
         {"from https://example.org/a/b and /home/me/x", "from https://example.org/a/b and x"},
         {"", ""}}));
    CHECK(without_folders(text) == plain);
}
