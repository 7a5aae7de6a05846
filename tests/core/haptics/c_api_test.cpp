// dibhr.h, as a program in C uses it.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "core/haptics/dibhr.h"
#include "core/haptics/parameters.hpp"
#include "core/haptics/touch.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/allocations.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/comma_locale.hpp"

namespace {

using dibhr::Vec3;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A handle that is destroyed with its scope.
struct Handle {
    dibhr_handle* c{dibhr_create()};
    Handle() = default;
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() { dibhr_destroy(c); }

    [[nodiscard]] std::string error() const { return dibhr_last_error(c); }
};

template <typename Level>
dibhr_image image_of(const std::vector<Level>& levels, int columns, dibhr_level_type type) {
    return {levels.data(), type, columns, static_cast<int>(levels.size()) / columns, 0, 0.0};
}

dibhr_image image_of(const dibhr::DepthImage& depth) {
    return {depth.levels.data(), DIBHR_LEVELS_FLOAT, depth.columns, depth.rows, 0,
            depth.highest_level};
}

Vec3 vec(const double (&v)[3]) {
    return {v[0], v[1], v[2]};
}

}  // namespace

TEST_CASE("in C the same goals give the same bits as in C++, with every algorithm", "[c_api]") {
    const auto surfaces = dibhr::test::hostile_surfaces(40, 30);
    const dibhr::BumpMap bump{2, 2, {0.0F, 1.0F, 1.0F, 0.0F}};
    const dibhr_image c_bump{bump.heights.data(), DIBHR_LEVELS_FLOAT, 2, 2, 0, 1.0};
    for (const auto& named : surfaces) {
        CAPTURE(named.name);
        Handle hand;
        const dibhr_image image = image_of(named.image);
        REQUIRE(dibhr_set_depth(hand.c, &image, nullptr) == DIBHR_OK);
        REQUIRE(dibhr_set_bump(hand.c, &c_bump) == DIBHR_OK);
        REQUIRE(dibhr_set(hand.c, "roughness", 3.0) == DIBHR_OK);
        REQUIRE(dibhr_set(hand.c, "dynamic-friction", 0.2) == DIBHR_OK);
        REQUIRE(dibhr_set(hand.c, "damping", 5.0) == DIBHR_OK);
        dibhr::TouchRenderer renderer;
        dibhr::TouchParameters parameters;
        parameters.shape.roughness_px = 3.0;
        parameters.friction.dynamic_coefficient = 0.2;
        parameters.coupling.damping_newton_s_per_m = 5.0;
        const dibhr::DepthSurface surface(named.image, named.image, 0.0, parameters.shape, &bump);
        dibhr::test::Dice dice(7);
        for (int k = 0; k < 800; ++k) {
            const std::size_t which = static_cast<std::size_t>(k) / 200;
            REQUIRE(dibhr_set_algorithm(hand.c, dibhr_algorithm_at(which)) == DIBHR_OK);
            parameters.algorithm = dibhr::all_algorithms()[which];
            const Vec3 goal(dice.uniform(-5.0, 45.0), dice.uniform(-5.0, 35.0),
                            dice.uniform(0.0, 200.0));
            const dibhr::Touch& touch = renderer.update(surface, goal, parameters, {}, {});
            dibhr_touch c{};
            REQUIRE(dibhr_update(hand.c, goal.x, goal.y, goal.z, 0.001, &c) == DIBHR_OK);
            REQUIRE(vec(c.goal) == goal);
            REQUIRE(vec(c.proxy) == touch.proxy.position);
            REQUIRE(vec(c.spring_force) == touch.spring_force_newton);
            REQUIRE(vec(c.sent_force) == touch.sent_force_newton);
            REQUIRE(c.contact == (touch.proxy.contact ? 1 : 0));
            REQUIRE(c.slipping == (touch.proxy.slipping ? 1 : 0));
            REQUIRE(std::string(dibhr_primitive_name(c.primitive)) ==
                    name_of(touch.proxy.active.kind));
            REQUIRE((c.i == touch.proxy.active.i && c.j == touch.proxy.active.j));
            REQUIRE(c.moves == touch.proxy.moves);
            REQUIRE(c.bound_met == (touch.proxy.bound_met ? 1 : 0));
            REQUIRE(std::string(c.cut) == name_of(touch.cut));
        }
    }
}

