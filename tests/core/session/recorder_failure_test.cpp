// The recorder when the disk does not play along: plain words, and nothing lost that was written.
#include <sys/resource.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include "core/error.hpp"
#include "core/session/recorder.hpp"
#include "tests/core/session/session_folder.hpp"
#include "tests/support/catch.hpp"

namespace {

using dibhr::Recorder;
using dibhr::TickRing;
using dibhr::test::answer;
using dibhr::test::eventually;
using dibhr::test::push;
using dibhr::test::SessionFolder;
using dibhr::test::tick_record;

/// What recording to `file` is refused with; empty when it is not.
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

}  // namespace

TEST_CASE("a file that exists is never overwritten", "[session]") {
    const SessionFolder folder;
    std::ofstream(folder.file()) << "my thesis";
    CHECK(refusal_of(folder.file()) ==
          folder.file().string() + ": exists already; choose another name for the session");
    std::ifstream kept(folder.file());
    CHECK(std::string(std::istreambuf_iterator<char>(kept), {}) == "my thesis");
}

TEST_CASE("a folder that is not there is named, with what to do", "[session]") {
    const SessionFolder folder;
    const auto file = folder.path() / "nowhere" / "touch.dibhr";
    CHECK(refusal_of(file) ==
          file.string() +
              ": the session cannot be recorded there (No such file or directory); "
              "choose a folder that can be written to");
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
    const auto ring = std::make_unique<TickRing>();
    std::uint64_t rows = 0;
    {
        const FileSizeLimit limit(1'000'000);
        const Recorder recorder(folder.file(), *ring, {});
        std::int64_t n = 0;
        while (n < 100) push(*ring, tick_record(n++));
        REQUIRE(eventually([&] { return recorder.status().rows == 100; }));
        while (recorder.status().failure.empty() && n < 200'000) push(*ring, tick_record(n++));
        const auto status = recorder.status();
        CHECK(status.failure.starts_with("Recording to " + folder.file().string() + " stopped: "));
        CHECK(status.failure.find('\n') == std::string::npos);
        CHECK_FALSE(status.recording);
        rows = status.rows;
        for (int k = 0; k < 3 * 16384; ++k) push(*ring, tick_record(n++));
        CHECK(recorder.status().rows == rows);
    }
    CHECK(rows >= 100);
    CHECK(answer(folder.file(), "SELECT count(*) FROM tick") == std::to_string(rows));
    CHECK(answer(folder.file(), "SELECT value FROM session WHERE key = 'complete'") == "0");
    CHECK(answer(folder.file(), "PRAGMA integrity_check") == "ok");
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
