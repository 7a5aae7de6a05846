// The desktop's dialog, by a portal and by helper programs: usual, unusual and faulty ones.
#include "app/desktop/file_dialog.hpp"

#include <chrono>
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "tests/app/program/session_bus.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/environment_variable.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

namespace fs = std::filesystem;
using namespace dibhr;
using namespace dibhr::test;
using namespace std::chrono_literals;

namespace {

const FileQuestion question_asked{
    .title = "Open a recording",
    .folder = "/a folder/of mine",
    .filters = {{"Recordings", {"*.mp4", "*.MP4"}}, {"All files", {"*"}}},
    .x11_window = 0x2a0000f};

/// No timeout passes, and every answer is slow enough to be a person's.
constexpr DialogTimeouts kPatient{.bus = 1h, .portal = 1h, .shortest_human_reply = 0ms};
/// No timeout passes, and every answer is too quick to be a person's.
constexpr DialogTimeouts kAllAtOnce{.bus = 1h, .portal = 1h, .shortest_human_reply = 1h};

/// The answer of a dialog, and the request that the portal received.
struct Asked {
    FileAnswer answer{};
    PortalAsked portal{};
};

Asked ask(const PortalManner& manner, const DialogTimeouts& times = kPatient) {
    const SessionBus bus;
    const Portal portal(bus, manner);
    const EnvironmentVariable address("DBUS_SESSION_BUS_ADDRESS", bus.address().c_str());
    const Cancellation cancellation;
    Asked asked;
    asked.answer = ask_portal(question_asked, cancellation, times);
    if (!manner.replies) static_cast<void>(eventually([&] { return portal.asked().closed; }));
    asked.portal = portal.asked();
    return asked;
}

/// A folder of helper programs that replaces PATH, since the machine may have real ones.
class Helpers {
  public:
    void add(const std::string& name, const std::string& script) {
        const fs::path file = folder_ / "bin" / name;
        fs::create_directories(file.parent_path());
        write_text(file, "#!/bin/sh\n" + script);
        fs::permissions(file, fs::perms::owner_all);
    }
    [[nodiscard]] fs::path file(const char* name) const { return folder_ / name; }
    [[nodiscard]] std::string path() const { return (folder_ / "bin").string(); }
    /// Prints its arguments, one between brackets, into a file.
    [[nodiscard]] std::string writes_arguments() const {
        return "for word; do printf '[%s]' \"$word\"; done > '" + file("words").string() + "'\n";
    }

  private:
    TemporaryFolder folder_{};
};

FileAnswer ask(const Helpers& helpers, const std::string& desktop = "GNOME",
               const DialogTimeouts& times = kPatient) {
    const EnvironmentVariable path("PATH", helpers.path().c_str());
    const EnvironmentVariable kind("XDG_CURRENT_DESKTOP", desktop.c_str());
    const Cancellation cancellation;
    return ask_helper(question_asked, cancellation, times);
}

/// The answer of a dialog that was called off.
FileAnswer answer_of(std::future<FileAnswer>& asking) {
    REQUIRE(eventually([&asking] { return asking.wait_for(0s) == std::future_status::ready; }));
    return asking.get();
}

}  // namespace

TEST_CASE("the portal is asked for files, over the window, and gives those that were chosen",
          "[dialog]") {
    const bool old = GENERATE(false, true);
    const Asked asked =
        ask({.old = old,
             .addresses = {"file:///tmp/a%20film%C3%A4.mp4", "file://host/tmp/line%0Abreak.png"}});
    CHECK(asked.answer.outcome == FileAnswer::Outcome::chosen);
    CHECK(asked.answer.files ==
          std::vector<fs::path>{"/tmp/a film\xc3\xa4.mp4", "/tmp/line\nbreak.png"});
    CHECK(asked.portal.parent == "x11:2a0000f");
    CHECK(asked.portal.title == question_asked.title);
    CHECK(asked.portal.folder == question_asked.folder);
    CHECK(asked.portal.filters == std::vector<std::string>{"Recordings", "All files"});
    CHECK(asked.portal.patterns == std::vector<std::string>{"*.mp4", "*.MP4", "*"});
    CHECK(asked.portal.multiple);
    CHECK_FALSE(asked.portal.modal);  // so that F8 in the window can switch the force off
    CHECK_FALSE(asked.portal.closed);
}

