// Owns the driver's thread.
#include "device/openhaptics/driver.hpp"

#include <chrono>

#include "device/openhaptics/driver_thread.hpp"

namespace dibhr::openhaptics {

namespace {

constexpr std::chrono::milliseconds kLongestGoodbye{500};

}  // namespace

Driver::Driver(const ConnectionOptions& options, const std::shared_ptr<ArmBuffers>& buffers)
    : work_(std::make_shared<DriverThread>(options, buffers)),
      thread_([work = work_] { work->run(); }) {}

Driver::~Driver() {
    work_->request_stop();
    if (work_->ends_within(kLongestGoodbye)) {
        thread_.join();
    } else {
        thread_.detach();  // with its own share of the work
    }
}

Status Driver::status() const {
    return work_->status();
}

}  // namespace dibhr::openhaptics
