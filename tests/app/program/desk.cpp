// Processes, the virtual display, and session files for the window's tests.
#include "tests/app/program/desk.hpp"

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "tests/support/catch.hpp"
#include "tests/support/eventually.hpp"
#include "tests/support/text.hpp"

namespace dibhr::test {

namespace fs = std::filesystem;

namespace {

constexpr const char* kState = "state";  // of the program, in the test's folder

/// In the child, between fork and exec.
[[noreturn]] void become(const std::vector<std::string>& arguments,
                         const std::vector<std::string>& environment, const fs::path& error_file,
                         int inherited) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    for (const std::string& entry : environment) ::putenv(::strdup(entry.c_str()));
    const int errors = ::open(error_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(errors, STDERR_FILENO);
    if (inherited >= 0) ::fcntl(inherited, F_SETFD, 0);
    std::vector<char*> words;
    for (const std::string& argument : arguments) words.push_back(::strdup(argument.c_str()));
    words.push_back(nullptr);
    ::execvp(words[0], words.data());
    ::_exit(127);
}

std::array<int, 2> open_pipe() {
    std::array<int, 2> ends{-1, -1};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    return ends;
}

std::vector<std::string> server_arguments(int descriptor) {
    return {"Xvfb",      "-displayfd", std::to_string(descriptor),
            "-screen",   "0",          "1280x800x24",
            "-nolisten", "tcp",        "-noreset"};
}

/// The display's number, which the server writes when it is ready.
std::string display_from(int descriptor) {
    std::string number;
    for (char c = 0; ::read(descriptor, &c, 1) == 1 && c != '\n';) number += c;
    if (number.empty()) throw std::runtime_error("Xvfb did not start");
    return ":" + number;
}

/// A file for the board of a program that is started; of an earlier one's it is another.
fs::path fresh_board(const TemporaryFolder& folder) {
    int number = 0;
    fs::path file;
    do file = folder / (".seen-" + std::to_string(++number));
    while (fs::exists(file));
    return file;
}

std::vector<std::string> with_board(std::vector<std::string> environment, const fs::path& board) {
    environment.push_back(std::string(SeenBoard::kVariable) + '=' + board.string());
    return environment;
}

std::shared_ptr<DisplayServer> shared_server() {
    static const auto server = std::make_shared<DisplayServer>();
    return server;
}

Vec3 vector_at(sqlite3_stmt* row, int column) {
    return {sqlite3_column_double(row, column), sqlite3_column_double(row, column + 1),
            sqlite3_column_double(row, column + 2)};
}

}  // namespace

Process::Process(std::vector<std::string> arguments, const std::vector<std::string>& environment,
                 const fs::path& error_file, int inherited_descriptor)
    : child_(::fork()) {
    if (child_ == 0) become(arguments, environment, error_file, inherited_descriptor);
}

Process::~Process() {
    if (child_ <= 0) return;
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
}

int Process::wait() {
    const bool ended = eventually([this] { return has_ended(); });
    if (!ended) send(SIGKILL);
    int status = 0;
    ::waitpid(child_, &status, 0);
    child_ = -1;
    if (!ended) FAIL("the program did not end within two minutes");
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool Process::has_ended() const {
    siginfo_t news{};
    REQUIRE(::waitid(P_PID, static_cast<id_t>(child_), &news, WEXITED | WNOHANG | WNOWAIT) == 0);
    return news.si_pid != 0;
}

void Process::interrupt() {
    send(SIGINT);
}

void Process::send(int signal) const {
    ::kill(child_, signal);
}

void Process::signal_program(int number) const {
    const std::string process = std::to_string(child_);
    std::ifstream children("/proc/" + process + "/task/" + process + "/children");
    pid_t program = 0;
    REQUIRE(children >> program);
    REQUIRE(::kill(program, number) == 0);
}

std::size_t Process::resident_bytes() const {
    std::ifstream pages("/proc/" + std::to_string(child_) + "/statm");  // all, resident, ...
    std::size_t all = 0;
    std::size_t resident = 0;
    pages >> all >> resident;
    return resident * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

WindowProgram::WindowProgram(std::vector<std::string> arguments,
                             std::vector<std::string> environment, const TemporaryFolder& folder,
                             std::shared_ptr<Seat> seat)
    : WindowProgram(std::move(arguments), std::move(environment), folder / "errors.txt",
                    fresh_board(folder), std::move(seat)) {}

WindowProgram::WindowProgram(std::vector<std::string> arguments,
                             std::vector<std::string> environment, const fs::path& error_file,
                             const fs::path& board, std::shared_ptr<Seat> seat)
    : Process(std::move(arguments), with_board(std::move(environment), board), error_file),
      seat_(std::move(seat)),
      board_(std::make_unique<MappedBoard>(board)) {}

void WindowProgram::wait_until(const std::function<bool(const Seen&)>& is_so) const {
    const bool came = eventually([&] { return is_so(seen()) || has_ended(); });
    const Seen last = seen();
    if (is_so(last)) return;
    FAIL((came ? "the program has ended" : "no turn shows it") << "; the last one: " << last);
}

void WindowProgram::hang() const {
    (*board_)->hangs = true;
    REQUIRE(eventually([this] { return (*board_)->is_hanging.load(); }));
}

void WindowProgram::go_on() const {
    (*board_)->hangs = false;
}

void WindowProgram::wait_for_turn() const {
    // The one that runs may have looked for events already.
    const std::uint64_t wanted = seen().turn + 2;
    wait_until([wanted](const Seen& now) { return now.turn >= wanted; });
}

void WindowProgram::wait_for_surface() const {
    wait_until([](const Seen& now) { return now.surface && now.touchable; });
}

void WindowProgram::act(const std::string& events) const {
    seat_->act(events, [this] { wait_for_turn(); });
}

DisplayServer::DisplayServer()
    : numbers_(open_pipe()),
      process_(server_arguments(numbers_[1]), {}, folder_ / "server.txt", numbers_[1]) {
    ::close(numbers_[1]);
    name_ = display_from(numbers_[0]);
    ::close(numbers_[0]);
    seat_ = std::make_shared<Seat>(name_);
}

Desk::Desk() : Desk(shared_server()) {}

Desk::Desk(std::shared_ptr<DisplayServer> server) : server_(std::move(server)) {
    server_->seat()->let_go();
}

WindowProgram Desk::start_viewer(const TemporaryFolder& folder,
                                 const std::vector<std::string>& arguments,
                                 const std::vector<std::string>& host) const {
    std::vector<std::string> words{"view"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return start(folder, words, host);
}

WindowProgram Desk::start(const TemporaryFolder& folder,
                          const std::vector<std::string>& program_words,
                          const std::vector<std::string>& host) const {
    fs::create_directories(folder / kState / "dibhr");
    write_text(folder / kState / "dibhr" / "led", "");
    std::vector<std::string> words{"env", "-C", folder.path().string()};
    words.insert(words.end(), host.begin(), host.end());
    words.emplace_back(WATCHED_PROGRAM);
    words.insert(words.end(), program_words.begin(), program_words.end());
    return WindowProgram(
        words,
        {"DISPLAY=" + server_->name(), "WAYLAND_DISPLAY=", "LIBGL_ALWAYS_SOFTWARE=1",
         "SDL_AUDIODRIVER=dummy",
         "DBUS_SESSION_BUS_ADDRESS=disabled:", "XDG_CONFIG_HOME=" + (folder / "config").string(),
         "XDG_DATA_HOME=" + (folder / "data").string(),
         "XDG_STATE_HOME=" + (folder / kState).string()},
        folder, server_->seat());
}

std::vector<Row> read_session(const fs::path& file) {
    sqlite3* opened = nullptr;
    REQUIRE(sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READONLY, nullptr) == SQLITE_OK);
    const std::unique_ptr<sqlite3, int (*)(sqlite3*)> database(opened, sqlite3_close);
    sqlite3_stmt* prepared = nullptr;
    REQUIRE(sqlite3_prepare_v2(
                opened,
                "SELECT t, gx, gy, gz, px, py, pz, fx, fy, fz, cx, cy, cz, contact, buttons, cut, "
                "video_s, surface, ready, stand_in, lets_go, "
                "p.to_frame - p.from_frame < 2 AND abs(p.to_s - p.from_s - p.span_s) < 1e-9, "
                "s.stiffness_newton_per_mm FROM tick LEFT JOIN pair p ON p.id = pair "
                "LEFT JOIN parameters s ON s.version = settings ORDER BY tick",
                -1, &prepared, nullptr) == SQLITE_OK);
    const std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> query(prepared, sqlite3_finalize);
    std::vector<Row> rows;
    while (sqlite3_step(prepared) == SQLITE_ROW) {
        rows.push_back(
            {sqlite3_column_double(prepared, 0), vector_at(prepared, 1), vector_at(prepared, 4),
             vector_at(prepared, 7), vector_at(prepared, 10), sqlite3_column_int(prepared, 13) != 0,
             (sqlite3_column_int(prepared, 14) & 1) != 0, sqlite3_column_int(prepared, 15),
             sqlite3_column_double(prepared, 16), sqlite3_column_int(prepared, 17) != 0,
             sqlite3_column_int(prepared, 18) != 0, sqlite3_column_int(prepared, 19) != 0,
             sqlite3_column_int(prepared, 20) != 0, sqlite3_column_int(prepared, 21) != 0,
             sqlite3_column_double(prepared, 22)});
    }
    return rows;
}

std::vector<double> held_moments(const std::vector<Row>& rows) {
    constexpr double kLong_s = 0.25;
    std::vector<double> held;
    double since_s = 0.0;
    double at_s = -1.0;
    bool told = false;
    for (const Row& row : rows) {
        if (!row.surface) continue;
        if (row.video_s < at_s || row.video_s > at_s) {
            at_s = row.video_s;
            since_s = row.t_s;
            told = false;
        } else if (!told && row.t_s - since_s > kLong_s) {
            held.push_back(at_s);
            told = true;
        }
    }
    return held;
}

void act_in_one_picture(const Desk& desk, const WindowProgram& viewer, const std::string& events,
                        int times) {
    viewer.wait_for_turn();
    viewer.hang();
    for (int k = 0; k < times; ++k) {
        if (k > 0) std::this_thread::sleep_for(std::chrono::milliseconds(40));
        desk.press(events);
    }
    viewer.go_on();
}

void run_shell(const std::string& command) {
    INFO(command);
    REQUIRE(std::system(command.c_str()) == 0);
}

void require_same_bits(const TemporaryFolder& folder, const fs::path& session) {
    const fs::path told = folder / "replay.txt";
    const auto replay = [&](const std::string& options) {
        run_shell("'" DIBHR_PROGRAM "' replay '" + session.string() + "' " + options + " > '" +
                  told.string() + "'");
        return read_text(told);
    };
    REQUIRE(contains(replay(""), "identical, bit for bit"));
    const std::vector<Row> rows = read_session(session);
    const auto touches = [](const Row& row) { return row.contact; };
    if (std::none_of(rows.begin(), rows.end(), touches)) return;  // it may hold no surface
    // As if its video were deleted.
    REQUIRE(contains(replay("--surface-from session"), "identical, bit for bit"));
    const std::string all = replay(
        "--surface-from session --algorithm dibhr --algorithm pga --algorithm neighborhood "
        "--algorithm god-object");
    INFO(all);
    int algorithms = 0;
    std::istringstream lines(all);
    for (std::string line; std::getline(lines, line);) {
        if (!contains(line, " left the surface that the session holds")) continue;
        ++algorithms;
        const auto share = line.find('(');
        CHECK((share == std::string::npos || std::stod(line.substr(share + 1)) <= 0.5));  // %
    }
    CHECK(algorithms >= 4);
}

}  // namespace dibhr::test
