// Output that appears whole or not at all, tables that people wrote, and text and numbers as
// written.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/files/csv_table.hpp"
#include "core/files/json.hpp"
#include "core/files/names.hpp"
#include "core/files/output_file.hpp"
#include "core/files/plain_text.hpp"
#include "core/files/write_failure.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace dibhr;
using dibhr::test::read_text;
using dibhr::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

std::optional<std::size_t> column_of(const CsvTable& table, std::string_view name) {
    return table.find({&name, 1});
}

}  // namespace

TEST_CASE("an output file is there after commit, and nothing is without it", "[files]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "out.csv";
    {
        OutputFile out(file);
        out.write("half");
    }
    CHECK_FALSE(fs::exists(file));
    {
        OutputFile out(file);
        out.write("the ");
        out.write("whole");
        out.commit();
    }
    CHECK(read_text(file) == "the whole");
    const auto open_files = [] {
        return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
    };
    const auto before = open_files();
    { OutputFile(file).write("broken off"); }
    CHECK(open_files() == before);
    CHECK(read_text(file) == "the whole");
    CHECK(std::distance(fs::directory_iterator(file.parent_path()), {}) == 1);
}

TEST_CASE("an output file that stands beside others replaces none and takes the first free number",
          "[files]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "view.png";
    const auto written = [&file](const char* text) {
        OutputFile out(file);
        out.write(text);
        return out.commit_beside();
    };
    CHECK(written("first") == file);
    CHECK(written("second") == folder / "view-2.png");
    {
        OutputFile late(file);
        late.write("third");
        CHECK(written("fourth") == folder / "view-3.png");  // while the other is written
        CHECK(late.commit_beside() == folder / "view-4.png");
    }
    fs::remove(folder / "view-2.png");
    CHECK(written("fifth") == folder / "view-2.png");
    CHECK(read_text(file) == "first");
    CHECK(read_text(folder / "view-4.png") == "third");
    CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 4);
}

TEST_CASE("an output file is written beside what another program left, and as readable as any",
          "[files]") {
    const TemporaryFolder folder;
    const fs::path file = folder / "out.csv";
    const std::string left = file.string() + ".part" + std::to_string(::getpid());
    for (const char* ending : {"", "-0", "-1"}) std::ofstream(left + ending) << "half";
    const mode_t mask = ::umask(027);
    {
        OutputFile out(file);
        out.write("whole");
        out.commit();
    }
    ::umask(mask);
    CHECK(read_text(file) == "whole");
    struct stat status {};
    REQUIRE(::stat(file.c_str(), &status) == 0);
    CHECK((status.st_mode & 0777U) == 0640U);
    CHECK(read_text(left + "-1") == "half");
    OutputFile first(folder / "both");
    OutputFile second(folder / "both");  // two at once
    first.write("1");
    second.write("2");
    second.commit();
    first.commit();
    CHECK(read_text(folder / "both") == "1");
}

