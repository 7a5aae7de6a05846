// The recorder when the disk fails: a plain message, and nothing lost that was written.
#include <sys/mount.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "core/error.hpp"
#include "core/session/recorder.hpp"
#include "core/session/session.hpp"
#include "tests/core/session/session_child.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

namespace {

using dibhr::Recorder;
using dibhr::RecorderStatus;
using dibhr::Session;
using dibhr::TickRing;
using dibhr::test::answer;
using dibhr::test::Counters;
using dibhr::test::eventually;
using dibhr::test::output_of;
using dibhr::test::push;
using dibhr::test::read_text;
using dibhr::test::SessionFolder;
using dibhr::test::tick_record;

/// A disk of its own, of a megabyte, in `folder`; only root may have one.
class SmallDisk {
  public:
    explicit SmallDisk(const std::filesystem::path& folder) : folder_(folder) {
        std::filesystem::create_directory(folder);
        mounted_ = ::mount("tmpfs", folder.c_str(), "tmpfs", 0, "size=1m") == 0;
    }
    ~SmallDisk() {
        if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;
    [[nodiscard]] bool mounted() const { return mounted_; }

  private:
    std::filesystem::path folder_;
    bool mounted_{false};
};

/// Records until it fails; the producer does not notice.
RecorderStatus record_until_it_fails(const std::filesystem::path& file) {
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(file, *ring, {});
    std::int64_t n = 0;
    while (n < 2000) push(*ring, tick_record(n++));
    CHECK(eventually([&] { return recorder.status().rows == 2000; }));
    while (recorder.status().failure.empty() && n < 1'000'000) push(*ring, tick_record(n++));
    const RecorderStatus failed = recorder.status();
    for (int k = 0; k < 3 * 16384; ++k) push(*ring, tick_record(n++));
    CHECK(recorder.status().rows == failed.rows);
    CHECK(recorder.status().dropped == 0);
    recorder.parameters({});
    recorder.mark("late");  // goes nowhere, and harms nothing
    return recorder.finish();
}

/// The error of recording to `file`; empty: none.
std::string refusal_of(const std::filesystem::path& file) {
    const auto ring = std::make_unique<TickRing>();
    try {
        const Recorder recorder(file, *ring, {});
    } catch (const dibhr::InputError& error) {
        return error.what();
    }
    return {};
}

/// No file of this process may grow beyond `bytes`, as on a full disk; undone with the object.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(rlim_t bytes) {
        std::signal(SIGXFSZ, SIG_IGN);
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limited{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limited);
    }
    ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before_); }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    rlimit before_{};
};

/// Makes a removed folder the working directory, until the object is destroyed.
class LostFolder {
  public:
    explicit LostFolder(const std::filesystem::path& folder)
        : before_(std::filesystem::current_path()) {
        std::filesystem::create_directory(folder);
        std::filesystem::current_path(folder);
        std::filesystem::remove(folder);
    }
    ~LostFolder() { std::filesystem::current_path(before_); }
    LostFolder(const LostFolder&) = delete;
    LostFolder& operator=(const LostFolder&) = delete;

  private:
    std::filesystem::path before_;
};

}  // namespace

TEST_CASE("a file that exists is never overwritten", "[session]") {
    const SessionFolder folder;
    std::ofstream(folder.file()) << "my thesis";
    CHECK(refusal_of(folder.file()) ==
          folder.file().string() + ": exists already; choose another name for the session");
    CHECK(read_text(folder.file()) == "my thesis");
}

TEST_CASE("a folder that is not there is named, with what to do", "[session]") {
    const SessionFolder folder;
    const auto file = folder.path() / "nowhere" / "touch.dibhr";
    CHECK(refusal_of(file) ==
          file.string() +
              ": the session cannot be recorded there (No such file or directory); "
              "make the folder, or choose another");
}

TEST_CASE("a folder that cannot be written to is refused and left as it is", "[session]") {
    // Not by permissions: they do not hold for root.
    CHECK(refusal_of("/proc/touch.dibhr").starts_with("/proc/touch.dibhr: the session cannot be "));
}

