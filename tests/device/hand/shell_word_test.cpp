// A path as a word of a shell.
#include "device/hand/shell_word.hpp"

#include "tests/support/catch.hpp"

using dibhr::shell_word;

TEST_CASE("a path stays one word of a shell, and is in quotation marks only where it has to be",
          "[hand]") {
    CHECK(shell_word("/usr/lib/udev/rules.d/70-dibhr.rules") ==
          "/usr/lib/udev/rules.d/70-dibhr.rules");
    CHECK(shell_word("/home/my own/a$b") == "'/home/my own/a$b'");
    CHECK(shell_word("it's") == "'it'\\''s'");
    CHECK(shell_word("") == "''");
}
