// Describes a session, in words and as JSON.
#include "app/commands/info_session.hpp"

#include <filesystem>
#include <initializer_list>
#include <iomanip>
#include <iostream>
#include <set>
#include <sstream>
#include <streambuf>
#include <string>

#include "core/files/json.hpp"
#include "core/files/plain_text.hpp"
#include "core/haptics/parameters.hpp"
#include "core/report/report_sentences.hpp"
#include "core/session/surface_reader.hpp"
#include "device/force_devices.hpp"

namespace dibhr {

namespace {

namespace fs = std::filesystem;

/// Prints the facts of these names in this order, and removes them from `facts`.
void print_and_drop(std::initializer_list<std::string_view> names, SessionFacts& facts) {
    for (const std::string_view name : names) {
        const auto fact = facts.find(std::string(name));
        if (fact == facts.end()) continue;
        print_fact(name, fact->second);
        facts.erase(fact);
    }
}

/// Prints duration, ticks and marks.
void print_extent(const Session& session) {
    print_fact("duration", number_text(session.end_s() - session.begin_s(), 3) + " s");
    print_fact("ticks", std::to_string(session.rows()));
    print_fact("late ticks", std::to_string(late_ticks(session.reader())));
    if (session.missing() > 0) print_fact("missing ticks", std::to_string(session.missing()));
    if (const auto begin = session.utc_at(session.begin_s()))
        print_fact("first tick", wall_time_text(*begin) + ", utc_s " + number_text(*begin, 3));
    if (const auto drift = session.drift())
        print_fact("wall clock gained", number_text(1e3 * drift->gained_s, 3) + " ms in " +
                                            number_text(drift->over_s, 1) + " s");
    const auto preview = SurfaceReader(session.reader()).preview_extent();
    if (preview.count > 0)
        print_fact("preview", std::to_string(preview.count) + " colour pictures, " +
                                  number_text(static_cast<double>(preview.bytes) / 1e6, 2) + " MB");
    for (const SessionMark& mark : session.marks()) {
        const auto utc_s = session.utc_at(mark.t_s);
        print_fact("mark", number_text(mark.t_s - session.begin_s(), 3) + " s  " + mark.tag +
                               (mark.text.empty() ? "" : ": " + mark.text) +
                               (utc_s ? "  (utc_s " + number_text(*utc_s, 3) + ")" : ""));
    }
}

/// Removes the settings of kinds of devices other than the session's.
void drop_other_devices(SessionFacts& facts) {
    const auto device = facts.find("device");
    const std::string name = device == facts.end() ? "" : device->second;
    for (const ForceDeviceKind* const kind : force_device_kinds()) {
        if (name.starts_with(kind->title)) continue;
        const std::string begin = std::string(kind->name) + '-';
        std::erase_if(facts, [&begin](const auto& fact) { return fact.first.starts_with(begin); });
    }
}

/// A long number with a fraction is rounded to six digits; the JSON has all of them.
std::string for_people(const std::string& value) {
    constexpr int kDigits = 6;
    const bool is_long = value.size() > kDigits + 2 && value.find('.') != std::string::npos;
    const auto number = is_long ? number_of_text(value) : std::nullopt;
    return number ? short_text(*number, kDigits) : value;
}

/// The most important facts first: what was touched, when and how long, with which device and which
/// parameters.
void describe_in_words(const Session& session) {
    std::cout << one_line(session.file().string()) << '\n';
    print_fact("kind", "dibhr session");
    const HandTicks hand = hand_ticks(session.reader());
    SessionFacts facts = facts_of_hand(session.facts(), hand, force_device_names());
    drop_other_devices(facts);
    for (auto& [name, value] : facts) value = for_people(value);
    std::set<fs::path> printed;
    const auto print_media = [&printed](const char* what, const SessionMedia& media) {
        if (media.file.empty() || !printed.insert(media.file).second) return;
        print_fact(what,
                   media.file.string() + (media.sha256.empty() ? "" : ", SHA-256 " + media.sha256));
    };
    for (const SessionSource& source : session.sources()) {
        print_media("colour", source.colour);
        print_media("depth", source.depth);
    }
    if (!session.sources().empty())
        for (const char* const name : {"colour", "depth"}) facts.erase(name);
    print_and_drop({"colour", "depth", "started", "participant", "note"}, facts);
    print_extent(session);
    if (const auto device = facts.find("device"); device != facts.end())
        device->second = device_text(device->second, hand);
    print_and_drop({"device"}, facts);
    visit_touch_entries([&facts](const auto& entry) { print_and_drop({entry.name}, facts); });
    print_and_drop({"bump", "material", "cleaning", "finger", "max-force", "stability"}, facts);
    for (const auto& [name, value] : facts) print_fact(name, value);
}

/// A session's extent and facts, by their names in its file.
Json json_of(const Session& session) {
    Json json{{"path", session.file().string()},
              {"form", "dibhr session"},
              {"rows", session.rows()},
              {"duration_s", session.end_s() - session.begin_s()},
              {"missing_rows", session.missing()}};
    for (const auto& [name, value] : session.facts())
        json["facts"][utf8_text(name)] = utf8_text(value);
    return json;
}

/// While it exists, standard output goes into a text.
class OutputText {
  public:
    OutputText() : before_(std::cout.rdbuf(text_.rdbuf())) {}
    ~OutputText() { std::cout.rdbuf(before_); }
    OutputText(const OutputText&) = delete;
    OutputText& operator=(const OutputText&) = delete;

    [[nodiscard]] std::string text() const { return text_.str(); }

  private:
    std::ostringstream text_{};
    std::streambuf* before_;
};

}  // namespace

void print_fact(std::string_view name, std::string_view value) {
    constexpr int kFactWidth = 17;
    std::cout << "  " << std::left << std::setw(kFactWidth) << one_line(name) << ' '
              << one_line(value) << '\n';
}

void describe_session(const Session& session, bool json) {
    if (json)
        std::cout << json_line(json_of(session)) << '\n';
    else
        describe_in_words(session);
}

SessionWork describe_in_batch(const GivenFile& file, bool json) {
    Session session(file.file);
    session.rescue_if_damaged();
    SessionWork done = summary_of(session);
    done.cells.push_back({"late_ticks", std::to_string(late_ticks(session.reader())), true});
    done.cells.push_back({"device", session.fact("device"), true});
    done.warnings.push_back(session.warning());
    const OutputText output;
    describe_session(session, json);
    done.text = output.text();
    return done;
}

}  // namespace dibhr