TEST_CASE("a person who cancels has answered, a portal that gives up at once has not", "[dialog]") {
    CHECK(ask({.response = 1}, kAllAtOnce).answer.outcome == FileAnswer::Outcome::cancelled);
    CHECK(ask({.response = 2}, kPatient).answer.outcome == FileAnswer::Outcome::cancelled);
    CHECK(ask({.response = 2}, kAllAtOnce).answer.outcome == FileAnswer::Outcome::unavailable);
    CHECK(ask({.response = 0}, kAllAtOnce).answer.outcome ==
          FileAnswer::Outcome::unavailable);  // nothing chosen
}

TEST_CASE("a portal that is missing, refuses, goes away or does not answer is not waited for",
          "[dialog]") {
    constexpr DialogTimeouts kBriefToPortal{.bus = 1h, .portal = 20ms};
    constexpr DialogTimeouts kBriefToBus{.bus = 20ms, .portal = 1h};
    CHECK(ask({.refuses = true}).answer.outcome == FileAnswer::Outcome::unavailable);
    CHECK(ask({.vanishes = true}).answer.outcome == FileAnswer::Outcome::unavailable);
    const Asked mute = ask({.replies = false}, kBriefToPortal);
    CHECK(mute.answer.outcome == FileAnswer::Outcome::unavailable);
    CHECK(mute.portal.closed);  // it may only be slow
    const Cancellation cancellation;
    {
        const SessionBus empty;
        const EnvironmentVariable address("DBUS_SESSION_BUS_ADDRESS", empty.address().c_str());
        CHECK(ask_portal(question_asked, cancellation, kPatient).outcome ==
              FileAnswer::Outcome::unavailable);
        empty.stop();
        CHECK(ask_portal(question_asked, cancellation, kBriefToBus).outcome ==
              FileAnswer::Outcome::unavailable);
    }
    for (const char* const wrong : {"disabled:", "unix:path=/gone", "nonsense", "unix:"}) {
        const EnvironmentVariable address("DBUS_SESSION_BUS_ADDRESS", wrong);
        CHECK(ask_portal(question_asked, cancellation, kPatient).outcome ==
              FileAnswer::Outcome::unavailable);
    }
}

TEST_CASE("a question that is called off closes its dialog, answered by the portal or not",
          "[dialog]") {
    const bool replies = GENERATE(true, false);
    const SessionBus bus;
    const Portal portal(bus, {.replies = replies, .answers = false});
    const EnvironmentVariable address("DBUS_SESSION_BUS_ADDRESS", bus.address().c_str());
    const Cancellation cancellation;
    auto asking = std::async(std::launch::async, [&cancellation] {
        return ask_portal(question_asked, cancellation, kPatient);
    });
    REQUIRE(eventually([&] { return portal.asked().times == 1; }));
    cancellation.cancel();
    CHECK(answer_of(asking).outcome == FileAnswer::Outcome::cancelled);
    CHECK(eventually([&] { return portal.asked().closed; }));
}

TEST_CASE("without a session bus, and from another machine, there is no desktop", "[dialog]") {
    const EnvironmentVariable here("SSH_CONNECTION", "");
    const EnvironmentVariable folder("XDG_RUNTIME_DIR", "/nowhere");
    {
        const EnvironmentVariable address("DBUS_SESSION_BUS_ADDRESS",
                                          "unix:path=/run/user/1000/bus");
        CHECK(has_desktop());
        const EnvironmentVariable afar("SSH_CONNECTION", "10.0.0.1 5000 10.0.0.2 22");
        CHECK_FALSE(has_desktop());
    }
    for (const char* const none : {"", "disabled:"}) {
        const EnvironmentVariable address("DBUS_SESSION_BUS_ADDRESS", none);
        CHECK_FALSE(has_desktop());
    }
    const TemporaryFolder runtime;
    write_text(runtime / "bus", "");
    const EnvironmentVariable address("DBUS_SESSION_BUS_ADDRESS", "");
    const EnvironmentVariable usual("XDG_RUNTIME_DIR", runtime.path().c_str());
    CHECK(has_desktop());
}

