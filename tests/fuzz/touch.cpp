// An update of the proxy and its force: any ground, goals, parameters and limits, one algorithm
// after another, over two frames that are blended and a bump map.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "core/haptics/touch.hpp"
#include "tests/core/haptics/bounds.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/fuzz/entry.hpp"

using namespace dibhr;

namespace {

/// The input as numbers; zeros after its end.
class Numbers {
  public:
    explicit Numbers(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    [[nodiscard]] bool empty() const { return bytes_.empty(); }
    int byte() {
        if (bytes_.empty()) return 0;
        const int value = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return value;
    }
    /// -16 .. 16 in steps of an eighth.
    double step() { return (byte() - 128) / 8.0; }
    double share() { return (256 * byte() + byte()) / 65535.0; }
    /// Any, also infinite or none.
    double any() {
        std::array<std::uint8_t, sizeof(double)> bits{};
        for (std::uint8_t& part : bits) part = static_cast<std::uint8_t>(byte());
        double value = 0.0;
        std::memcpy(&value, bits.data(), sizeof value);
        return value;
    }

  private:
    std::span<const std::uint8_t> bytes_;
};

/// A pattern of up to 16 levels, repeated along a slant; without one, random.
DepthImage image_from(Numbers& numbers, int columns, int rows, double highest) {
    std::vector<int> pattern(static_cast<std::size_t>(numbers.byte() % 17));
    for (int& level : pattern) level = numbers.byte();
    const int across = numbers.byte() % 8;
    const int down = numbers.byte() % 8;
    test::Dice dice(static_cast<std::uint64_t>(across + 8 * down));
    return image_of(columns, rows, highest, [&](int i, int j) {
        if (pattern.empty()) return std::floor(dice.uniform(0.0, highest + 1.0));
        const auto at = static_cast<std::size_t>(across * i + down * j) % pattern.size();
        return std::floor(pattern[at] / 255.0 * highest);
    });
}

struct Scene {
    DepthImage from{};
    DepthImage to{};
    BumpMap bump{};
    bool bumpy{false};
};

Scene scene_from(Numbers& numbers) {
    constexpr std::array<std::array<int, 2>, 8> kSizes{
        {{2, 2}, {2, 40}, {57, 2}, {3, 3}, {48, 37}, {64, 64}, {16, 9}, {320, 240}}};
    const int kind = numbers.byte();
    const auto [columns, rows] = kSizes[static_cast<std::size_t>(kind % 8)];
    const double highest = (kind & 8) != 0 ? 65535.0 : 255.0;
    Scene scene;
    scene.from = image_from(numbers, columns, rows, highest);
    scene.to = (kind & 16) != 0 ? image_from(numbers, columns, rows, highest) : scene.from;
    scene.bumpy = (kind & 32) != 0;
    scene.bump = {5, 4, std::vector<float>(20)};
    for (float& height : scene.bump.heights) height = static_cast<float>(numbers.byte()) / 255.0F;
    if ((kind & 64) != 0) stretch(scene.bump, columns, rows);
    return scene;
}

/// A hand, its parameters and its limits, changed a little before every update.
struct Hand {
    Vec3 goal{0.0};
    TouchParameters parameters{};
    SafetyInput input{};
    SafetyLimits limits{};
    double blend{0.0};
    bool releases_contact{false};

