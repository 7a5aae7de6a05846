// `dibhr devices` and the start of the viewer with the Haply Inverse Service, simulated by the
// test.
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "core/files/plain_text.hpp"
#include "device/inverse3/simulated/service.hpp"
#include "tests/app/program/command_program.hpp"
#include "tests/support/catch.hpp"

using namespace dibhr::test;
using namespace dibhr::inverse3::simulated;

namespace {

/// A folder whose settings name the service's address.
class Home {
  public:
    explicit Home(const Service& service) {
        std::filesystem::create_directories(folder_ / "dibhr");
        write_text(folder_ / "dibhr/settings.toml",
                   "[inverse3]\nport = " + std::to_string(service.port()) +
                       "\nolder-port = " + std::to_string(service.older_port()) + "\n");
    }
    [[nodiscard]] ProgramResult run(const std::vector<std::string>& arguments) const {
        return run_dibhr(folder_, arguments);
    }

    [[nodiscard]] const TemporaryFolder& folder() const { return folder_; }

  private:
    TemporaryFolder folder_{};
};

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

struct Case {
    const char* what;
    std::function<void(Scene&)> change;
    const char* says;
    const char* next_step;
};

const std::vector<Case>& unusable() {
    static const std::vector<Case> all{
        {"no power", [](Scene& s) { s.arms[0].powered = false; }, "no power", "power adapter"},
        {"not calibrated", [](Scene& s) { s.arms[0].calibrated = false; }, "not calibrated",
         "inkwell"},
        {"in use", [](Scene& s) { s.arms[0].in_use = true; }, "in use", "end that one"},
        {"a locked Minverse",
         [](Scene& s) {
             s.arms[0].minverse = true;
             s.arms[0].ready = false;
         },
         "locked", "attach its grip"}};
    return all;
}

}  // namespace

TEST_CASE("nothing that the service says means anything to a terminal", "[inverse3][devices]") {
    const std::string hostile =
        GENERATE(as<std::string>{}, "\x1b[2J", "\x1b]0;x\a", "a\rb", "a\nfake: usable", "\x7f\b",
                 "\xC2\x9b"
                 "1m",
                 "\xE2\x80\xAE"
                 "x");
    Scene scene;
    scene.arms[0].id = hostile;
    scene.arms[0].handedness = hostile;
    scene.arms[0].preset = hostile;
    scene.grips = {Grip{.id = hostile}};
    Service service(scene);
    const ProgramResult result = Home(service).run({"devices"});
    CHECK(says(result.output, "Haply"));
    for (const std::string& text : {result.output, result.errors}) {
        CHECK_FALSE(says(text, "\nfake"));
        for (const char c : text)
            CHECK((static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t'));
        CHECK(dibhr::utf8_text(text) == text);
    }
}

TEST_CASE("an Inverse3 that can be used is told with its service and its grip",
          "[inverse3][devices]") {
    Scene scene;
    scene.grips = {Grip{.awake = false}};
    Service service(scene);
    const ProgramResult result = Home(service).run({"devices"});
    CHECK(result.exit_code == 0);
    CHECK(result.errors.empty());
    CHECK(says(result.output, "Haply Inverse Service 3.5.0"));
    CHECK(says(result.output, "Haply Inverse3 049D: usable"));
    CHECK(says(result.output, "asleep: press its button"));
    CHECK(says(result.output,
               "kept by the service for all programs, not changed by dibhr:\n"
               "    gravity compensation: on, gravity scaling factor 1\n"));
    CHECK(service.received().empty());  // nothing was driven, nothing even asked
}

TEST_CASE("an Inverse3 that cannot be used is told with its next step, and the command ends with 1",
          "[inverse3][devices]") {
    const Case& one = GENERATE(from_range(unusable()));
    Scene scene;
    one.change(scene);
    Service service(scene);
    const ProgramResult result = Home(service).run({"devices"});
    INFO(one.what << ": " << result.errors);
    CHECK(result.exit_code == 1);
    CHECK(std::count(result.errors.begin(), result.errors.end(), '\n') == 1);
    CHECK(says(result.errors, one.says));
    CHECK(says(result.errors, one.next_step));
}

TEST_CASE("without a device or a service the mouse can be used, and what to do is told",
          "[inverse3][devices]") {
    const auto [what, expected] = GENERATE(
        table<std::string, std::string>({{"no device", "has no Inverse3: plug in"},
                                         {"too old", "too old (3.0.9): install version 3.1"},
                                         {"no service", "not installed: get it from Haply"},
                                         {"nonsense", "does not understand"}}));
    Service service;
    service.with([&which = what](Scene& scene) {
        if (which == "no device") scene.arms.clear();
        if (which == "too old") scene.behaviour.version = "3.0.9";
        if (which == "no service") scene.behaviour.http_older = false;
        if (which == "nonsense") scene.behaviour.garble = Garble::cut;
    });
    if (what == "no service") service.refuse();
    const ProgramResult result = Home(service).run({"devices"});
    INFO(what << ": " << result.output);
    CHECK(result.exit_code == 0);
    CHECK(says(result.output, expected));
}

TEST_CASE("the viewer that insists on an Inverse3 ends with one line when there is none",
          "[inverse3][devices]") {
    Service service;
    const Home home(service);
    service.with([](Scene& scene) { scene.arms.clear(); });
    const ProgramResult none = home.run({"view", "--device", "inverse3"});
    CHECK(none.exit_code == 1);
    CHECK(says(none.errors, "has no Inverse3"));
    service.with([](Scene& scene) { scene.arms = {Arm{}}; });
    const ProgramResult other = home.run({"view", "--device", "inverse3:C0FFEE"});
    CHECK(other.exit_code == 1);
    CHECK(says(other.errors, "C0FFEE, but 049D"));
}

TEST_CASE("the check is of an Inverse3 that is attached, whether or not it can be used",
          "[inverse3][devices]") {
    const Case& one = GENERATE(from_range(unusable()));
    Scene scene;
    one.change(scene);
    Service service(scene);
    const ProgramResult result = Home(service).run({"devices", "--check"});
    INFO(one.what << ": " << result.errors);
    CHECK(result.exit_code == 1);
    CHECK(says(result.errors, one.says));
    CHECK(says(result.errors, one.next_step));
    CHECK(service.received().empty());
}

TEST_CASE("a file that is no firmware is refused before the check of an Inverse3, too",
          "[inverse3][devices]") {
    Service service;
    const Home home(service);
    write_text(home.folder() / "text.bin", "this is no firmware");
    const ProgramResult result = home.run({"devices", "--check", "--firmware", "text.bin"});
    CHECK(result.exit_code == 1);
    CHECK(result.output.empty());
    CHECK(says(result.errors, "nvent_firmware.bin"));
    CHECK(service.connections() == 0);
}

TEST_CASE(
    "where no Falcon is attached the check is of the Inverse3; with nobody there it asks for "
    "no force",
    "[inverse3][devices]") {
    Service service;
    const Home home(service);
    const ProgramResult result = home.run({"devices", "--check", "--out", "check.json"});
    INFO(result.errors << result.output);
    CHECK(result.exit_code == 0);
    CHECK(says(result.output, "Checks the Inverse3 049D"));
    CHECK(says(result.output, "still open"));
    const std::string record = read_text(home.folder() / "check.json");
    CHECK(says(record, "\"format\": \"dibhr inverse3 check\""));
    CHECK(says(record, "exchanges_per_s"));
    for (const ReceivedMessage& one : service.received()) CHECK_FALSE(one.drives);
}
