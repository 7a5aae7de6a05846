// A virtual display with a pointer and a keyboard, and the real program running on it.
#pragma once

#include <sys/types.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/haptics/vec.hpp"
#include "tests/app/program/seat.hpp"
#include "tests/app/program/seen.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::test {

/// A child process; ended at the latest by the destructor, or with this process.
class Process {
  public:
    /// `environment` entries "NAME=value" come on top of this process's own. `error_file`: its
    /// stderr.
    Process(std::vector<std::string> arguments, const std::vector<std::string>& environment,
            const std::filesystem::path& error_file, int inherited_descriptor = -1);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// Waits for its end. The exit code; 128 + signal when it was killed. The test fails when it
    /// does not end within two minutes.
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

/// The program in a window, used by keyboard and mouse and followed turn by turn.
class WindowProgram : public Process {
  public:
    WindowProgram(std::vector<std::string> arguments, std::vector<std::string> environment,
                  const TemporaryFolder& folder, std::shared_ptr<Seat> seat);

    /// The newest turn of the window.
    [[nodiscard]] Seen seen() const { return (*board_)->read(); }
    /// Until a turn shows what `is_so` asks for. The test fails when none does in time,
    /// and when the program ends before.
    void wait_until(const std::function<bool(const Seen&)>& is_so) const;
    /// Until a turn is over that was begun after the call: every event of before is done, and drawn
    /// where it shows.
    void wait_for_turn() const;
    /// Until its window is there, with a surface, and can be touched.
    void wait_for_surface() const;
    /// Events as Seat::act() has them, each of them done in a turn before the next one.
    void act(const std::string& events) const;
    /// The window's thread loops for ever, which it does when this returns.
    void hang() const;
    /// It goes on.
    void go_on() const;

  private:
    WindowProgram(std::vector<std::string> arguments, std::vector<std::string> environment,
                  const std::filesystem::path& error_file, const std::filesystem::path& board,
                  std::shared_ptr<Seat> seat);

    std::shared_ptr<Seat> seat_;
    std::unique_ptr<MappedBoard> board_;
};

/// An X server, 1280 x 800, without a window manager.
class DisplayServer {
  public:
    DisplayServer();

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const Process& process() const { return process_; }
    [[nodiscard]] const std::shared_ptr<Seat>& seat() const { return seat_; }

  private:
    std::array<int, 2> numbers_;  // a pipe: the server writes its display's number
    TemporaryFolder folder_{};
    Process process_;
    std::string name_{};
    std::shared_ptr<Seat> seat_{};
};

/// A display with its keyboard and mouse, which begin at rest.
class Desk {
  public:
    /// Of the server that all desks of this test program share, one after the other.
    Desk();
    /// Of a server of its own, for what stops or kills it.
    [[nodiscard]] static Desk of_its_own() { return Desk(std::make_shared<DisplayServer>()); }

    /// Starts `dibhr view` with these arguments, settings and current folder inside `folder`;
    /// `host`: a program and its own arguments that starts it. Its sound is heard nowhere. It has
    /// led a person before, unless `host` gives it another XDG_STATE_HOME.
    [[nodiscard]] WindowProgram start_viewer(const TemporaryFolder& folder,
                                             const std::vector<std::string>& arguments,
                                             const std::vector<std::string>& host = {}) const;

    /// The same of another command of the program: its words, "study", "run" and so on.
    [[nodiscard]] WindowProgram start(const TemporaryFolder& folder,
                                      const std::vector<std::string>& words,
                                      const std::vector<std::string>& host = {}) const;
    [[nodiscard]] const std::string& display() const { return server_->name(); }  ///< ":7"
    /// What is on the whole display, as raw RGB of 1280 x 800.
    [[nodiscard]] std::string picture() const { return server_->seat()->picture(); }

    // The server stands still, goes on, or dies.
    void stop() const { server_->process().send(SIGSTOP); }
    void resume() const { server_->process().send(SIGCONT); }
    void kill() const { server_->process().send(SIGKILL); }

    /// Events as Seat::act() has them; nobody waits until they are seen.
    void press(const std::string& events) const { server_->seat()->act(events); }

  private:
    explicit Desk(std::shared_ptr<DisplayServer> server);

    std::shared_ptr<DisplayServer> server_;
};

/// A tick as the session file has it.
struct Row {
    double t_s{0.0};
    Vec3 goal{0.0}, proxy{0.0}, spring_newton{0.0}, sent_newton{0.0};
    bool contact{false};
    bool pressed{false};
    int cut{0};
    double video_s{0.0};
    bool surface{false};           ///< there was one to touch
    bool ready{false};             ///< the hand gives poses
    bool mouse_fallback{false};    ///< it is the mouse, in place of a Falcon
    bool releases_contact{false};  ///< a proxy in contact begins anew, above the goal
    bool in_time{false};  ///< its two frames follow each other in the file, as far apart as there
    double stiffness_newton_per_mm{0.0};  ///< as the device could stand it
};

[[nodiscard]] std::vector<Row> read_session(const std::filesystem::path& file);

/// Moments of the video that were held for longer than a quarter of a second, one after the other.
[[nodiscard]] std::vector<double> held_moments(const std::vector<Row>& rows);

/// The events happen while the window's thread stands still, as in one slow picture; `times` of
/// them as far apart as a person's: GLFW takes a key that goes down within 20 ms for one held down.
void act_in_one_picture(const Desk& desk, const WindowProgram& viewer, const std::string& events,
                        int times = 1);

/// Runs a command line in a shell; fails the test when it fails.
void run_shell(const std::string& command);

/// Replays a session into `folder`, over its video and from the surface in it; fails the test
/// unless all of it comes again, bit for bit, and of the updates of every algorithm at least 99.5 %
/// read only what is stored.
void require_same_bits(const TemporaryFolder& folder, const std::filesystem::path& session);

}  // namespace dibhr::test
