// The table of touch parameters.
#include "core/haptics/parameters.hpp"

#include <cstddef>
#include <set>
#include <string_view>

#include "tests/support/catch.hpp"

using namespace dibhr;

TEST_CASE("every number that people tune has an entry of its own", "[parameters]") {
    constexpr std::size_t kNumbers =
        (sizeof(SurfaceShape) + sizeof(Friction) + sizeof(Coupling)) / sizeof(double);
    CHECK(touch_numbers().size() == kNumbers);
    TouchParameters parameters;
    std::set<const double*> members;
    std::set<std::string_view> names, columns;
    for (const TouchNumber& number : touch_numbers()) {
        INFO(number.name);
        members.insert(&number.in(parameters));
        names.insert(number.name);
        columns.insert(number.column);
        CHECK(&number_of(number.in(parameters), parameters) == &number);
        CHECK(touch_number(number.name) == &number);
        CHECK_FALSE(number.help.empty());
    }
    CHECK(members.size() == kNumbers);
    CHECK(names.size() == kNumbers);
    CHECK(columns.size() == kNumbers);
    CHECK(touch_number("dance") == nullptr);
}
