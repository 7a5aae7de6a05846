// Cleans depth images on threads of its own.
#include "core/replay/cleaning_workers.hpp"

#include <exception>
#include <utility>

namespace dibhr {

CleaningWorkers::CleaningWorkers() {
    for (std::thread& thread : threads_) thread = std::thread([this] { run(); });
}

CleaningWorkers::~CleaningWorkers() {
    {
        const std::lock_guard lock(mutex_);
        leaving_ = true;
    }
    asked_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

std::shared_future<std::shared_ptr<const DepthImage>> CleaningWorkers::clean(
    DepthImage depth, const CleaningOptions& options) {
    Job job{std::move(depth), options, {}};
    auto cleaned = job.done.get_future().share();
    {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(job));
    }
    asked_.notify_one();
    return cleaned;
}

void CleaningWorkers::run() {
    DepthCleaner cleaner;  // with the scratch memory it gathers
    std::unique_lock lock(mutex_);
    while (true) {
        asked_.wait(lock, [this] { return leaving_ || !waiting_.empty(); });
        if (leaving_) return;
        Job job = std::move(waiting_.front());
        waiting_.pop_front();
        lock.unlock();
        try {
            if (job.options.any()) cleaner.clean(job.depth, job.options);
            job.done.set_value(std::make_shared<const DepthImage>(std::move(job.depth)));
        } catch (...) {
            job.done.set_exception(std::current_exception());
        }
        lock.lock();
    }
}

}  // namespace dibhr
