// The table of touch parameters.
#include "core/haptics/parameters.hpp"

#include <cstddef>
#include <set>
#include <string>
#include <string_view>

#include "tests/support/catch.hpp"

using namespace dibhr;

TEST_CASE("every number that people tune has an entry of its own", "[parameters]") {
    constexpr std::size_t kNumbers =
        (sizeof(SurfaceShape) + sizeof(Friction) + sizeof(Coupling)) / sizeof(double);
    CHECK(touch_numbers().size() == kNumbers);
    TouchParameters parameters;
    std::set<const double*> members;
    for (const TouchNumber& number : touch_numbers()) {
        INFO(number.name);
        members.insert(&number.in(parameters));
        CHECK(&number_of(number.in(parameters), parameters) == &number);
        CHECK(touch_number(number.name) == &number);
    }
    CHECK(members.size() == kNumbers);
    CHECK(touch_number("dance") == nullptr);
}

TEST_CASE("no two entries of the table have a name, a label or a column in common",
          "[parameters]") {
    std::set<std::string_view> names, labels, columns;
    std::size_t entries = 0;
    visit_touch_entries([&](const auto& entry) {
        INFO(entry.name);
        CHECK(names.insert(entry.name).second);
        CHECK(labels.insert(entry.label).second);
        CHECK(columns.insert(entry.column).second);
        CHECK_FALSE(entry.help.empty());
        ++entries;
    });
    CHECK(entries == touch_numbers().size() + touch_switches().size() + touch_choices().size());
}

TEST_CASE("a choice has each of its words and no other one", "[parameters]") {
    for (const TouchChoice& choice : touch_choices()) {
        INFO(choice.name);
        TouchParameters parameters;
        for (const std::string& word : choice.names()) {
            CHECK(choice.choose(word, parameters));
            CHECK(choice.of(parameters) == word);
        }
        const TouchParameters before = parameters;
        CHECK_FALSE(choice.choose("dance", parameters));
        CHECK(parameters == before);
    }
}

TEST_CASE("where numbers alone are taken, a switch is off at 0 and on at anything else",
          "[parameters]") {
    for (const TouchSwitch& entry : touch_switches()) {
        INFO(entry.name);
        const PlainNumber plain{entry.name, entry.label, "", entry.help, 0.0, 1.0, nullptr, &entry};
        TouchParameters parameters;
        for (const double value : {1.0, 0.0, 0.5}) {
            plain.put(value, parameters);
            CHECK(entry.of(parameters) == (value > 0.0));
            CHECK(plain.of(parameters) == (value > 0.0 ? 1.0 : 0.0));
        }
    }
}
