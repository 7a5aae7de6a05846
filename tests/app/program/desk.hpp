// A virtual display with a pointer and a keyboard, and the real program running on it.
#pragma once

#include <sys/types.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/haptics/vec.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::test {

/// A child process; ended at the latest by the destructor.
class Process {
  public:
    /// `environment` entries "NAME=value" come on top of this process's own. `error_file`: its
    /// stderr.
    Process(std::vector<std::string> arguments, const std::vector<std::string>& environment,
            const std::filesystem::path& error_file, int inherited_descriptor = -1);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// Waits for its end. The exit code; 128 + signal when it was killed.
    int wait();
    [[nodiscard]] bool has_ended() const;
    void interrupt();  ///< SIGINT, as Ctrl+C does
    void send(int signal) const;
    /// To the program that it has started, as falcon_host has; the test fails when there is none.
    void signal_program(int number) const;
    [[nodiscard]] std::size_t resident_bytes() const;

  private:
    pid_t child_{-1};
};

/// An X server of its own, 1280 x 800, without a window manager.
class Desk {
  public:
    Desk();

    /// Starts `dibhr view` with these arguments, settings and current folder inside `folder`;
    /// `host`: a program and its own arguments that starts it. Its sound is heard nowhere.
    [[nodiscard]] Process start_viewer(const TemporaryFolder& folder,
                                       const std::vector<std::string>& arguments,
                                       const std::vector<std::string>& host = {}) const;

    /// The same of another command of the program: its words, "study", "run" and so on.
    [[nodiscard]] Process start(const TemporaryFolder& folder,
                                const std::vector<std::string>& words,
                                const std::vector<std::string>& host = {}) const;
    /// What is on the whole display, as raw RGB of 1280 x 800.
    [[nodiscard]] std::string picture() const;

    // The server stands still, goes on, or dies.
    void stop() const { server_.send(SIGSTOP); }
    void resume() const { server_.send(SIGCONT); }
    void kill() const { server_.send(SIGKILL); }

    /// Runs xdotool with one chain of commands; fails the test when it fails.
    void act(const std::string& commands) const;

  private:
    std::array<int, 2> numbers_;  // a pipe: the server writes its display's number
    TemporaryFolder folder_{};
    Process server_;
    std::string display_{};
};

/// A tick as the session file has it.
struct Row {
    double t_s{0.0};
    Vec3 goal{0.0}, proxy{0.0}, spring_newton{0.0}, sent_newton{0.0};
    bool contact{false};
    bool pressed{false};
    int cut{0};
    double video_s{0.0};
    bool surface{false};   ///< there was one to touch
    bool ready{false};     ///< the hand gives poses
    bool stand_in{false};  ///< it is the mouse, in place of a Falcon
    bool lets_go{false};   ///< a proxy in contact begins anew, above the goal
    bool in_time{false};   ///< its two frames follow each other in the file, as far apart as there
};

[[nodiscard]] std::vector<Row> read_session(const std::filesystem::path& file);

/// Moments of the video that were held for longer than a quarter of a second, one after the other.
[[nodiscard]] std::vector<double> held_moments(const std::vector<Row>& rows);

/// Runs a command line in a shell; fails the test when it fails.
void run_shell(const std::string& command);

/// Replays a session into `folder`; fails the test unless all of it comes again, bit for bit.
void require_same_bits(const TemporaryFolder& folder, const std::filesystem::path& session);

}  // namespace dibhr::test