TEST_CASE("a bump map is the same whatever it was set before, and over images of any size",
          "[c_api]") {
    const dibhr::BumpMap bump{3, 2, {0.0F, 1.0F, 0.5F, 0.25F, 0.75F, 0.1F}};
    const dibhr_image c_bump{bump.heights.data(), DIBHR_LEVELS_FLOAT, 3, 2, 0, 1.0};
    Handle hand;
    REQUIRE(dibhr_set_bump(hand.c, &c_bump) == DIBHR_OK);
    REQUIRE(dibhr_set(hand.c, "roughness", 3.0) == DIBHR_OK);
    for (const auto& [columns, rows] : {std::pair{20, 30}, {30, 20}}) {
        const dibhr::DepthImage depth = dibhr::test::flat(columns, rows, 50.0);
        const dibhr_image image = image_of(depth);
        REQUIRE(dibhr_set_depth(hand.c, &image, nullptr) == DIBHR_OK);
        const dibhr::DepthSurface surface(depth, depth, 0.0, {255.0, 3.0}, &bump);
        double z = 0.0;
        REQUIRE(dibhr_elevation(hand.c, 7.0, 11.0, &z) == DIBHR_OK);
        CHECK(z == surface.elevation_at(7.0, 11.0));
    }
}

TEST_CASE("8 bits, 16 bits and floats of the same depth are the same surface, padded rows too",
          "[c_api]") {
    const std::vector<std::uint8_t> bytes{0, 51, 255, 102, 0, 51};
    const std::vector<std::uint16_t> words{0, 51 * 257, 65535, 102 * 257, 0, 51 * 257};
    const std::vector<float> floats{0.0F, 0.2F, 1.0F, 0.4F, 0.0F, 0.2F};
    const std::vector<std::uint8_t> padded{0, 51, 255, 99, 99, 102, 0, 51, 99, 99};
    std::vector<std::uint8_t> odd(1 + words.size() * 2);  // words at an odd address
    std::memcpy(odd.data() + 1, words.data(), odd.size() - 1);
    const std::array images{image_of(bytes, 3, DIBHR_LEVELS_8_BIT),
                            dibhr_image{odd.data() + 1, DIBHR_LEVELS_16_BIT, 3, 2, 0, 0.0},
                            image_of(words, 3, DIBHR_LEVELS_16_BIT),
                            image_of(floats, 3, DIBHR_LEVELS_FLOAT),
                            dibhr_image{padded.data(), DIBHR_LEVELS_8_BIT, 3, 2, 5, 0.0}};
    const dibhr_image& image = images[GENERATE(0U, 1U, 2U, 3U, 4U)];
    Handle hand;
    REQUIRE(dibhr_set_depth(hand.c, &image, nullptr) == DIBHR_OK);
    double z = 0.0;
    const std::array<double, 6> expected{0.0, 51.0, 255.0, 102.0, 0.0, 51.0};
    for (int k = 0; k < 6; ++k) {
        REQUIRE(dibhr_elevation(hand.c, k % 3, k / 3, &z) == DIBHR_OK);
        CHECK(std::abs(z - expected[static_cast<std::size_t>(k)]) < 1e-5);
    }
}

TEST_CASE("a video's frames follow each other: blended, pushed on, and the proxy keeps contact",
          "[c_api]") {
    const std::vector<std::uint8_t> low(12, 100);
    const std::vector<std::uint8_t> high(12, 120);
    const dibhr_image first = image_of(low, 4, DIBHR_LEVELS_8_BIT);
    const dibhr_image second = image_of(high, 4, DIBHR_LEVELS_8_BIT);
    Handle hand;
    double z = 0.0;
    CHECK(dibhr_elevation(hand.c, 1.0, 1.0, &z) == DIBHR_NO_SURFACE);
    CHECK(dibhr_update(hand.c, 1.0, 1.0, 1.0, 0.001, nullptr) == DIBHR_NO_SURFACE);
    CHECK(dibhr_push_depth(hand.c, &second) == DIBHR_NO_SURFACE);
    REQUIRE(dibhr_set_depth(hand.c, &first, &second) == DIBHR_OK);
    dibhr_touch touch{};
    for (const double blend : {0.0, 0.25, 1.0}) {
        REQUIRE(dibhr_set_blend(hand.c, blend) == DIBHR_OK);
        REQUIRE(dibhr_update(hand.c, 1.0, 1.0, 90.0, 0.001, &touch) == DIBHR_OK);
        CHECK(touch.contact == 1);
        CHECK(touch.proxy[2] == 100.0 + 20.0 * blend);
    }
    REQUIRE(dibhr_push_depth(hand.c, &first) == DIBHR_OK);
    REQUIRE(dibhr_update(hand.c, 1.0, 1.0, 90.0, 0.001, &touch) == DIBHR_OK);
    CHECK(touch.proxy[2] == 120.0);
    REQUIRE(dibhr_set_blend(hand.c, 1.0) == DIBHR_OK);
    REQUIRE(dibhr_update(hand.c, 1.0, 1.0, 90.0, 0.001, &touch) == DIBHR_OK);
    CHECK(touch.proxy[2] == 100.0);
    CHECK(touch.contact == 1);
}