TEST_CASE("what programs that were killed left unfinished goes when the file is written again",
          "[files]") {
    const pid_t ended = ::fork();
    if (ended == 0) ::_exit(0);
    ::waitpid(ended, nullptr, 0);
    const std::string dead = std::to_string(ended);
    struct Left {
        std::string name;
        bool goes;
    };
    const std::vector<Left> all{{"out.csv.part" + dead + "-0", true},
                                {"out.csv.part" + dead + "-7", true},
                                {"out.csv.part" + dead + "-999", true},
                                {"out.csv.part" + dead + "-0-wal", true},
                                {"out.csv.part" + dead + "-0-journal", true},
                                {"out.csv.part" + std::to_string(::getpid()) + "-9", false},
                                {"out.csv.part1-0", false},
                                {"out.csv.part" + dead, false},
                                {"out.csv.part" + dead + "-mine.csv", false},
                                {"out.csv.part" + dead + "-0-mine.csv", false},
                                {"out.csv.part" + dead + "-", false},
                                {"out.csv.part" + dead + "_0", false},
                                {"out.csv.part-0", false},
                                {"out.csv.part0-0", false},
                                {"out.csv.part-5-0", false},
                                {"out.csv.part99999999999999999999-0", true},
                                {"out.csv.partial", false},
                                {"out.csv.party" + dead + "-0", false},
                                {"out.csv", false},
                                {"out.csv.bak", false},
                                {"xout.csv.part" + dead + "-0", false},
                                {"out.csv2.part" + dead + "-0", false},
                                {".out.csv.part" + dead + "-0", false},
                                {"part" + dead + "-0", false}};
    const TemporaryFolder folder;
    for (const Left& left : all) test::write_text(folder / left.name, "left");
    fs::create_directory(folder / ("out.csv.part" + dead + "-1"));
    fs::create_symlink("out.csv.bak", folder / ("out.csv.part" + dead + "-2"));
    test::write_text(folder / ("out.csv.part" + dead + "-3"), "held");
    const int held =
        ::open((folder / ("out.csv.part" + dead + "-3")).c_str(), O_RDONLY | O_CLOEXEC);
    REQUIRE(::flock(held, LOCK_EX | LOCK_NB) == 0);  // by a program on another machine
    { const OutputFile out(folder / "out.csv"); }
    ::close(held);
    for (const Left& left : all) {
        CAPTURE(left.name);
        CHECK(fs::exists(folder / left.name) != left.goes);
    }
    CHECK(fs::is_directory(folder / ("out.csv.part" + dead + "-1")));
    CHECK(fs::is_symlink(folder / ("out.csv.part" + dead + "-2")));
    CHECK(fs::exists(folder / ("out.csv.part" + dead + "-3")));
    CHECK(read_text(folder / "out.csv.bak") == "left");
}

