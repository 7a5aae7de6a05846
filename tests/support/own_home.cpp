// No test reads or changes the user's files: settings, data and state are in a folder of the run.
#include <cstdlib>
#include <optional>

#include "tests/support/catch_listener.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::test {

namespace {

/// Caches stay where they are: the display's drivers are faster with theirs.
class OwnHome : public Listener {
  public:
    using Listener::Listener;

    void testRunStarting(const Catch::TestRunInfo& /*run*/) override {
        folder_.emplace();
        for (const char* const name : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME"})
            ::setenv(name, (*folder_ / name).c_str(), 1);
    }
    void testRunEnded(const Catch::TestRunStats& /*run*/) override { folder_.reset(); }

  private:
    std::optional<TemporaryFolder> folder_{};
};

CATCH_REGISTER_LISTENER(OwnHome)

}  // namespace

}  // namespace dibhr::test