TEST_CASE("every parameter of the table is set, read and kept in its range by its name",
          "[c_api]") {
    Handle hand;
    CHECK(dibhr_parameter_count() == dibhr::plain_numbers().size());
    dibhr_parameter entry{};
    for (std::size_t k = 0; k < dibhr_parameter_count(); ++k) {
        REQUIRE(dibhr_parameter_at(k, &entry) == DIBHR_OK);
        CAPTURE(entry.name);
        CHECK(entry.name == dibhr::plain_numbers()[k].name);
        CHECK(entry.help == dibhr::plain_numbers()[k].help);
        double value = kNan;
        REQUIRE(dibhr_get(hand.c, entry.name, &value) == DIBHR_OK);
        CHECK(value == entry.initial);
        REQUIRE(dibhr_set(hand.c, entry.name, entry.highest) == DIBHR_OK);
        for (const double wrong : {entry.highest * 1.01, entry.lowest - 1.0, kNan}) {
            CHECK(dibhr_set(hand.c, entry.name, wrong) == DIBHR_OUT_OF_RANGE);
            CHECK(hand.error().find(entry.name) != std::string::npos);
        }
        REQUIRE(dibhr_get(hand.c, entry.name, &value) == DIBHR_OK);
        CHECK(value == entry.highest);
    }
    CHECK(dibhr_parameter_at(dibhr_parameter_count(), &entry) == DIBHR_BAD_ARGUMENT);
    for (const dibhr::TouchNumber& number : dibhr::touch_numbers()) {
        CAPTURE(number.name);
        CHECK(dibhr_set(hand.c, number.name.data(), number.lowest) == DIBHR_OK);
    }
    for (const dibhr::TouchSwitch& known : dibhr::touch_switches()) {
        CAPTURE(known.name);
        // There is no motion that it could follow.
        const dibhr_status wanted = known.needs_motion ? DIBHR_UNKNOWN_NAME : DIBHR_OK;
        CHECK(dibhr_set(hand.c, known.name.data(), 1.0) == wanted);
    }
    CHECK(dibhr_set(hand.c, "stifness", 1.0) == DIBHR_UNKNOWN_NAME);
    CHECK(hand.error() == "no parameter is called \"stifness\"");
    CHECK(dibhr_set_algorithm(hand.c, "rbf") == DIBHR_UNKNOWN_NAME);
    CHECK(std::string(dibhr_algorithm(hand.c)) == "dibhr");
    CHECK(dibhr_algorithm_at(dibhr::all_algorithms().size()) == nullptr);
}

TEST_CASE("what is wrong is said with decimal points in a host with a decimal comma", "[c_api]") {
    const dibhr::test::CommaLocale locale;
    Handle hand;
    CHECK(dibhr_set_blend(hand.c, 1.5) == DIBHR_BAD_ARGUMENT);
    CHECK(hand.error() == "a blend of 1.5: it must be from 0 to 1");
    CHECK(dibhr_set_blend(hand.c, -1e300 / 7.0) == DIBHR_BAD_ARGUMENT);
    CHECK(hand.error() == "a blend of -1.42857e+299: it must be from 0 to 1");
    CHECK(dibhr_set(hand.c, "static-friction", kNan) == DIBHR_OUT_OF_RANGE);
    CHECK(hand.error().find("nan") != std::string::npos);
}

