// Any text of people and files is safe to show.
#include "core/files/plain_text.hpp"

#include <ostream>
#include <sstream>
#include <string>
#include <vector>

#include "core/files/terminal.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr;

TEST_CASE("no text means anything to a browser", "[files]") {
    CHECK(html_text("<script>alert(\"x\" & 'y')</script>") ==
          "&lt;script&gt;alert(&quot;x&quot; &amp; &#39;y&#39;)&lt;/script&gt;");
    CHECK(html_text("J\xC3\xBCrgen \xE2\x82\xAC \xF0\x9F\x96\x90") ==
          "J\xC3\xBCrgen \xE2\x82\xAC \xF0\x9F\x96\x90");
}

TEST_CASE("words are runs of letters and digits, in small letters", "[files]") {
    CHECK(plain_words_of("Timestamp [ns]") == std::vector<std::string>{"timestamp", "ns"});
    CHECK(plain_words_of("_take2__RGBD_") == std::vector<std::string>{"take2", "rgbd"});
    CHECK(plain_words_of(" - ").empty());
}

TEST_CASE("bytes that are no letters are replaced one by one", "[files]") {
    const std::string mark = "\xEF\xBF\xBD";
    CHECK(utf8_text("a\xFF"
                    "b") == "a" + mark + "b");
    CHECK(utf8_text("\xC3") == mark);
    CHECK(utf8_text("\xC0\xAF") == mark + mark);                     // too long for a slash
    CHECK(utf8_text("\xED\xA0\x80") == mark + mark + mark);          // half of a pair of UTF-16
    CHECK(utf8_text("\xF4\x90\x80\x80").size() == 4 * mark.size());  // beyond Unicode
    CHECK(utf8_text(std::string("a\0b\x1B[1m\n", 8)) == "a" + mark + "b" + mark + "[1m\n");
}

TEST_CASE("a text is shown on one line, cut short where it is too long", "[files]") {
    CHECK(one_line("J\xC3\xBCrgen\n2", 20) == "J\xC3\xBCrgen 2");
    CHECK(one_line("a long name of a file", 10) == "a long n..");
}

TEST_CASE("a bare name is of letters, digits, - and _ alone", "[files]") {
    CHECK(is_bare_name("Depth-pro_2"));
    for (const char* name : {"", "a b", "a.b", "J\xC3\xBCrgen"}) CHECK_FALSE(is_bare_name(name));
}

TEST_CASE("an escaped text is all there, and no two look the same", "[files]") {
    CHECK(escaped_text("env -C ~/x run \"a b\"") == "env -C ~/x run \"a b\"");
    CHECK(escaped_text(std::string("\0\x1b\x7f\n", 4)) == "\\x00\\x1b\\x7f\\x0a");
    CHECK(escaped_text("a\\x1b") == "a\\\\x1b");
    CHECK(escaped_text("a   b ") == "a \\x20\\x20b ");
    CHECK(escaped_text("\xE2\x80\xAE\xD0\x85") == "\\xe2\\x80\\xae\\xd0\\x85");
}

TEST_CASE("a path in an address keeps its letters, whatever they mean there", "[files]") {
    CHECK(percent_encoded("/a b/50%?#\xc3\xbc.db3") == "/a%20b/50%25%3f%23%c3%bc.db3");
    std::string all;
    for (int byte = 0; byte < 256; ++byte) all += static_cast<char>(byte);
    CHECK(percent_decoded(percent_encoded(all)) == all);
    CHECK(percent_decoded("100%, %4, %zz, %2F%e4") == "100%, %4, %zz, /\xe4");
}

TEST_CASE("base64 gives the standard's own examples", "[files]") {  // RFC 4648, section 10
    CHECK(base64_text("") == "");
    CHECK(base64_text("f") == "Zg==");
    CHECK(base64_text("fo") == "Zm8=");
    CHECK(base64_text("foo") == "Zm9v");
    CHECK(base64_text("foob") == "Zm9vYg==");
    CHECK(base64_text("fooba") == "Zm9vYmE=");
    CHECK(base64_text("foobar") == "Zm9vYmFy");
    CHECK(base64_text("\xFF\xFE") == "//4=");
    for (const char* bytes : {"", "f", "fo", "foo", "foob", "fooba", "foobar", "\xFF\xFE"})
        CHECK(bytes_of_base64(base64_text(bytes)) == bytes);
    CHECK(bytes_of_base64(" Zm9v\n YmFy ") == "foobar");
    CHECK(bytes_of_base64("Zm9v*mFy").empty());
}

TEST_CASE("nothing that is printed means anything to a terminal", "[files]") {
    // What a device, a service or a file may be called.
    const std::string hostile = GENERATE(
        as<std::string>{}, "\x1b[31mred", "\x1b[2J", "\x1b]0;title\a", "\x1b]8;;http://x\x1b\\link",
        "\x1b[8mhidden", "\x1b[1;1H", "\x1bP1$r\x1b\\", "\x1b[6n", "\x1b[?1049h", "\x1b",
        "good\rbad", "a\b\b\bc", "\x7f", "\a\a", "\v\f",
        "\x9b"
        "31m",
        "\xC2\x9b"
        "31m",
        "\xE2\x80\xAE"
        "txt.exe",
        "\xE2\x81\xA6x", std::string("a\0b", 3), "\xff\xfe", "\x0e\x0f", "\x1b[1", "\x1b[0;5m",
        "\x1b"
        "c",
        "\xC2");
    std::ostringstream printed;
    {
        const PlainOutput plain(printed);
        std::ostream& out = printed;
        out << "name: " << hostile << '\n' << hostile.substr(0, 1) << std::flush;
        out << hostile.substr(1);
        for (const char c : hostile) out.put(c);
    }
    const std::string text = printed.str();
    CHECK(text.starts_with("name: "));
    for (const char c : text)
        CHECK((static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t'));
    CHECK(utf8_text(text) == text);
}

TEST_CASE("what is printed plainly stays as it is, headings included", "[files]") {
    const std::string text = "\x1b[1mUsage:\x1b[0m a\tb\nJ\xC3\xBCrgen \xE6\x97\xA5\n";
    std::ostringstream printed;
    {
        const PlainOutput plain(printed);
        printed << text << 12 << std::endl;
    }
    CHECK(printed.str() == text + "12\n");
    printed << '\r';
    CHECK(printed.str().ends_with('\r'));
}
