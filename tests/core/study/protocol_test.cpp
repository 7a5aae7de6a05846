// What a protocol may say, and what is said of one that may not.
#include <string>
#include <vector>

#include "core/error.hpp"
#include "tests/core/study/pages.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace dibhr;

const std::string kHead =
    "title = \"T\"\n[[condition]]\nname = \"a\"\nfriction = 0.2\n"
    "[[condition]]\nname = \"b\"\nfriction = 0.4\n";  // 7 lines
const std::string kBlock = "[[block]]\nform = \"explore\"\nquestion = \"Q\"\n";

struct Mistake {
    std::string page;
    int line;
    std::string said;  ///< part of what is said of it
};

std::string refusal_of(const std::string& page) {
    try {
        static_cast<void>(test::protocol(page));
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

}  // namespace

TEST_CASE("a mistake in a protocol is told with its line and with what is allowed", "[study]") {
    const std::string pairs = "[[block]]\nform = \"two-interval\"\nquestion = \"Q\"\n";
    const std::string vary = pairs + "conditions = [\"a\"]\nvary = \"friction\"\nreference = 0.2\n";
    const auto mistake = GENERATE_COPY(values<Mistake>({
        {"title = ", 1, "cannot be understood"},
        {"seed = 1\n" + kBlock, 1, "a study has no title: add title = \"...\""},
        {"title = 5\n" + kBlock, 1, "title is not a text in quotes"},
        {"title = \"T\"\nversion = 2\n", 2, "version is not a whole number from 1 to 1"},
        {"title = \"T\"\nseed = -1\n", 2, "seed is not a whole number from 0"},
        {"title = \"T\"\n" + kBlock, 1, "there is no condition: add [[condition]]"},
        {kHead, 1, "there is no block: add [[block]]"},
        {"titel = \"T\"\n" + kHead + kBlock, 1, "did you mean title?"},
        {"title = \"T\"\n[[condition]]\nname = \"a\"\nfrictoin = 0.2\n", 4,
         "did you mean friction?"},
        {"title = \"T\"\n[[condition]]\nfriction = 0.2\n", 2, "a condition has no name"},
        {"title = \"T\"\n[[condition]]\nname = \"a\"\nfriction = 20\n", 4,
         "friction is not a number from 0 to"},
        {"title = \"T\"\n[[condition]]\nname = \"a\"\nfriction = \"low\"\n", 4,
         "friction is not a number from 0 to"},
        {"title = \"T\"\n[[condition]]\nname = \"a\"\nalgorithm = \"dbhr\"\n", 4,
         "one of dibhr, pga, neighborhood, god-object; did you mean dibhr?"},
        {"title = \"T\"\n[[condition]]\nname = \"a\"\nmaterial = \"brak\"\n", 4,
         "one of ice, bark; did you mean bark?"},
        {"title = \"T\"\n[[condition]]\nname = \"a\"\ncleaning = \"very\"\n", 4,
         "one of auto, raw, gentle, sensor"},
        {"title = \"T\"\n[[condition]]\nname = \"a\"\nmedia = \"film\"\n", 4, "one of sample"},
        {"title = \"T\"\n[[condition]]\nname = \"a\"\ncarry = \"on\"\n", 4, "true or false"},
        {"title = \"T\"\n[[condition]]\nname = \"a\"\nstatic-friction = 0.1\n"
         "dynamic-friction = 0.3\n",
         5, "dynamic-friction is above static-friction (0.1)"},
        {kHead + "[[condition]]\nname = \"a\"\n" + kBlock, 9, "there are two conditions 'a'"},
        {"title = \"T\"\n[[factor]]\nname = \"f\"\nlevels = [{name = \"x\"}]\n" + kBlock, 4,
         "a factor has two levels at least"},
        {kHead + "[[block]]\nquestion = \"Q\"\n", 8, "a block has no form: it is one of explore"},
        {kHead + "[[block]]\nform = \"2afc\"\n", 9, "form is not '2afc' but one of explore"},
        {kHead + "[[block]]\nform = \"explore\"\n", 8, "a block has no question"},
        {kHead + kBlock + "conditions = [\"d\"]\n", 11,
         "no condition is called 'd': there are a, b"},
        {kHead + kBlock + "pairs = [[\"a\", \"b\"]]\n", 11, "has one condition"},
        {kHead + pairs, 9, "compares two: give pairs, or vary"},
        {kHead + pairs + "pairs = [[\"a\"]]\n", 11, "a list of two conditions each"},
        {kHead + kBlock + "order = \"latn\"\n", 11, "did you mean latin?"},
        {kHead + kBlock + "repetitions = 0\n", 11, "a whole number from 1 to 10000"},
        {kHead + kBlock + "repetitions = 9000\n", 11, "more than 10000 trials"},
        {kHead + kBlock + "answers = [\"yes\"]\n", 11, "there are 2 to 9 answers"},
        {kHead + pairs + "pairs = \"all\"\nanswers = [\"x\", \"y\"]\n", 12, "has its own answers"},
        {kHead + pairs + "levels = [0.1]\n", 11, "levels is of a parameter: name it"},
        {kHead + vary, 12, "vary needs levels = [...] or [block.staircase]"},
        {kHead + vary + "levels = [0.1, 0.1]\n", 14, "levels has 0.1 twice"},
        {kHead + vary + "levels = [99]\n", 14, "the level 99 beyond the reference is out of range"},
        {kHead + vary + "[block.staircase]\nstart = 1\n", 14, "a staircase has no highest"},
        {kHead + vary + "[block.staircase]\nstart = 0.9\nhighest = 0.5\nstep = 0.1\n", 15,
         "start is not between lowest and highest"},
        {kHead + vary + "[block.staircase]\nstart = 0.2\nhighest = 0.5\nstep = 0.1\nfactor = 2\n",
         17, "one of them"},
        {kHead + "[[block]]\nform = \"adjust\"\nquestion = \"Q\"\nconditions = [\"a\"]\n", 8,
         "the form adjust turns a parameter: add vary"},
        {kHead + "[[block]]\nform = \"rating\"\nquestion = \"Q\"\n[block.scale]\nlowest = 5\n"
                 "highest = 1\n",
         13, "highest is not above lowest"},
    }));
    CAPTURE(mistake.page);
    const std::string said = refusal_of(mistake.page);
    CAPTURE(said);
    CHECK(said.starts_with("study.toml:" + std::to_string(mistake.line) + ": "));
    CHECK(said.find(mistake.said) != std::string::npos);
    CHECK(said.find('\n') == std::string::npos);
}

TEST_CASE("crossed factors give every combination, the last one the fastest", "[study]") {
    const auto study = test::protocol(
        "title = \"T\"\n[base]\nstiffness = 0.7\nfriction = 0.1\n"
        "[[factor]]\nname = \"how\"\nlevels = [{name = \"d\", algorithm = \"dibhr\"}, "
        "{name = \"p\", algorithm = \"pga\"}]\n"
        "[[factor]]\nname = \"mu\"\nlevels = [{name = \"low\"}, {name = \"high\", friction = "
        "0.6}]\n" +
        kBlock);
    REQUIRE(study.conditions.size() == 4);
    CHECK(study.conditions[1].name == "d+high");
    CHECK(study.conditions[1].levels ==
          std::map<std::string, std::string>{{"how", "d"}, {"mu", "high"}});
    CHECK(study.conditions[2].name == "p+low");
    CHECK(study.conditions[3].values.words.at("algorithm") == "pga");
    CHECK(study.conditions[3].values.numbers.at("friction") == 0.6);
    CHECK(study.conditions[2].values.numbers.at("friction") == 0.1);
    CHECK(study.conditions[0].values.numbers.at("stiffness") == 0.7);
}

TEST_CASE("friction of both kinds takes the place of one kind below it", "[study]") {
    const TouchValues under{.numbers = {{"static-friction", 0.5}, {"stiffness", 0.4}}};
    CHECK(laid_over(under, {.numbers = {{"friction", 0.1}}}) ==
          TouchValues{.numbers = {{"friction", 0.1}, {"stiffness", 0.4}}});
    CHECK(laid_over({.words = {{"media", "a"}}}, {.words = {{"media", "b"}}}).words.at("media") ==
          "b");
}