TEST_CASE("a bad image is refused with a reason and the surface stays as it was", "[c_api]") {
    const std::vector<std::uint8_t> bytes(9, 77);
    std::vector<float> floats(9, 0.5F);
    const dibhr_image good = image_of(bytes, 3, DIBHR_LEVELS_8_BIT);
    Handle hand;
    REQUIRE(dibhr_set_depth(hand.c, &good, nullptr) == DIBHR_OK);
    dibhr_image bad = good;
    const auto is_refused = [&](const std::string& reason) {
        CHECK(dibhr_set_depth(hand.c, &bad, nullptr) == DIBHR_BAD_ARGUMENT);
        CHECK(hand.error().find(reason) != std::string::npos);
        CHECK(dibhr_set_depth(hand.c, &good, &bad) == DIBHR_BAD_ARGUMENT);
        CHECK(dibhr_push_depth(hand.c, &bad) == DIBHR_BAD_ARGUMENT);
        double z = 0.0;
        REQUIRE(dibhr_elevation(hand.c, 1.5, 1.5, &z) == DIBHR_OK);
        CHECK(z == 77.0);
    };
    SECTION("no levels") {
        bad.levels = nullptr;
        is_refused("NULL");
    }
    SECTION("too small") {
        bad.rows = 1;
        is_refused("at least 2 x 2");
    }
    SECTION("a negative size") {
        bad.columns = -3;
        is_refused("at least 2 x 2");
    }
    SECTION("rows that overlap") {
        bad.row_bytes = 2;
        is_refused("rows of 2 bytes");
    }
    SECTION("a level above the highest") {
        bad.highest_level = 76.0;
        is_refused("not in 0 to 76");
    }
    SECTION("a level that is no number") {
        floats[4] = std::numeric_limits<float>::quiet_NaN();
        bad = image_of(floats, 3, DIBHR_LEVELS_FLOAT);
        is_refused("not in 0 to 1");
    }
    SECTION("a highest level of nothing, or less than a float can say") {
        bad.highest_level = GENERATE(-1.0, 1e-300, 1e300);
        is_refused("highest level");
    }
    SECTION("a type that there is not") {
        bad.type = 7;
        is_refused("type");
    }
}

TEST_CASE("two depth images of different sizes are refused", "[c_api]") {
    const std::vector<std::uint8_t> bytes(12, 77);
    const dibhr_image wide = image_of(bytes, 4, DIBHR_LEVELS_8_BIT);
    const dibhr_image tall = image_of(bytes, 3, DIBHR_LEVELS_8_BIT);
    Handle hand;
    CHECK(dibhr_set_depth(hand.c, &wide, &tall) == DIBHR_BAD_ARGUMENT);
    REQUIRE(dibhr_set_depth(hand.c, &wide, nullptr) == DIBHR_OK);
    CHECK(dibhr_push_depth(hand.c, &tall) == DIBHR_BAD_ARGUMENT);
    CHECK(hand.error().find("same size") != std::string::npos);
}

