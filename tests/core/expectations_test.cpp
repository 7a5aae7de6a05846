// What people expect of a viewer: each row of the table beside names a test that there is.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/catch.hpp"

namespace {

namespace fs = std::filesystem;

struct Expectation {
    std::string feature, priority, test;
};

std::string trimmed(const std::string& text) {
    const std::size_t begin = text.find_first_not_of(' ');
    if (begin == std::string::npos) return {};
    return text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

std::vector<Expectation> expectations(const fs::path& file) {
    std::ifstream in(file);
    std::vector<Expectation> rows;
    for (std::string line; std::getline(in, line);) {
        std::istringstream cells(line);
        std::vector<std::string> row;
        for (std::string cell; std::getline(cells, cell, '|');) row.push_back(trimmed(cell));
        if (row.size() >= 4 && row[2].starts_with('P')) rows.push_back({row[1], row[2], row[3]});
    }
    return rows;
}

/// What stands in quotes from `at` on, pieces of a literal joined; empty: nothing does.
std::string literal_at(const std::string& source, std::size_t at) {
    std::string text;
    for (;;) {
        at = source.find_first_not_of(" \n", at);
        if (at == std::string::npos || source[at] != '"') return text;
        const std::size_t end = source.find('"', at + 1);
        if (end == std::string::npos) return text;
        text += source.substr(at + 1, end - at - 1);
        at = end + 1;
    }
}

std::set<std::string> names_of_tests(const fs::path& folder) {
    const std::string begin = "TEST_CASE(";
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() != ".cpp") continue;
        std::ifstream in(entry.path());
        std::ostringstream content;
        content << in.rdbuf();
        const std::string source = content.str();
        for (std::size_t at = 0; (at = source.find(begin, at)) != std::string::npos;)
            names.insert(literal_at(source, at += begin.size()));
    }
    return names;
}

}  // namespace

TEST_CASE("what people expect on the first day is there, each shown by a test that there is") {
    const fs::path tests = fs::path(DIBHR_SOURCE_DIR) / "tests";
    const std::set<std::string> names = names_of_tests(tests);
    std::map<std::string, int> shown;
    std::map<std::string, int> all;
    for (const Expectation& row : expectations(tests / "expectations.md")) {
        ++all[row.priority];
        if (row.test.empty()) {
            std::cout << row.priority << " not yet: " << row.feature << '\n';
            continue;
        }
        CAPTURE(row.feature, row.test);
        CHECK(names.contains(row.test));
        ++shown[row.priority];
    }
    for (const auto& [priority, count] : all)
        std::cout << priority << ": " << shown[priority] << " of " << count << " shown by a test\n";
    CHECK(all["P1"] == 37);
    CHECK(all["P2"] == 14);
    CHECK(shown["P1"] == all["P1"]);
}
