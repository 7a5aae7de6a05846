// No test reads or changes what a person keeps: settings, data and state lie in a folder of the
// run.
#include <cstdlib>
#include <optional>

#include "tests/support/catch_listener.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::test {

namespace {

/// Not caches: the display's drivers keep theirs where they would, and are quicker with them.
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
