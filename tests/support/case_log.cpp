// Logs how each case ended, one line a case, for the sums and the slowest cases of tests/run.
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <sstream>
#include <string>

#include "tests/support/catch_listener.hpp"

namespace dibhr::test {

namespace {

/// Appends to the file that DIBHR_CASE_LOG names, each line with one write: several programs share
/// it. Seconds are real time, whatever clock a test simulates.
class CaseLog : public Listener {
  public:
    using Listener::Listener;

    void testCaseStarting(const Catch::TestCaseInfo& /*info*/) override { begin_s_ = now_s(); }

    void testCaseEnded(const Catch::TestCaseStats& stats) override {
        const char* const file = std::getenv("DIBHR_CASE_LOG");
        if (file == nullptr) return;
        const auto& assertions = stats.totals.assertions;
        std::ostringstream line;
        line << (stats.totals.testCases.failed > 0 ? "failed" : "passed") << '\t'
             << now_s() - begin_s_ << '\t' << assertions.total() << '\t'
             << program_invocation_short_name << '\t' << name_of(stats) << '\n';
        const int log = ::open(file, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
        if (log < 0) return;
        const std::string text = line.str();
        static_cast<void>(::write(log, text.data(), text.size()));
        ::close(log);
    }

  private:
    static double now_s() {
        return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
            .count();
    }

    double begin_s_{0.0};
};

CATCH_REGISTER_LISTENER(CaseLog)

}  // namespace

}  // namespace dibhr::test
