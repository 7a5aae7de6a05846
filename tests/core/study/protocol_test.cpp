// Valid protocols, and the errors of invalid ones.
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "tests/core/study/pages.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

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
    const std::string both = pairs + "pairs = \"all\"\n";
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
         "one of dibhr, pga, neighborhood, god-object, and not 'dbhr'; did you mean dibhr?"},
        {"title = \"T\"\n[[condition]]\nname = \"a\"\nmaterial = \"brak\"\n", 4,
         "one of ice, bark, and not 'brak'; did you mean bark?"},
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
        {kHead + "[[block]]\nquestion = \"Q\"\nfrom = \"explore\"\n", 10,
         "'from' is not known in a block; did you mean form?"},
        {kHead + "[[block]]\nform = \"2afc\"\n", 9, "form must be one of explore"},
        {kHead + "[[block]]\nform = \"explore\"\n", 8, "a block has no question"},
        {kHead + kBlock + "conditions = [\"d\"]\n", 11,
         "no condition is called 'd': there are a, b"},
        {kHead + kBlock + "pairs = [[\"a\", \"b\"]]\n", 11, "has one condition"},
        {kHead + pairs, 9, "compares two: give pairs = [[\"a\", \"b\"]], or vary"},
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
         "start is not between lowest (0.1, one step) and highest (0.5)"},
        {kHead + vary + "[block.staircase]\nstart = 0.2\nhighest = 0.5\nstep = 0.1\nfactor = 2\n",
         17, "one of them"},
        {kHead + "[[block]]\nform = \"adjust\"\nquestion = \"Q\"\nconditions = [\"a\"]\n", 8,
         "the form adjust turns a parameter: add vary"},
        {kHead + "[[block]]\nform = \"rating\"\nquestion = \"Q\"\n[block.scale]\nlowest = 5\n"
                 "highest = 1\n",
         13, "highest is not above lowest"},
        {"title = \"  \"\n" + kBlock, 1, "title is blank: write a text"},
        {"title = \"T\\nU\"\n" + kBlock, 1, "title is not one line without control characters"},
        {"title = \"T\"\nseed = 1.5\n", 2, "seed is not a whole number from 0 to 2147483647"},
        {"title = \"T\"\n[[condition]]\nname = \"a\\nb\"\n", 3, "one line without control"},
        {"title = \"T\"\n[[condition]]\nname = \"a\\u0007\"\n", 3, "one line without control"},
        {kHead + kBlock + "name = \"x\"\n" + kBlock + "name = \"x\"\n", 15,
         "there are two blocks 'x'"},
        {kHead + kBlock + "name = \"block 2\"\n" + kBlock, 12, "there are two blocks 'block 2'"},
        {kHead + kBlock + "conditions = [\"a\", \"a\"]\n", 11, "conditions has 'a' twice"},
        {kHead + kBlock + "answers = [\"one\", \"one\"]\n", 11, "answers has 'one' twice"},
        {kHead + kBlock + "answers = [\"one\", \" \"]\n", 11, "not a line of text in quotes"},
        {kHead + kBlock + "order = \"latin\"\nconditions = [\"a\"]\n", 11,
         "balances two or more conditions, pairs or levels"},
        {kHead + kBlock + "feedback = true\n", 11, "nothing is right or wrong here"},
        {kHead + both + "feedback = true\n", 12, "nothing is right or wrong here"},
        {kHead + pairs + "pairs = [[\"a\", \"b\"], [\"a\", \"b\"]]\n", 11,
         "this pair is there already"},
        {kHead + pairs + "pairs = [[\"a\", \"b\"],\n[\"b\", \"a\"]]\n", 12,
         "this pair is there already"},
        {kHead + both + "[block.adjust]\nlowest = 0\n", 12, "only the form adjust has"},
        {kHead + kBlock +
             "conditions = [\"a\"]\nvary = \"friction\"\nreference = 0.2\n"
             "levels = [0, 0.1]\nanswers = [\"x\", \"y\", \"z\"]\n",
         15, "levels have two answers"},
        {kHead + "[[block]]\nform = \"rating\"\nquestion = \"Q\"\nlevels = [0.1]\n", 11,
         "the form rating has neither levels nor a staircase"},
        {kHead + "[[block]]\nform = \"rating\"\nquestion = \"Q\"\nvary = \"friction\"\n", 11,
         "the form rating varies nothing"},
        {kHead +
             "[[block]]\nform = \"adjust\"\nquestion = \"Q\"\nconditions = [\"a\"]\n"
             "vary = \"friction\"\nreference = 0.2\n[block.adjust]\nlowest = 0.5\nhighest = 1\n",
         13, "reference is not in the range of [block.adjust], from 0.5 to 1"},
        {kHead + vary + "levels = [0.1, 0.0]\n", 14,
         "at a level of 0 no interval is the right one"},
        {kHead + vary + "levels = [\n0.1,\n1e-30]\n", 16,
         "at a level of 0 no interval is the right one"},
        {kHead + pairs +
             "conditions = [\"b\"]\nvary = \"friction\"\nreference = 0.2\nlevels = [1]\n",
         12, "leave friction (0.4) out of the condition 'b'"},
        {"title = \"T\"\n[[condition]]\nname = \"a\"\nstatic-friction = 0.6\n" + vary +
             "levels = [0.1]\n",
         9, "leave static-friction (0.6) out of the condition 'a'"},
        {kHead + vary + "[block.staircase]\nstart = 0.2\nhighest = 0.5\nfactor = 1\n", 17,
         "factor is not a number above 1, up to 100"},
        {kHead + vary + "[block.staircase]\nstart = 0.2\nhighest = 0.5\nstep = 0\n", 17,
         "step is not a number above 0"},
        {kHead + vary + "[block.staircase]\nstart = 0\nhighest = 0.5\nfactor = 1.5\n", 15,
         "start is not a number above 0"},
        {kHead + vary + "[block.staircase]\nstart = 0.2\nlowest = 0.5\nhighest = 0.4\nstep = 0.1\n",
         17, "highest is not above lowest (0.5)"},
        {kHead + vary + "[block.staircase]\nstart = 0.05\nhighest = 0.4\nstep = 0.1\n", 15,
         "start is not between lowest (0.1, one step) and highest (0.4)"},
        {kHead + vary + "[block.staircase]\nstart = 0.5\nhighest = 0.005\nfactor = 2\n", 16,
         "highest is not above lowest (0.005, a hundredth of start)"},
    }));
    CAPTURE(mistake.page);
    const std::string said = refusal_of(mistake.page);
    CAPTURE(said);
    CHECK(said.starts_with("study.toml:" + std::to_string(mistake.line) + ": "));
    CHECK(said.find(mistake.said) != std::string::npos);
    CHECK(said.find('\n') == std::string::npos);
}

