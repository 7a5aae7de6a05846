// Lines of text over a unix socket: a question a line, an answer a line.
#pragma once

#include <functional>
#include <string>
#include <thread>

namespace dibhr::test::falcon {

/// Serves one caller after the other, on a thread of its own.
class LineServer {
  public:
    using Answer = std::function<std::string(const std::string&)>;

    /// Throws std::runtime_error when there can be no socket at `path`.
    LineServer(const std::string& path, Answer answer);
    ~LineServer();
    LineServer(const LineServer&) = delete;
    LineServer& operator=(const LineServer&) = delete;

  private:
    std::string path_;
    std::jthread thread_{};
};

/// The answer to one line; "error: ..." when there is none. Waits for the server to appear while
/// `patient` says so.
[[nodiscard]] std::string ask_line(const std::string& path, const std::string& line,
                                   const std::function<bool()>& patient);

}  // namespace dibhr::test::falcon
