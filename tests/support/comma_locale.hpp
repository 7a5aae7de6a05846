// A locale whose numbers have a decimal comma, as programs of Qt or GTK set it for their user.
#pragma once

#include <clocale>
#include <cstdlib>
#include <string>

#include "tests/support/catch.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dibhr::test {

/// Sets the locale of this process until it is destroyed; compiled by the C library's own tool, of
/// few characters: for all of them it takes four times as long.
class CommaLocale {
  public:
    CommaLocale() {
        const std::string compiled = (folder_ / "de_DE").string();
        REQUIRE(std::system(("localedef -i de_DE -f ISO-8859-1 '" + compiled + "'").c_str()) == 0);
        ::setenv("LOCPATH", folder_.path().c_str(), 1);
        REQUIRE(std::setlocale(LC_ALL, "de_DE") != nullptr);
        REQUIRE(std::string(std::localeconv()->decimal_point) == ",");
    }
    ~CommaLocale() {
        std::setlocale(LC_ALL, "C");
        ::unsetenv("LOCPATH");
    }
    CommaLocale(const CommaLocale&) = delete;
    CommaLocale& operator=(const CommaLocale&) = delete;

  private:
    TemporaryFolder folder_{};
};

}  // namespace dibhr::test
