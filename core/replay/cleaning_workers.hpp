// Cleans depth images on threads of its own, a few at a time.
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <thread>

#include "core/haptics/depth_image.hpp"
#include "core/video/depth_cleaning.hpp"

namespace dibhr {

/// However many images wait, so many threads are at work; in the order in which they were given.
class CleaningWorkers {
  public:
    static constexpr std::size_t kWorkers = 2;

    CleaningWorkers();
    ~CleaningWorkers();  ///< what is not begun is given up
    CleaningWorkers(const CleaningWorkers&) = delete;
    CleaningWorkers& operator=(const CleaningWorkers&) = delete;

    [[nodiscard]] std::shared_future<std::shared_ptr<const DepthImage>> clean(
        DepthImage depth, const CleaningOptions& options);

  private:
    struct Job {
        DepthImage depth{};
        CleaningOptions options{};
        std::promise<std::shared_ptr<const DepthImage>> done{};
    };

    void run();

    std::mutex mutex_{};
    std::condition_variable asked_{};
    std::deque<Job> waiting_{};  // under the mutex
    bool leaving_{false};        // under the mutex
    std::array<std::thread, kWorkers> threads_{};
};

}  // namespace dibhr
