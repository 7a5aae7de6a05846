// A pool of large objects, reused once nothing holds them: fresh pages cost more time than writing
// the data.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace dibhr {

/// Objects may outlive the pool, and be released on any thread. Copies are the same pool.
template <typename Thing>
class ObjectPool {
  public:
    /// An object with the content that it was released with, or a new one.
    [[nodiscard]] std::shared_ptr<Thing> take() { return share(free_list_->take()); }
    /// The same as a value, which comes back to the pool once share() has taken it.
    [[nodiscard]] Thing take_out() { return std::move(*free_list_->take()); }
    [[nodiscard]] std::shared_ptr<Thing> share(Thing thing) {
        return share(std::make_unique<Thing>(std::move(thing)));
    }

  private:
    std::shared_ptr<Thing> share(std::unique_ptr<Thing> thing) {
        return {thing.release(), [free_list = free_list_](Thing* done) {
                    free_list->give(std::unique_ptr<Thing>(done));
                }};
    }

    static constexpr std::size_t kMost = 8;

    class FreeList {
      public:
        std::unique_ptr<Thing> take() {
            const std::lock_guard lock(guard_);
            if (things_.empty()) return std::make_unique<Thing>();
            std::unique_ptr<Thing> thing = std::move(things_.back());
            things_.pop_back();
            return thing;
        }
        void give(std::unique_ptr<Thing> thing) {
            const std::lock_guard lock(guard_);
            if (things_.size() < kMost) things_.push_back(std::move(thing));
        }

      private:
        std::mutex guard_{};
        std::vector<std::unique_ptr<Thing>> things_{};
    };

    std::shared_ptr<FreeList> free_list_{std::make_shared<FreeList>()};
};

}  // namespace dibhr
