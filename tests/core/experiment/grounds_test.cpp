// What algorithms are timed on.
#include "core/experiment/grounds.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "tests/support/catch.hpp"

using namespace dibhr;

TEST_CASE("grounds differ as their names say, and goals are 20 px below them", "[grounds]") {
    std::vector<std::string> names;
    for (const MakeGround make : made_grounds()) {
        const Ground ground = make();
        CAPTURE(ground.name);
        names.push_back(ground.name);
        const DepthSurface surface = ground.clip.at(0.0);
        const bool flat = ground.name == "bit-flat";
        const Vec3 first = ground.paths.at(0).goals.at(0);
        bool level = true;
        for (int k = 0; k < 50; ++k) {
            const int i = static_cast<int>(first.x) + k;
            const int j = static_cast<int>(first.y) + k;
            level = level && surface.elevation(i, j) == surface.elevation(i + 1, j + 1);
        }
        CHECK(level == flat);
        for (const PathRun& path : ground.paths) {
            CHECK(path.columns == ground.clip.columns());
            CHECK(path.rows == ground.clip.rows());
            CHECK(path.goals.size() == kExperimentUpdates);
            CHECK(std::abs(path.depth_px - kExperimentDepth_px) <= 1e-9);
        }
        for (const Jump& jump : ground.jumps) CHECK(glm::length(jump.to - jump.from) > 7000.0);
    }
    CHECK(names == std::vector<std::string>{"bit-flat", "bit-flat", "near-flat", "bumpy",
                                            "bump map", "crease"});
}