TEST_CASE("what only other rooms know is told at the line in which it stands", "[study]") {
    AllowedNames names = test::allowed_names();
    names.checks = {.values =
                        [](const TouchValues& values) {
                            const auto own = values.numbers.find("friction");
                            if (own != values.numbers.end() && own->second > 0.5)
                                throw InputError("friction is too much");
                        },
                    .media = [](const StudyMedia&) { throw InputError("no media"); },
                    .picture = [](const std::filesystem::path&) { throw InputError("no picture"); },
                    .bump = [](const std::filesystem::path&) { throw InputError("no bump"); }};
    const std::string head = "title = \"T\"\n[[condition]]\nname = \"a\"\n";  // 3 lines
    const std::string vary =
        "[[block]]\nform = \"two-interval\"\nquestion = \"Q\"\nvary = \"friction\"\n";
    const std::string adjust =
        "[[block]]\nform = \"adjust\"\nquestion = \"Q\"\nvary = \"friction\"\n";
    const auto mistake = GENERATE_COPY(values<Mistake>({
        {"title = \"T\"\nthanks-picture = \"p.png\"\n", 2, "no picture"},
        {head + kBlock + "instructions-picture = \"p.png\"\n", 7, "no picture"},
        {"title = \"T\"\n[[media]]\nname = \"m\"\ncolour = \"c.mp4\"\n", 4, "no media"},
        {head + "bump = \"b.png\"\n", 4, "no bump"},
        {head + "stiffness = 0.5\nfriction = 0.6\n", 5, "the condition 'a': friction is too much"},
        {"title = \"T\"\n[base]\nfriction = 0.6\n[[condition]]\nname = \"a\"\n", 5,
         "the condition 'a': friction is too much"},
        {head + vary + "reference = 0.6\nlevels = [-0.3]\n", 8,
         "friction 0.6 in the condition 'a': friction is too much"},
        {head + vary + "reference = 0.3\nlevels = [-0.1, 0.3]\n", 9, "friction 0.6 in"},
        {head + vary +
             "reference = 0.3\n[block.staircase]\nstart = 0.1\nhighest = 0.4\nstep = 0.1\n",
         11, "friction 0.7 in"},
        {head + vary +
             "reference = 0.3\n[block.staircase]\nlowest = 0.3\nstart = 0.4\n"
             "highest = 0.5\nstep = 0.1\n",
         10, "friction 0.6 in"},
        {head + adjust + "reference = 0.3\n[block.adjust]\nlowest = 0.1\nhighest = 0.8\n", 11,
         "friction 0.8 in"},
    }));
    CAPTURE(mistake.page);
    std::string said;
    try {
        static_cast<void>(protocol_of(mistake.page, "study.toml", names));
    } catch (const InputError& error) {
        said = error.what();
    }
    CAPTURE(said);
    CHECK(said.starts_with("study.toml:" + std::to_string(mistake.line) + ": "));
    CHECK(said.find(mistake.said) != std::string::npos);
}

