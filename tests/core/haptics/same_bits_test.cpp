// Version 0.1's results, to the bit: an optimisation of the walk must not move the proxy.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "core/haptics/touch.hpp"
#include "tests/core/haptics/surfaces.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

namespace {

constexpr int kColumns = 360;
constexpr int kRows = 300;

/// A surface whose results in 0.1 were right everywhere on the path below.
struct Ground {
    const char* name;
    double highest_level;
    double (*level)(int i, int j);
    bool has_bump;
    /// Of all positions, friction 0 and 0.4; in the order of the algorithms.
    std::array<std::uint64_t, 4> fingerprints;
};

/// Anywhere in [0, 1), the same for the same place.
double dust(int i, int j) {
    const auto a = static_cast<std::uint32_t>(i) * 2654435761U;
    const auto b = static_cast<std::uint32_t>(j) * 2246822519U;
    std::uint32_t h = (a ^ (b >> 7) ^ (b << 11)) * 3266489917U;
    h = (h ^ (h >> 15)) * 668265263U;
    return static_cast<double>(h ^ (h >> 13)) / 4294967296.0;
}

double flat_level(int, int) {
    return 100.0;
}
double near_flat_level(int i, int j) {
    return 25700.0 + std::floor(3.0 * dust(i, j)) - 1.0;
}
double hilly_level(int i, int j) {
    const int a = (i % 60) - 30;
    const int b = (j % 48) - 24;
    return 25700.0 - 4.0 * (a * a + 2 * b * b) + 2.0 * a * b;
}
double terraced_level(int i, int j) {
    return std::floor((13.0 * i + 7.0 * j) / 100.0) + 60.0;
}
double rows_level(int, int j) {
    return 25700.0 + j % 2;
}
double noisy_level(int i, int j) {
    return 100.0 + std::floor(5.0 * dust(i, j));
}

/// A circle of 700 mm/s at one depth below the highest level around, then back along its chord: no
/// function of the library whose last bit is the machine's.
Vec3 goal_at(int k, double depth_px) {
    double x = 1.0;
    double y = 0.0;
    const double turn = 4.961 / 100.0;
    const double c = 1.0 - turn * turn / 2.0;  // near enough to a circle
    for (int n = 0; n < k % 64; ++n) {
        const double was = x;
        x = c * x - turn * y;
        y = turn * was + c * y;
    }
    return {180.0 + 100.0 * x + (k % 7) * 0.25, 150.0 + 100.0 * y - (k / 64) * 0.5,
            100.0 - depth_px};
}

void add(std::uint64_t& hash, double value) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(value + 0.0)) * 1099511628211U;
    hash ^= hash >> 29;
}

std::uint64_t fingerprint(const Ground& ground, Algorithm algorithm) {
    const DepthImage image = test::image_of(kColumns, kRows, ground.highest_level, ground.level);
    BumpMap bump{97, 61, {}};
    for (int j = 0; j < bump.rows; ++j) {
        for (int i = 0; i < bump.columns; ++i)
            bump.heights.push_back(static_cast<float>(dust(i, j)));
    }
    const DepthSurface surface(image, image, 0.0, {255.0, ground.has_bump ? 1.5 : 0.0}, &bump);
    std::uint64_t hash = 1469598103934665603U;
    for (const double mu : {0.0, 0.4}) {
        const auto proxy = make_algorithm(algorithm);
        for (int k = 0; k < 1500; ++k) {
            const Proxy& p = proxy->update(surface, goal_at(k, 12.0), {mu, mu});
            add(hash, p.position.x);
            add(hash, p.position.y);
            add(hash, p.position.z);
        }
    }
    return hash;
}

constexpr std::array kGrounds{
    Ground{"flat",
           255.0,
           &flat_level,
           false,
           {0x5e9c67d0c4118e40U, 0x1a0eb9eb70cd4dd9U, 0xb5a3de409296822aU, 0xfaef50905e019ff1U}},
    Ground{"one level of 16-bit noise",
           65535.0,
           &near_flat_level,
           false,
           {0x9f72b6f4d873451dU, 0x46c28177b4eece4fU, 0xeb3a889465e18adfU, 0xa7d397c006a0fabdU}},
    Ground{"hills",
           65535.0,
           &hilly_level,
           false,
           {0xdbac198e5fedce91U, 0x31762f4af1cb6049U, 0xaf49a38ca312ad7eU, 0x5a852460f076e25fU}},
    Ground{"terraces of 8 bits",
           255.0,
           &terraced_level,
           false,
           {0x3521ea73b5086ce2U, 0x466dabf30301909aU, 0x10345fd46da7759eU, 0xaee363ce61db70fcU}},
    Ground{"rows that alternate by a level",
           65535.0,
           &rows_level,
           false,
           {0xe7a57701fd3f6e9bU, 0x6d5d3a74c0100b54U, 0x8f75f54b8c1e738aU, 0x5fe2e08a0f88b2bcU}},
    Ground{"8-bit noise",
           255.0,
           &noisy_level,
           false,
           {0x4ffc017e76c6a68cU, 0x1f62786cf6601c17U, 0xe48611f7675951c6U, 0xedf8b38366f88e55U}},
    Ground{"hills under a bump map",
           65535.0,
           &hilly_level,
           true,
           {0x361559a6c9a54c60U, 0xbc6a67e0e5e12f7bU, 0xae8ade6326f1e9baU, 0xa168d90516712ab1U}},
};

}  // namespace

TEST_CASE("where version 0.1 was right the proxy goes as it did, to the bit", "[bits]") {
    for (const Ground& ground : kGrounds) {
        for (const Algorithm algorithm : all_algorithms()) {
            CAPTURE(ground.name, name_of(algorithm));
            CHECK(fingerprint(ground, algorithm) ==
                  ground.fingerprints[static_cast<std::size_t>(algorithm)]);
        }
    }
}