TEST_CASE("a goal that is no number gives no force, and a NULL handle is a status, not a crash",
          "[c_api]") {
    const std::vector<std::uint8_t> bytes(9, 100);
    const dibhr_image image = image_of(bytes, 3, DIBHR_LEVELS_8_BIT);
    Handle hand;
    REQUIRE(dibhr_set_depth(hand.c, &image, nullptr) == DIBHR_OK);
    dibhr_touch touch{};
    REQUIRE(dibhr_read(hand.c, &touch) == DIBHR_OK);
    CHECK((touch.contact == 0 && touch.primitive == DIBHR_NO_PRIMITIVE && touch.i == -1));
    for (int k = 0; k < 50; ++k) dibhr_update(hand.c, 1.0, 1.0, 90.0, 0.001, &touch);
    CHECK(touch.sent_force[2] > 0.0);
    CHECK(dibhr_update(hand.c, kNan, 1.0, 90.0, 0.001, &touch) == DIBHR_BAD_ARGUMENT);
    CHECK(vec(touch.sent_force) == Vec3(0.0));
    CHECK(vec(touch.spring_force) == Vec3(0.0));
    CHECK(touch.proxy[2] == 100.0);
    REQUIRE(dibhr_enable_force(hand.c, 0) == DIBHR_OK);
    REQUIRE(dibhr_update(hand.c, 1.0, 1.0, 90.0, 0.001, &touch) == DIBHR_OK);
    CHECK(vec(touch.sent_force) == Vec3(0.0));
    CHECK(std::string(touch.cut) == "force off");
    REQUIRE(dibhr_reset(hand.c) == DIBHR_OK);
    REQUIRE(dibhr_update(hand.c, 1.0, 1.0, 110.0, 0.001, &touch) == DIBHR_OK);
    CHECK(touch.contact == 0);

    double number = 0.0;
    dibhr_safety safety{};
    for (const dibhr_status status :
         {dibhr_set_depth(nullptr, &image, nullptr), dibhr_push_depth(nullptr, &image),
          dibhr_set_blend(nullptr, 0.5), dibhr_set_bump(nullptr, nullptr),
          dibhr_elevation(nullptr, 0.0, 0.0, &number), dibhr_set(nullptr, "relief", 1.0),
          dibhr_get(nullptr, "relief", &number), dibhr_set_algorithm(nullptr, "pga"),
          dibhr_get_safety(nullptr, &safety), dibhr_set_safety(nullptr, &safety),
          dibhr_enable_force(nullptr, 1), dibhr_update(nullptr, 0.0, 0.0, 0.0, 0.001, &touch),
          dibhr_read(nullptr, &touch), dibhr_reset(nullptr)}) {
        CHECK(status == DIBHR_BAD_ARGUMENT);
    }
    CHECK(std::string(dibhr_last_error(nullptr)) == "the handle is NULL");
    dibhr_destroy(nullptr);
}

TEST_CASE("the safety limits of C hold, and one that is no number is refused", "[c_api]") {
    const std::vector<std::uint8_t> bytes(9, 100);
    const dibhr_image image = image_of(bytes, 3, DIBHR_LEVELS_8_BIT);
    Handle hand;
    REQUIRE(dibhr_set_depth(hand.c, &image, nullptr) == DIBHR_OK);
    dibhr_safety safety{};
    REQUIRE(dibhr_get_safety(hand.c, &safety) == DIBHR_OK);
    CHECK(safety.max_force_newton == dibhr::SafetyLimits{}.max_force_newton);
    safety.max_force_newton = 0.75;
    safety.ramp_s = 0.0;
    REQUIRE(dibhr_set_safety(hand.c, &safety) == DIBHR_OK);
    safety.ramp_s = kNan;
    CHECK(dibhr_set_safety(hand.c, &safety) == DIBHR_BAD_ARGUMENT);
    dibhr_touch touch{};
    for (int k = 0; k < 50; ++k) {
        REQUIRE(dibhr_update(hand.c, 1.0, 1.0, 50.0, 0.001, &touch) == DIBHR_OK);
        CHECK(touch.sent_force[2] <= 0.75);
    }
    CHECK(touch.sent_force[2] == 0.75);
}

TEST_CASE("an update from C allocates nothing, a next frame of the same size neither", "[c_api]") {
    const auto image = dibhr::test::flat(30, 20, 90.0);
    const dibhr_image frame = image_of(image);
    Handle hand;
    REQUIRE(dibhr_set_depth(hand.c, &frame, &frame) == DIBHR_OK);
    REQUIRE(dibhr_push_depth(hand.c, &frame) == DIBHR_OK);
    dibhr_touch touch{};
    int failures = 0;
    const int allocations = dibhr::test::allocations_in([&] {
        for (std::size_t k = 0; k < 1000; ++k) {
            const double x = k % 97 == 0 ? kNan : 10.0 + 0.01 * static_cast<double>(k);
            failures += dibhr_update(hand.c, x, 9.0, 80.0, 0.001, &touch) == DIBHR_OK ? 0 : 1;
            if (k % 10 == 0) dibhr_push_depth(hand.c, &frame);
            if (k % 100 == 0) dibhr_set_algorithm(hand.c, dibhr_algorithm_at(k / 100 % 4));
            dibhr_set(hand.c, "no such thing", 1.0);
        }
    });
    CHECK(allocations == 0);
    CHECK(failures == 11);
    CHECK(touch.contact == 1);
}