TEST_CASE("what may be meant is let pass", "[study]") {
    const std::string pairs = "[[block]]\nform = \"two-interval\"\nquestion = \"Q\"\n";
    const std::string varied = "vary = \"friction\"\nreference = 0.2\nlevels = [0, 0.1]\n";
    const auto page = GENERATE_COPY(values<std::string>({
        "title = \"T\"\n[[condition]]\nname = \"a\"\n[[condition]]\nname = \"b\"\n" + kBlock,
        kHead + pairs + "pairs = \"all\"\n" + pairs + "pairs = [[\"b\", \"a\"]]\n",
        kHead + kBlock + "conditions = [\"a\"]\n" + varied,  // yes and no, friction as it is
        "title = \"T\"\n[base]\nfriction = 0.4\n[[condition]]\nname = \"a\"\n" + kBlock + varied,
        kHead + kBlock + "practice = true\n",
    }));
    CAPTURE(page);
    CHECK(refusal_of(page).empty());
}

TEST_CASE("a page that was run before stays readable, though it would be refused now", "[study]") {
    const std::string page = kHead +
                             "[[block]]\nform = \"two-interval\"\nquestion = \"Q\"\n"
                             "conditions = [\"b\"]\nvary = \"friction\"\nreference = 0.2\n"
                             "feedback = true\n[block.staircase]\nstart = 0.2\nlowest = 0\n"
                             "highest = 0.5\nstep = 0.1\n";
    CHECK_FALSE(refusal_of(page).empty());
    CHECK(protocol_of(page, "P07.dibhr-study", {}).blocks.size() == 1);
}

TEST_CASE("a folder is no page, and a page has a megabyte at most", "[study]") {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "long.toml") << std::string(2 << 20, '#');
    const auto said_of = [](const std::filesystem::path& file) -> std::string {
        try {
            static_cast<void>(read_protocol(file, test::allowed_names()));
        } catch (const InputError& error) {
            return error.what();
        }
        return {};
    };
    CHECK(said_of(folder.path()).find("is a folder: name the study's page") != std::string::npos);
    CHECK(said_of(folder / "long.toml").find("a megabyte at most") != std::string::npos);
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
    CHECK(with_overrides(under, {.numbers = {{"friction", 0.1}}}) ==
          TouchValues{.numbers = {{"friction", 0.1}, {"stiffness", 0.4}}});
    CHECK(with_overrides({.words = {{"media", "a"}}}, {.words = {{"media", "b"}}})
              .words.at("media") == "b");
}
