// `dibhr devices --check` as the real program with a simulated Falcon on its USB: without a person,
// and at a terminal.
#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/app/program/command_program.hpp"
#include "tests/app/program/falcon_on_usb.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"

using namespace dibhr::test;

namespace {

constexpr std::chrono::seconds kPatience{60};  // only reached by a failure

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// The program on a pseudo-terminal, with a simulated person who reads and types.
class AtTerminal {
  public:
    AtTerminal(const TemporaryFolder& folder, std::vector<std::string> words) {
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        child_ = forkpty(&terminal_, nullptr, nullptr, nullptr);
        REQUIRE(child_ >= 0);
        if (child_ == 0) {
            setenv("XDG_CONFIG_HOME", folder.path().c_str(), 1);
            setenv("XDG_DATA_HOME", folder.path().c_str(), 1);
            if (chdir(folder.path().c_str()) == 0) execv(arguments[0], arguments.data());
            _exit(127);
        }
    }
    ~AtTerminal() {
        close(terminal_);
        if (child_ > 0) {
            kill(child_, SIGKILL);
            waitpid(child_, nullptr, 0);
        }
    }
    AtTerminal(const AtTerminal&) = delete;
    AtTerminal& operator=(const AtTerminal&) = delete;

    /// Reads until this text is printed, from where the last call ended.
    void read_until(const std::string& wanted) {
        INFO("waits for: " << wanted);
        const bool read = eventually(
            [&] {
                take();
                return text_.find(wanted, read_) != std::string::npos;
            },
            kPatience);
        INFO(text_);
        REQUIRE(read);
        read_ = text_.find(wanted, read_) + wanted.size();
    }
    void type(const std::string& keys) const {
        REQUIRE(write(terminal_, keys.data(), keys.size()) == static_cast<ssize_t>(keys.size()));
    }
    void answer(const std::string& question, const std::string& line) {
        read_until(question);
        read_until("> ");
        type(line + "\n");
    }
    void hang_up() {
        close(terminal_);
        terminal_ = -1;
    }
    /// Waits for the end of the program; its exit code.
    int ended() {
        int status = 0;
        const bool ended = eventually(
            [&] {
                if (terminal_ >= 0) take();
                return waitpid(child_, &status, WNOHANG) != 0;
            },
            kPatience);
        REQUIRE(ended);
        child_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

  private:
    void take() {
        pollfd input{terminal_, POLLIN, 0};
        if (poll(&input, 1, 0) <= 0) return;
        std::array<char, 4096> bytes{};
        const ssize_t got = read(terminal_, bytes.data(), bytes.size());
        if (got > 0) text_.append(bytes.data(), static_cast<std::size_t>(got));
    }

    int terminal_{-1};
    pid_t child_{-1};
    std::string text_{};
    std::size_t read_{0};
};

/// The check at its question before the first force on the scale, with a homed Falcon.
struct BeforeForce {
    TemporaryFolder folder{};
    FalconOnUsb falcon{folder.path(), {"firmware", "home"}};
    AtTerminal person;

    BeforeForce() : person(folder, words()) {
        for (const int step : {1, 2, 3, 4, 5, 6}) {
            person.answer(std::to_string(step) + " of 9", "s");
        }
        person.answer("7 of 9", "f");
        person.read_until("500 counts");
        person.read_until("> ");
    }

    /// The force has risen: it is held for three seconds, and then falls by itself.
    void begin_force() {
        person.type("f\n");
        FalconOnUsb::wait_until([this] { return falcon.number("largest") > 499.5; });
        constexpr double kPackets = 50.0;  // at full force
        const double risen = falcon.number("with_force");
        FalconOnUsb::wait_until(
            [this, risen] { return falcon.number("with_force") > risen + kPackets; });
    }
    /// By a key.
    void wait_for_release() {
        person.read_until("released, because a key was pressed");
        FalconOnUsb::wait_until([this] { return falcon.number("zeros_in_a_row") > 4.5; });
        CHECK(falcon.number("largest") < 500.5);
    }