    void change(Numbers& numbers, const Scene& scene) {
        input.from_zero = false;
        releases_contact = false;
        switch (numbers.byte() % 12) {
            case 0:
                parameters.algorithm =
                    all_algorithms()[static_cast<std::size_t>(numbers.byte()) % 4];
                break;
            case 1:
                blend = numbers.share();
                break;
            case 2: {
                const auto table = touch_numbers();
                const TouchNumber& number =
                    table[static_cast<std::size_t>(numbers.byte()) % table.size()];
                number.in(parameters) =
                    number.lowest + numbers.share() * (number.highest - number.lowest);
                break;
            }
            case 3: {
                const auto table = touch_numbers();
                table[static_cast<std::size_t>(numbers.byte()) % table.size()].in(parameters) =
                    numbers.any();
                break;
            }
            case 4:
                input.dt_s = numbers.byte() % 2 == 0 ? 0.02 * numbers.share() : numbers.any();
                break;
            case 5: {
                const int state = numbers.byte();
                input.force_enabled = (state & 1) == 0;
                input.device_ready = (state & 2) == 0;
                input.from_zero = (state & 4) != 0;
                releases_contact = (state & 8) != 0;
                limits.stability = (state & 16) != 0;
                limits.watched = {.mass_kg = 2.0 * numbers.share(),
                                  .friction_newton_s_per_m = numbers.share(),
                                  .resolution_mm = 0.1 * numbers.share(),
                                  .delay_s = 0.005 * numbers.share()};
                break;
            }
            case 6:
                limits.max_force_newton = 8.0 * numbers.share();
                limits.ramp_s = numbers.share();
                break;
            case 7:
                input.device_force_newton = {numbers.any(), numbers.step(), numbers.step()};
                break;
            case 8:
                goal = {numbers.any(), numbers.any(), numbers.any()};
                break;
            case 9:
                goal = {numbers.share() * (scene.from.columns - 1),
                        numbers.share() * (scene.from.rows - 1),
                        1.1 * numbers.share() * parameters.shape.relief_px};
                break;
            default:  // a hand moves
                goal += Vec3(numbers.step(), numbers.step(), numbers.step());
        }
        keep_in_range(parameters);
    }
};

/// `begins`: the force does, from zero.
void require_safe(Vec3 before, Vec3 sent, const Hand& hand, bool begins) {
    const SafetyInput& input = hand.input;
    const SafetyLimits& limits = hand.limits;
    constexpr double kRoundOff = 1e-9;
    test::require_rule(is_finite(sent), "a force is finite");
    const double length = glm::length(sent);
    test::require_rule(length <= limits.max_force_newton + kRoundOff, "a force keeps its limit");
    const bool may_act = input.force_enabled && input.device_ready && input.dt_s > 0.0 &&
                         input.dt_s <= limits.max_tick_s && is_finite(hand.goal);
    test::require_rule(may_act || length == 0.0, "no force where none may act");
    const double most_newton =
        limits.max_change_newton_per_ms * std::min(1e3 * input.dt_s, 3.0) + kRoundOff;
    const bool cut_or_held = length == 0.0 || glm::length(before) > limits.max_force_newton;
    // After a cut of the video the force begins anew, too: without a ramp, not at zero.
    const bool has_ramp = limits.ramp_s > 0.0;
    double change = glm::length(sent - (begins ? Vec3(0.0) : before));
    if (!has_ramp) change = std::min(change, length);
    test::require_rule(cut_or_held || change <= most_newton,
                       "a force changes no faster than its limit");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Numbers numbers({data, size});
    const Scene scene = scene_from(numbers);
    Hand hand;
    hand.goal = {0.5 * scene.from.columns, 0.5 * scene.from.rows, 300.0};
    TouchRenderer renderer;
    test::BoundsWatch watch;
    Vec3 sent(0.0);
    Algorithm running = Algorithm::dibhr;
    for (int updates = 0; updates < 300 && !numbers.empty(); ++updates) {
        hand.change(numbers, scene);
        if (hand.releases_contact) {
            renderer.release_contact();
            watch.release_contact();
        }
        const DepthSurface surface(scene.from, scene.to, hand.blend, hand.parameters.shape,
                                   scene.bumpy ? &scene.bump : nullptr);
        const Touch& touch =
            renderer.update(surface, hand.goal, hand.parameters, hand.input, hand.limits);
        const bool refused = !is_finite(hand.goal);
        const bool another = !refused && hand.parameters.algorithm != running;
        if (!refused) running = hand.parameters.algorithm;
        require_safe(std::exchange(sent, touch.sent_force_newton), touch.sent_force_newton, hand,
                     hand.input.from_zero || another);
        if (refused) {
            hand.goal = touch.goal;  // refused: the last state stands
            continue;
        }
        const char* broken =
            watch.broken_by(surface, hand.parameters.algorithm, hand.goal, touch.proxy);
        test::require_rule(broken == nullptr, broken == nullptr ? "" : broken);
    }
    return 0;
}
