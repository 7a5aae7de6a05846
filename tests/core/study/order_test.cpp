// The order of trials: balanced over participants, and the same everywhere.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/core/study/pages.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;

using Counts = std::map<std::pair<int, int>, int>;

/// Whether there are so many counts, all equal.
bool is_even(const Counts& counts, std::size_t size) {
    std::set<int> different;
    for (const auto& [key, count] : counts) different.insert(count);
    return counts.size() == size && different.size() == 1;
}

const std::string kPairs =
    "[[block]]\nform = \"two-interval\"\nquestion = \"Q\"\npairs = [[\"a\", \"b\"]]\n";

}  // namespace

TEST_CASE("Williams squares have each item at each place and after each other equally often",
          "[study]") {
    const int count = GENERATE(1, 2, 3, 4, 5, 6, 7, 8, 9, 12);
    CAPTURE(count);
    Counts places;
    Counts followers;
    for (int row = 0; row < williams_rows(count); ++row) {
        const std::vector<int> items = williams_row(count, row);
        for (int k = 0; k < count; ++k) {
            ++places[{items[static_cast<std::size_t>(k)], k}];
            if (k > 0)
                ++followers[{items[static_cast<std::size_t>(k - 1)],
                             items[static_cast<std::size_t>(k)]}];
        }
    }
    const auto size = static_cast<std::size_t>(count);
    CHECK(is_even(places, size * size));
    CHECK((count == 1 || is_even(followers, size * (size - 1))));
}

TEST_CASE("over all participants of a square each condition stands at each position equally often",
          "[study]") {
    const int count = GENERATE(2, 3, 4, 5);
    CAPTURE(count);
    const Protocol study = test::protocol(test::page_of_conditions(
        count,
        "[[block]]\nform = \"explore\"\nquestion = \"Q\"\norder = \"latin\"\n"
        "repetitions = 3\n"));
    Counts places;
    for (int number = 1; number <= williams_rows(count); ++number)
        for (const AnsweredTrial& one : test::all_trials(study, number))
            ++places[{one.trial.item, one.trial.position}];
    CHECK(is_even(places, static_cast<std::size_t>(count * count * 3)));
}

TEST_CASE("the target stands at each interval equally often", "[study]") {
    const int repetitions = GENERATE(2, 4, 10);
    const Protocol study = test::protocol(test::page_of_conditions(
        2, kPairs + "repetitions = " + std::to_string(repetitions) + "\n"));
    for (int number = 1; number <= 20; ++number) {
        int second = 0;
        for (const AnsweredTrial& one : test::all_trials(study, number)) {
            second += one.trial.target;
            const auto target = static_cast<std::size_t>(one.trial.target);
            CHECK(one.trial.intervals[target].condition == "b");
            CHECK(one.trial.intervals[1 - target].condition == "a");
        }
        CHECK(2 * second == repetitions);
    }
}

TEST_CASE("of an odd number of repetitions the extra one is shared among participants", "[study]") {
    const Protocol study =
        test::protocol(test::page_of_conditions(2, kPairs + "repetitions = 3\n"));
    int second = 0;
    for (int number = 1; number <= 10; ++number)
        for (const AnsweredTrial& one : test::all_trials(study, number)) second += one.trial.target;
    CHECK(second == 15);
}

TEST_CASE("in an oddity trial one interval differs, of either kind and in every place", "[study]") {
    const Protocol study = test::protocol(test::page_of_conditions(
        2,
        "[[block]]\nform = \"three-interval\"\nquestion = \"Q\"\npairs = \"all\"\n"
        "repetitions = 6\n"));
    std::map<int, int> places;
    std::map<std::string, int> odd_ones;
    for (const AnsweredTrial& one : test::all_trials(study, 1)) {
        const auto& all = one.trial.intervals;
        const auto odd = static_cast<std::size_t>(one.trial.target);
        CHECK(all[(odd + 1) % 3] == all[(odd + 2) % 3]);
        CHECK(all[odd].condition != all[(odd + 1) % 3].condition);
        ++places[one.trial.target];
        ++odd_ones[all[odd].condition];
    }
    CHECK(places == std::map<int, int>{{0, 2}, {1, 2}, {2, 2}});
    CHECK(odd_ones == std::map<std::string, int>{{"a", 3}, {"b", 3}});
}

