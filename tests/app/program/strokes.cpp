// What the program recorded, touched again by the program's own `dibhr touch`.
#include "tests/app/program/strokes.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <string>

#include "app/settings/assets_path.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"

namespace dibhr::test {

namespace {

using Rows = std::vector<Row>;

/// Runs of rows of a force device in which the proxy followed from the first row on, as it does
/// when the goals and the file are all there is: each begins in free space, or where the proxy
/// began anew, and ends where a frame came late or was passed over, or where the spring became
/// another one, as that of a device that answers late does.
std::vector<Rows> strokes(const Rows& rows) {
    std::vector<Rows> all(1);
    for (std::size_t k = 1; k < rows.size(); ++k) {
        const bool jumps = rows[k].video_s < rows[k - 1].video_s;
        const bool anew = rows[k].releases_contact && rows[k - 1].contact;
        const bool as_in_file = rows[k].surface && !rows[k].mouse_fallback && rows[k].in_time;
        const bool other_spring =
            std::fabs(rows[k].stiffness_newton_per_mm - rows[k - 1].stiffness_newton_per_mm) > 0.0;
        if (jumps || anew || other_spring || !as_in_file) all.emplace_back();
        const bool begins = anew || !rows[k].contact;
        if (as_in_file && (begins || !all.back().empty())) all.back().push_back(rows[k]);
    }
    constexpr std::size_t kShort = 100;
    std::erase_if(all, [](const Rows& stroke) { return stroke.size() < kShort; });
    return all;
}

std::string exact(double value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value);
    return {text, end.ptr};
}

/// The spring forces that `dibhr touch` gives for the goals of these rows.
std::vector<Vec3> forces_of_touch(const Rows& rows) {
    const TemporaryFolder folder;
    {
        std::ofstream goals(folder / "goals.csv");
        goals << "t,x,y,z\n";
        for (const Row& row : rows) {
            goals << exact(row.video_s) << ',' << exact(row.goal.x) << ',' << exact(row.goal.y)
                  << ',' << exact(row.goal.z) << '\n';
        }
    }
    const ProgramResult result = run_dibhr(
        folder, {"touch", "--video", "--depth", sample_files().depth.string(), "--goals",
                 "goals.csv", "--stiffness", exact(rows.front().stiffness_newton_per_mm)});
    REQUIRE(result.exit_code == 0);
    std::vector<Vec3> forces;
    const std::vector<std::string> lines = split(result.output, '\n');
    for (std::size_t k = 1; k < lines.size(); ++k) {
        if (lines[k].empty()) continue;
        const std::vector<std::string> cells = split(lines[k], ',');
        forces.emplace_back(std::stod(cells.at(7)), std::stod(cells.at(8)), std::stod(cells.at(9)));
    }
    return forces;
}

}  // namespace

double strongest(const Rows& rows) {
    double newton = 0.0;
    for (const Row& row : rows) newton = std::max(newton, glm::length(row.sent_newton));
    return newton;
}

Stroked stroked(const Rows& rows) {
    Stroked told;
    for (const Rows& stroke : strokes(rows)) {
        for (const Row& row : stroke) {
            if (glm::length(row.spring_newton) > 0.2) ++told.contacts;
            if (row.spring_newton.x < -0.05) ++told.held_back;
        }
    }
    return told;
}

double worst_touched_again(const Rows& rows) {
    double worst_newton = 0.0;
    for (const Rows& stroke : strokes(rows)) {
        const std::vector<Vec3> again = forces_of_touch(stroke);
        REQUIRE(again.size() == stroke.size());
        for (std::size_t k = 0; k < again.size(); ++k)
            worst_newton = std::max(worst_newton, glm::distance(again[k], stroke[k].spring_newton));
    }
    return worst_newton;
}

}  // namespace dibhr::test
