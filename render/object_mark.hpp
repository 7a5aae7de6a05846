// Tells shared objects apart, without keeping them alive.
#pragma once

#include <memory>

namespace dibhr {

/// Identifies a shared object by its control block, which no other object gets while this exists.
/// Keeps no object alive: a frame may be tens of megabytes.
class ObjectMark {
  public:
    ObjectMark() = default;
    /// Null: equal to every other mark of no object.
    explicit ObjectMark(const std::shared_ptr<const void>& object) noexcept : object_(object) {}

    friend bool operator==(const ObjectMark& a, const ObjectMark& b) noexcept {
        return !a.object_.owner_before(b.object_) && !b.object_.owner_before(a.object_);
    }

  private:
    std::weak_ptr<const void> object_{};
};

}  // namespace dibhr