TEST_CASE("zenity is asked without a shell, and gives paths with blanks and line breaks",
          "[dialog]") {
    Helpers helpers;
    helpers.add("zenity",
                helpers.writes_arguments() +
                    "printf '/a b/$HOME.mp4\\n/tmp/two\\nlines.png\\n/tmp/\"c\".png\\n'\n");
    const FileAnswer answer = ask(helpers);
    CHECK(answer.outcome == FileAnswer::Outcome::chosen);
    CHECK(answer.files ==
          std::vector<fs::path>{"/a b/$HOME.mp4", "/tmp/two\nlines.png", "/tmp/\"c\".png"});
    CHECK(read_text(helpers.file("words")) ==
          "[--file-selection][--multiple][--separator=\n][--title=Open a recording]"
          "[--filename=/a folder/of mine/][--file-filter=Recordings | *.mp4 *.MP4]"
          "[--file-filter=All files | *]");
}

TEST_CASE("kdialog is asked on KDE, and where there is no other", "[dialog]") {
    Helpers helpers;
    helpers.add("kdialog", helpers.writes_arguments() + "echo /tmp/k.mp4\n");
    CHECK(ask(helpers, "Openbox").files == std::vector<fs::path>{"/tmp/k.mp4"});
    helpers.add("zenity", "echo /tmp/z.mp4\n");
    CHECK(ask(helpers, "XFCE").files == std::vector<fs::path>{"/tmp/z.mp4"});
    CHECK(ask(helpers, "KDE").files == std::vector<fs::path>{"/tmp/k.mp4"});
    CHECK(read_text(helpers.file("words")) ==
          "[--title][Open a recording][--multiple][--separate-output][--attach][44040207]"
          "[--getopenfilename][/a folder/of mine]"
          "[Recordings (*.mp4 *.MP4)\nAll files (*)]");
}

TEST_CASE("a helper's person may cancel; one that cannot show itself leaves it to the next",
          "[dialog]") {
    Helpers helpers;
    helpers.add("kdialog", "exit 254\n");
    helpers.add("qarma", "kill -SEGV $$\n");
    helpers.add("zenity", "exit 1\n");
    CHECK(ask(helpers, "GNOME", kPatient).outcome == FileAnswer::Outcome::cancelled);
    CHECK(ask(helpers, "GNOME", kAllAtOnce).outcome == FileAnswer::Outcome::unavailable);
    helpers.add("zenity", "exit 0\n");
    CHECK(ask(helpers, "GNOME", kAllAtOnce).outcome == FileAnswer::Outcome::cancelled);
    helpers.add("zenity", "exit 1\n");
    helpers.add("qarma", "echo /tmp/q.mp4\n");
    CHECK(ask(helpers, "GNOME", kAllAtOnce).files == std::vector<fs::path>{"/tmp/q.mp4"});
}

TEST_CASE("a helper that hangs is ended when the question is called off, with all it has started",
          "[dialog]") {
    Helpers helpers;
    const fs::path told = helpers.file("told");
    const std::string stubborn = GENERATE("", "trap '' TERM\n", "exec >&-\n");
    helpers.add("zenity", stubborn + "/bin/sleep 1000 & echo $! > '" + told.string() + "'\nwait\n");
    const EnvironmentVariable path("PATH", helpers.path().c_str());
    const EnvironmentVariable kind("XDG_CURRENT_DESKTOP", "");
    const Cancellation cancellation;
    auto asking = std::async(std::launch::async, [&cancellation] {
        return ask_helper(question_asked, cancellation, kPatient);
    });
    REQUIRE(eventually([&] { return fs::exists(told) && !read_text(told).empty(); }));
    cancellation.cancel();
    CHECK(answer_of(asking).outcome == FileAnswer::Outcome::cancelled);
    const std::string child = read_text(told);
    const fs::path words = "/proc/" + child.substr(0, child.find('\n')) + "/cmdline";
    CHECK(eventually([&words] { return read_text(words).empty(); }));
}