TEST_CASE("a link stays a link and a pipe stays a pipe", "[files]") {
    const TemporaryFolder folder;
    fs::create_symlink(folder / "real", folder / "link");
    OutputFile out(folder / "link");
    out.write("x");
    out.commit();
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(read_text(folder / "real") == "x");
    OutputFile nowhere("/dev/null");
    nowhere.write("y");
    nowhere.commit();
    CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("a target that cannot be written is refused by name before anything is written",
          "[files]") {
    const TemporaryFolder folder;
    CHECK_THROWS_WITH(OutputFile(folder / "missing" / "out.csv"),
                      (folder / "missing" / "out.csv").string() +
                          ": cannot be written (No such file or directory); make the folder, or "
                          "choose another");
    CHECK_THROWS_AS(OutputFile(folder / ""), InputError);
}

TEST_CASE("what to do when something cannot be written fits the reason", "[files]") {
    CHECK(write_failure(EACCES) ==
          "cannot be written (Permission denied); choose a folder that you may write to");
    CHECK(step_after_failed_writing(EROFS) == step_after_failed_writing(EACCES));
    CHECK(step_after_failed_writing(ENOENT) == "make the folder, or choose another");
    CHECK(test::contains(step_after_failed_writing(ENOSPC), "make room"));
    for (const int error : {EACCES, ENOENT, ENOTDIR, EISDIR, EIO})
        CHECK_FALSE(test::contains(step_after_failed_writing(error), "make room"));
}

TEST_CASE("text is quoted short and on one line, and cells lose what stands around them",
          "[files]") {
    CHECK(in_quotes("a\nb\tc") == "'a?b?c'");
    CHECK(in_quotes(std::string(100, 'x')).size() == 45);
    const TemporaryFolder folder;
    for (const char* mark : {"", "\xEF\xBB\xBF"}) {
        std::ofstream(folder / "t.csv") << mark << "t, \t\"x y\" \r\n \r\n 1 , \"2\"\r\n";
        CsvTable table(folder / "t.csv", "");
        CHECK(column_of(table, "t") == 0U);
        CHECK(column_of(table, "x y") == 1U);
        CHECK_FALSE(column_of(table, "x"));
        REQUIRE(table.next());
        CHECK(table.number(0) == 1.0);
        CHECK(table.number(1) == 2.0);
        CHECK_FALSE(table.next());
    }
}

TEST_CASE("words of a name end at signs, at digits and where small letters do", "[files]") {
    CHECK(words_of_name("depthInMeters_02.png") ==
          std::vector<std::string>{"depth", "in", "meters", "02", "png"});
    CHECK(words_of_name("IMG-0412 RGB") == std::vector<std::string>{"img", "0412", "rgb"});
    CHECK(words_of_name("H\xc3\xb6he") == std::vector<std::string>{"h\xc3\xb6he"});
    CHECK(words_of_name("").empty());
}

TEST_CASE("numbers as text read back to the same bits", "[files]") {
    const double value = GENERATE(0.1, 1.0 / 3.0, 1e-300, -0.0, 12345678.9);
    CHECK(std::stod(number_text(value)) == value);
    std::string text = "x=";
    append_number(text, value);
    CHECK(std::stod(text.substr(2)) == value);
    CHECK(parsed_json(json_text(value)).get<double>() == value);
    CHECK(std::stod(json_text(value)) == value);
    CHECK(number_text(2.345, 1) == "2.3");
}

TEST_CASE("JSON has null for what is not finite, and texts in quotation marks", "[files]") {
    CHECK(json_text(1.0 / 0.0) == "null\n");
    CHECK(json_text("a \"b\"\n\\") == "\"a \\\"b\\\"\\n\\\\\"\n");
}

TEST_CASE("JSON keeps the order of its members, whatever their values are", "[files]") {
    CHECK(json_text({{"z", 1}, {"a", 1.0 / 0.0}, {"m", "a\xFF \"b\"\n"}}) ==
          "{\n  \"z\": 1,\n  \"a\": null,\n  \"m\": \"a\xEF\xBF\xBD \\\"b\\\"\\n\"\n}\n");
}

TEST_CASE("a folder, a device or a missing file is refused with what to give instead", "[files]") {
    const TemporaryFolder folder;
    for (const fs::path& file : {folder / "", folder / "missing.csv", fs::path("/dev/zero")}) {
        try {
            const CsvTable table(file, "give something else");
            FAIL("not refused: " << file);
        } catch (const InputError& error) {
            const std::string words = error.what();
            CHECK(words.find(file.string()) != std::string::npos);
            CHECK(words.find("give something else") != std::string::npos);
        }
    }
}
TEST_CASE("no text of a CSV file is a formula to a spreadsheet", "[files]") {
    for (const char* const formula : {"=cmd|' /C calc'!A0",
                                      "=1+1",
                                      "+1+1",
                                      "-1+1",
                                      "@SUM(A1)",
                                      "=HYPERLINK(\"http://x\")",
                                      " =1",
                                      "\t=1",
                                      "=1;2",
                                      "\n=1",
                                      "  +x",
                                      "\"=1",
                                      "'=1",
                                      "\"\"=1",
                                      "-x",
                                      "+",
                                      "=",
                                      "\xEF\xBC\x9D"
                                      "1",
                                      "\xEF\xBC\x8B"
                                      "1",
                                      "\xEF\xBC\x8D"
                                      "1",
                                      "\xEF\xBC\xA0"
                                      "A",
                                      "=1,2"}) {
        const std::string cell = csv_cell(formula);
        CAPTURE(formula, cell);
        CHECK((cell.starts_with("'") || cell.starts_with("\"'")));
        CHECK(cell.find_first_of("\n\r\t") == std::string::npos);
    }
    for (const char* const word : {"", "P07", "how=d", "a-b", "-0.5", "1e-3", "prefer=x"})
        CHECK(csv_cell(word) == std::string(word));
    CHECK(csv_cell("a,\"b\"") == "\"a,\"\"b\"\"\"");
}