  private:
    [[nodiscard]] std::vector<std::string> words() const {
        std::vector<std::string> all = falcon.host();
        all.insert(all.end(), {DIBHR_PROGRAM, "devices", "--check", "--out", "record.json"});
        return all;
    }
};

void check_summary_and_record(const ProgramResult& result, const TemporaryFolder& folder) {
    INFO(result.errors);
    CHECK(result.exit_code == 0);
    CHECK(result.errors.empty());
    CHECK(says(result.output, "What was found"));
    std::string record;
    for (const std::string& name : names_in(folder.path())) {
        if (name.starts_with("falcon-check-SIM00001-")) record = read_text(folder / name);
    }
    CHECK(says(record, "\"idProduct\": \"0xcb48\""));
    CHECK(says(record, "\"end\": \"skipped\""));
}

}  // namespace

TEST_CASE("a check takes its answers from a pipe, and keeps a record", "[falcon][check]") {
    const TemporaryFolder folder;
    const FalconOnUsb falcon(folder.path(), {"firmware"});
    std::vector<std::string> host{"/bin/sh", "-c",
                                  "printf '\\ns\\ns\\ns\\ns\\ns\\ns\\ns\\ns\\n' | \"$0\" \"$@\""};
    for (const std::string& word : falcon.host()) host.push_back(word);
    check_summary_and_record(run_dibhr(folder, {"devices", "--check"}, host), folder);
}

TEST_CASE("a check measures with the usual mechanism where nobody has agreed to another",
          "[falcon][check]") {
    const TemporaryFolder folder;
    const FalconOnUsb bare(folder.path(), {});
    std::filesystem::create_directories(folder / "dibhr");
    write_text(folder / "dibhr/settings.toml", "[falcon]\nthigh = 0.09\n");
    const ProgramResult result = run_dibhr(folder, {"devices", "--check"}, bare.host());
    CHECK(says(result.errors,
               "settings.toml asks for Falcon's thigh [m] 0.09 in place of 0.06: "
               "the default is used"));
}

TEST_CASE("without a person the check measures what needs none, and keeps a record",
          "[falcon][check][realtime]") {
    const TemporaryFolder folder;
    const FalconOnUsb falcon(folder.path(), {"firmware"});
    check_summary_and_record(run_dibhr(folder, {"devices", "--check"}, falcon.host()), folder);
}

TEST_CASE("a check that cannot be done ends with 1 and one line", "[falcon][check]") {
    const TemporaryFolder folder;
    const FalconOnUsb bare(folder.path(), {});
    const ProgramResult no_firmware = run_dibhr(folder, {"devices", "--check"}, bare.host());
    CHECK(no_firmware.exit_code == 1);
    INFO(no_firmware.errors);
    CHECK(says(no_firmware.errors, "then: dibhr devices --check --firmware FILE"));
    CHECK(split(no_firmware.errors, '\n').size() == 2);
    const ProgramResult nowhere =
        run_dibhr(folder, {"devices", "--check", "--out", "none/record.json"}, bare.host());
    CHECK(nowhere.exit_code == 1);
    CHECK(says(nowhere.errors, "none/record.json"));
    CHECK(run_dibhr(folder, {"devices", "--out", "record.json"}).exit_code == 2);
}

TEST_CASE("any key lets go of a force, and the check goes on", "[falcon][check]") {
    BeforeForce at;
    at.begin_force();
    at.person.type("x71\nf\n");  // typed before the next question: answers none
    at.wait_for_release();
    at.person.answer("What did the scale show", "70");
    at.person.read_until("1000 counts");
    CHECK(at.falcon.number("largest") < 500.5);
    at.person.answer("", "q");
    at.person.read_until("Motor counts a newton metre");
    CHECK(at.person.ended() == 0);
    CHECK(says(read_text(at.folder / "record.json"), "\"scale_g\": 70"));
}

TEST_CASE("an Enter, which may have been meant for the step before, begins no force",
          "[falcon][check]") {
    BeforeForce at;
    at.person.type("\n");
    at.person.read_until("There is no force until you type F.");
    CHECK(at.falcon.number("with_force") < 0.5);
    at.person.answer("", "q");
    CHECK(at.person.ended() == 0);
}

TEST_CASE("q, Ctrl+C and a terminal that is closed end a force and the check at once",
          "[falcon][check]") {
    const std::string how = GENERATE(as<std::string>(), "q", "\x03", "hang up");
    CAPTURE(how);
    BeforeForce at;
    at.begin_force();
    if (how == "hang up") {
        at.person.hang_up();
    } else {
        at.person.type(how);
    }
    const auto record = [&at] { return read_text(at.folder / "record.json"); };
    FalconOnUsb::wait_until([&] { return says(record(), "\"end\": \"quit\""); });
    CHECK_FALSE(says(record(), "\"end\": \"held\""));  // the force did not end by itself
    const int exit_code = at.person.ended();
    CHECK((how == "hang up" || exit_code == 0));  // nobody is left to print the summary for
}

TEST_CASE("Ctrl+Z and Ctrl+\\ let go of a force, and do not stop the program that held it",
          "[falcon][check]") {
    const std::string keys = GENERATE(as<std::string>(), "\x1a", "\x1c");
    BeforeForce at;
    at.begin_force();
    at.person.type(keys);
    at.wait_for_release();
    at.person.answer("What did the scale show", "q");
    CHECK(at.person.ended() == 0);
}