TEST_CASE("the same seed gives the same order on every machine", "[study]") {
    const Protocol study = test::protocol(test::page_of_conditions(
        4, "[[block]]\nform = \"explore\"\nquestion = \"Q\"\nrepetitions = 2\n"));
    CHECK(order_of(study, 0, 1) == std::vector<int>{3, 1, 1, 2, 2, 3, 0, 0});
    CHECK(order_of(study, 0, 2) == std::vector<int>{3, 3, 2, 0, 1, 0, 1, 2});
    Protocol other = study;
    other.seed = 6;
    CHECK(order_of(other, 0, 1) != order_of(study, 0, 1));
}

TEST_CASE("a level of constant stimuli is what the comparison has more than the reference",
          "[study]") {
    const Protocol study = test::protocol(test::page_of_conditions(
        1,
        "[[block]]\nform = \"two-interval\"\nquestion = \"Q\"\nvary = \"friction\"\n"
        "reference = 0.2\nlevels = [0.05, 0.1, -0.1]\nrepetitions = 4\n"));
    std::map<double, int> levels;
    for (const AnsweredTrial& one : test::all_trials(study, 3)) {
        const auto target = static_cast<std::size_t>(one.trial.target);
        const StudyInterval& compared = one.trial.intervals[target];
        CHECK(one.trial.intervals[1 - target].values.numbers.at("friction") == 0.2);
        CHECK(compared.values.numbers.at("friction") == 0.2 + *one.trial.level);
        ++levels[*one.trial.level];
    }
    CHECK(levels == std::map<double, int>{{-0.1, 4}, {0.05, 4}, {0.1, 4}});
}

TEST_CASE("interleaved staircases each follow their own answers and end by themselves", "[study]") {
    const Protocol study = test::protocol(test::page_of_conditions(
        1,
        "[[block]]\nform = \"two-interval\"\nquestion = \"Q\"\nvary = \"friction\"\n"
        "reference = 0.2\n[block.staircase]\nstart = 0.4\nlowest = 0.1\nhighest = 0.5\n"
        "step = 0.1\ndown-after = 1\ntrials = 8\ntracks = 2\n"));
    // Track 0 always right, track 1 never.
    const auto all = test::all_trials(study, 1, [](const Trial& trial) {
        return StudyAnswer{.choice = trial.track == 0 ? trial.target : 1 - trial.target};
    });
    CHECK(all.size() == 16);
    std::map<int, double> last;
    for (std::size_t k = 0; k < all.size(); ++k) {
        last[all[k].trial.track] = *all[k].trial.level;
        CHECK((k % 2 == 0 || all[k].trial.track != all[k - 1].trial.track));
    }
    CHECK_THAT(last[0], Catch::Matchers::WithinAbs(0.1, 1e-9));
    CHECK_THAT(last[1], Catch::Matchers::WithinAbs(0.5, 1e-9));
}

TEST_CASE("the levels of a staircase are whole steps to the last bit, and none of them is 0",
          "[study]") {
    const std::string form = GENERATE("two-interval", "three-interval", "explore");
    const Protocol study = test::protocol(test::page_of_conditions(
        1, "[[block]]\nform = \"" + form +
               "\"\nquestion = \"Q\"\nvary = \"friction\"\nreference = 0.3\n"
               "[block.staircase]\nstart = 0.4\nhighest = 1\nstep = 0.1\ndown-after = 1\n"
               "trials = 60\n"));
    // Ten right answers, then ten wrong ones.
    const auto all = test::all_trials(study, 1, [](const Trial& trial) {
        const bool finds = trial.number / 10 % 2 == 0;
        const int hit = std::max(0, trial.target);
        return StudyAnswer{.choice = finds ? hit : (hit == 0 ? 1 : 0)};
    });
    REQUIRE(all.size() == 60);
    const std::set<double> whole{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0};
    std::set<double> met;
    for (const AnsweredTrial& one : all) {
        CHECK(one.right.has_value());
        met.insert(*one.trial.level);
    }
    CHECK(met == whole);
}

TEST_CASE("an adjustment begins anywhere in its range", "[study]") {
    const Protocol study = test::protocol(test::page_of_conditions(
        1,
        "[[block]]\nform = \"adjust\"\nquestion = \"Q\"\nvary = \"friction\"\nreference = 0.3\n"
        "repetitions = 20\n[block.adjust]\nlowest = 0.1\nhighest = 0.6\n"));
    std::set<double> starts;
    for (const AnsweredTrial& one :
         test::all_trials(study, 1, [](const Trial&) { return StudyAnswer{.number = 0.3}; })) {
        CHECK(*one.trial.intervals[0].value == 0.3);
        const double start = *one.trial.intervals[1].value;
        CHECK((start >= 0.1 && start <= 0.6));
        starts.insert(start);
    }
    CHECK(starts.size() == 20);
}
