// Moves the hand by keys.
#include "app/viewer/key_hand.hpp"

#include <algorithm>
#include <utility>

#include "app/settings/keys.hpp"

namespace dibhr {

namespace {

constexpr double kWidthsPerSecond = 0.22;  // of the relief
constexpr double kSlowly = 0.2;
constexpr double kStep_px = 3.0;  // at once, of a key that is only tapped
constexpr double kLongestTurn_s = 0.1;
constexpr std::chrono::milliseconds kShortestTap{80};
constexpr double kTurn_rad = 0.06;
constexpr double kPan_px = 24.0;

/// (right, down) of an arrow key; nothing: another key.
std::optional<glm::dvec2> way_of(HandKey key) {
    switch (key) {
        case HandKey::left:
            return glm::dvec2{-1.0, 0.0};
        case HandKey::right:
            return glm::dvec2{1.0, 0.0};
        case HandKey::up:
            return glm::dvec2{0.0, -1.0};
        case HandKey::down:
            return glm::dvec2{0.0, 1.0};
        default:
            return std::nullopt;
    }
}

}  // namespace

HandKeys HandKeys::of(const Window& window) {
    const auto held = [&window](HandKey key) { return window.holds(code_of(key)) ? 1 : 0; };
    HandKeys keys{.press = window.holds(code_of(HandKey::press)), .slowly = window.pointer().shift};
    if (window.holds_control()) return keys;  // the arrows turn the view
    keys.right = held(HandKey::right) - held(HandKey::left);
    keys.down = held(HandKey::down) - held(HandKey::up);
    return keys;
}

void KeyHand::begin(glm::dvec2 place_px, glm::ivec2 viewport) {
    const glm::dvec2 size(viewport);
    const bool over =
        place_px.x >= 0.0 && place_px.y >= 0.0 && place_px.x < size.x && place_px.y < size.y;
    place_px_ = over ? place_px : 0.5 * size;
    followed_ = {};
}

void KeyHand::end() {
    *this = {};
}

bool KeyHand::take(const KeyPress& press, glm::ivec2 viewport, Camera& camera) {
    const auto key = on() ? hand_key(press.key) : std::nullopt;
    if (!key) return false;
    if (const auto way = way_of(*key)) {
        if (press.control && press.shift) {
            camera.pan(-kPan_px * way->x, kPan_px * way->y, viewport.y);
        } else if (press.control) {
            camera.orbit(kTurn_rad * way->x, kTurn_rad * way->y);
        } else if (!press.repeated) {
            move(kStep_px * (press.shift ? kSlowly : 1.0) * *way, viewport);
        }
        return true;
    }
    if (press.control) return false;
    if (*key == HandKey::nearer || *key == HandKey::farther) {
        wheel_steps_ += *key == HandKey::nearer ? 1.0 : -1.0;
    } else if (!press.repeated && *key == HandKey::press) {
        tapped_ = true;
    } else if (!press.repeated) {
        keeps_pressing_ = !keeps_pressing_;
    }
    return true;
}

Pointer KeyHand::follow(const HandKeys& keys, Time now, glm::ivec2 viewport) {
    const double passed_s =
        followed_ == Time{} ? 0.0 : std::chrono::duration<double>(now - followed_).count();
    followed_ = now;
    if (std::exchange(tapped_, false)) pressed_until_ = now + kShortestTap;
    const double speed = kWidthsPerSecond * viewport.x * (keys.slowly ? kSlowly : 1.0);  // [px/s]
    move(std::clamp(passed_s, 0.0, kLongestTurn_s) * speed * glm::dvec2{keys.right, keys.down},
         viewport);
    return {.position_px = *place_px_,
            .left = keys.press || keeps_pressing_ || now < pressed_until_};
}

double KeyHand::take_wheel() {
    return std::exchange(wheel_steps_, 0.0);
}

void KeyHand::move(glm::dvec2 by_px, glm::ivec2 viewport) {
    *place_px_ = glm::clamp(*place_px_ + by_px, glm::dvec2(0.0), glm::dvec2(viewport) - 1.0);
}

}  // namespace dibhr