TEST_CASE("a disk that is full from the start leaves no half file behind", "[session]") {
    const SessionFolder folder;
    std::string refusal;
    {
        const FileSizeLimit limit(2000);
        refusal = refusal_of(folder.file());
    }
    CHECK(refusal.starts_with(folder.file().string() + ": the session cannot be recorded there ("));
    CHECK(refusal.find('\n') == std::string::npos);
    CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE(
    "when the disk fills up the status says so, the ring still empties, and the file stays "
    "readable",
    "[session]") {
    const SessionFolder folder;
    std::uint64_t rows = 0;
    {
        const FileSizeLimit limit(1'000'000);
        const RecorderStatus status = record_until_it_fails(folder.file());
        CHECK(status.failure.starts_with("Recording to " + folder.file().string() + " stopped: "));
        CHECK(status.failure.find('\n') == std::string::npos);
        CHECK_FALSE(status.recording);
        rows = status.rows;
    }
    CHECK(rows >= 2000);
    CHECK(answer(folder.file(), "SELECT count(*) FROM tick") == std::to_string(rows));
    CHECK(answer(folder.file(), "SELECT value FROM session WHERE key = 'complete'") == "0");
    CHECK(answer(folder.file(), "PRAGMA integrity_check") == "ok");
}

TEST_CASE("on a small disk that fills up, what was recorded stays readable where it is",
          "[session]") {
    const SessionFolder folder;
    const SmallDisk disk(folder.path() / "disk");
    if (!disk.mounted()) {
        WARN("not allowed to mount a small disk: only the limited file was tried");
        return;
    }
    const auto file = folder.path() / "disk" / "touch.dibhr";
    const RecorderStatus status = record_until_it_fails(file);
    CAPTURE(status.failure);
    CHECK(status.failure.starts_with("Recording to " + file.string() + " stopped: "));
    CHECK(status.failure.find("full") != std::string::npos);
    CHECK(status.rows >= 2000);
    const Session session(file);  // on the full disk
    CHECK_NOTHROW(session.check());
    CHECK(session.rows() == static_cast<std::int64_t>(status.rows));
    CHECK(session.missing() == 0);
}

TEST_CASE("when another file takes its place the status says so, and both stay as they are",
          "[session]") {
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(folder.file(), *ring, {});
    push(*ring, tick_record(0));
    REQUIRE(eventually([&] { return recorder.status().rows == 1; }));
    const auto other = folder.path() / "other";
    std::ofstream(other) << "my thesis";
    std::filesystem::rename(other, folder.file());
    std::int64_t n = 1;
    CHECK(eventually([&] {
        push(*ring, tick_record(n++));
        return !recorder.status().failure.empty();
    }));
    CHECK(recorder.status().failure.find("another file is in its place") != std::string::npos);
    recorder.finish();
    CHECK(read_text(folder.file()) == "my thesis");
}

TEST_CASE("a file that is made read-only meanwhile is recorded to its end", "[session]") {
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(folder.file(), *ring, {});
    push(*ring, tick_record(0));
    REQUIRE(eventually([&] { return recorder.status().rows == 1; }));
    std::filesystem::permissions(folder.file(), std::filesystem::perms::owner_read);
    for (std::int64_t n = 1; n < 5000; ++n) push(*ring, tick_record(n));
    const RecorderStatus status = recorder.finish();
    CHECK(status.failure.empty());
    CHECK(answer(folder.file(), "SELECT count(*) FROM tick") == "5000");
}

TEST_CASE("when the folder is removed the status says so, and the ring still empties",
          "[session]") {
    const SessionFolder folder;
    const auto ring = std::make_unique<TickRing>();
    const Recorder recorder(folder.file(), *ring, {});
    push(*ring, tick_record(0));
    REQUIRE(eventually([&] { return recorder.status().rows == 1; }));
    std::filesystem::remove_all(folder.path());
    std::int64_t n = 1;
    CHECK(eventually([&] {
        push(*ring, tick_record(n++));
        return !recorder.status().failure.empty();
    }));
    CAPTURE(recorder.status().failure);
    CHECK_FALSE(recorder.status().recording);
    for (int k = 0; k < 2 * 16384; ++k) push(*ring, tick_record(n++));
}

TEST_CASE("files named relative to a working directory that is gone do not end a recording",
          "[session]") {
    const SessionFolder folder;
    const LostFolder lost(folder.path() / "lost");
    const auto ring = std::make_unique<TickRing>();
    Recorder recorder(folder.file(), *ring, {});
    dibhr::SessionParameters parameters{.version = 1, .touch = {}, .limits = {}, .bump = {}};
    parameters.bump.file = "bumps.png";
    recorder.parameters(parameters);
    recorder.media(1, "colour.mp4", "depth.mp4");
    dibhr::TickRecord tick = tick_record(0);
    tick.settings = 1;
    tick.surface = true;
    tick.frames.source.media = 1;
    push(*ring, tick);
    const RecorderStatus status = recorder.finish();
    CHECK(status.failure.empty());
    CHECK(status.rows == 1);
    CHECK(answer(folder.file(), "SELECT file FROM media ORDER BY id LIMIT 1") == "bumps.png");
    CHECK(answer(folder.file(), "SELECT count(*) FROM media") == "3");
}

TEST_CASE("a disk that cannot be flushed ends the recording with a reason, and not at its end",
          "[session]") {
    const SessionFolder folder;
    const std::string counters = (folder.path() / "counters").string();
    std::ofstream(counters) << std::string(sizeof(Counters), '\0');
    const std::string said = output_of("timeout 60 " DIBHR_SESSION_CHILD " " +
                                       folder.file().string() + " " + counters + " 1 fails");
    CHECK(said == "Recording to " + folder.file().string() +
                      " stopped: it cannot be flushed to the disk (Input/output error). What was "
                      "recorded until then is kept.\n");
    CHECK(answer(folder.file(), "PRAGMA integrity_check") == "ok");
    CHECK(answer(folder.file(), "SELECT count(*) > 0 FROM tick") == "1");
}
