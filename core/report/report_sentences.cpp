// The report's sentences.
#include "core/report/report_sentences.hpp"

#include <algorithm>
#include <cstddef>
#include <ctime>

#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

double median_length_s(const std::vector<Episode>& episodes) {
    std::vector<double> lengths;
    for (const Episode& episode : episodes) lengths.push_back(episode.length_s());
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle;
}

double longest_s(const std::vector<Episode>& episodes) {
    double longest = 0.0;
    for (const Episode& episode : episodes) longest = std::max(longest, episode.length_s());
    return longest;
}

std::string times(std::size_t count) {
    return count == 1 ? "once" : count == 2 ? "twice" : std::to_string(count) + " times";
}

/// "0.31 m" or "4.2 mm".
std::string distance_text(double mm) {
    return mm >= 1000.0 ? number_text(mm / 1000.0, 2) + " m" : number_text(mm, 1) + " mm";
}

std::string milliseconds(double seconds) {
    return number_text(1000.0 * seconds, 0) + " ms";
}

}  // namespace

std::string percent_text(double share) {
    return number_text(100.0 * share, share < 0.0995 ? 1 : 0) + " %";
}

std::string counted(std::int64_t count, const std::string& thing) {
    return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

std::string wall_time_text(double utc_s) {
    if (!(utc_s > 0.0) || utc_s > 1e11) return {};
    const auto seconds = static_cast<std::time_t>(utc_s);
    std::tm parts{};
    if (gmtime_r(&seconds, &parts) == nullptr) return {};
    char text[64];
    std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S UTC", &parts);
    return text;
}

std::string summary_of(const SessionReport& report) {
    const SessionNumbers& numbers = report.numbers;
    const std::string participant = report.session.fact("participant");
    const std::string who = participant.empty() ? "the hand" : participant;
    const std::string begin = "In " + number_text(numbers.duration_s, 1) + " s, " + who;
    if (numbers.episodes.empty()) return begin + " never touched the surface.";
    std::string text = begin + " touched " + times(numbers.episodes.size()) + " for " +
                       number_text(numbers.contact_s, 1) + " s in all (" +
                       percent_text(numbers.contact_share()) + " of the ticks). ";
    if (numbers.episodes.size() > 1)
        text += "Half of the contacts lasted " + number_text(median_length_s(numbers.episodes), 2) +
                " s or longer, the longest " + number_text(longest_s(numbers.episodes), 2) + " s. ";
    text += "While touching, the force sent to the hand was " +
            number_text(numbers.sent_newton.mean(), 2) + " N on average and " +
            number_text(numbers.sent_newton.peak(), 2) +
            " N at its peak, and the point on the surface went " + distance_text(path_mm(numbers));
    if (numbers.contact_s > 0.0)
        text += ", " + number_text(path_mm(numbers) / numbers.contact_s, 1) + " mm/s on average";
    return text + ".";
}

std::vector<std::string> remarks_of(const SessionReport& report) {
    const TickCounts& ticks = report.numbers.ticks;
    std::vector<std::string> remarks;
    const auto say = [&](std::int64_t count, const std::string& what) {
        if (count > 0) remarks.push_back(counted(count, "tick") + what);
    };
    if (report.session.fact("complete") == "0")
        remarks.emplace_back(
            "The recording was broken off, or still goes on: this is what was written so far.");
    const bool damaged = report.session.is_damaged();
    if (damaged)
        remarks.push_back("The recording is damaged: " + report.session.fact(kDamageFact) + ".");
    say(damaged ? 0 : ticks.missing, " between the first and the last were not recorded.");
    say(ticks.without_surface, " had no surface to touch.");
    say(ticks.device_not_ready, " had no device that was ready.");
    say(hand_of(ticks).is_mouse_only() ? 0 : ticks.mouse_fallback,
        " were moved by the mouse, because the device was not ready.");
    say(ticks.goal_refused,
        " had a place of the hand that was no number; the place before it was used.");
    say(ticks.catching_up, " ended before the proxy had caught up with its goal.");
    say(ticks.late, " began late, a millisecond or more after the deadline; the worst " +
                        number_text(ticks.worst_lateness_us / 1000.0, 1) + " ms.");
    for (std::size_t cut = 1; cut < ticks.cut.size(); ++cut)
        say(ticks.cut[cut],
            std::string(" had the force cut: ") + name_of(static_cast<SafetyCut>(cut)) + ".");
    for (const HeatMapFacts& map : report.maps) {
        if (!map.remark.empty())
            remarks.push_back("A heat map lies over plain ground: " + map.remark + ".");
    }
    remarks.insert(remarks.end(), report.remarks.begin(), report.remarks.end());
    return remarks;
}

std::vector<Definition> definitions() {
    return {
        {"Time",
         "Seconds since the first recorded tick. A tick stands for the time until the next one, " +
             milliseconds(kLongestTick_s) + " at most."},
        {"Contact",
         "A tick whose proxy (the point kept on the surface) touches it. Their share is "
         "of all recorded ticks, also of those without a surface."},
        {"Episode",
         "Begins with the first tick in contact and ends with the last. Gaps shorter than " +
             milliseconds(kJoinedGap_s) +
             " are joined. It also ends when the hand lets go or another video comes. "
             "Its length includes joined gaps, its contact time does not."},
        {"Force sent",
         "Length of the force that went to the device, after the safety stage [N]. "
         "Means are over the time in contact, peaks over single ticks."},
        {"Spring force", "Length of the force between hand and proxy before the safety stage [N]."},
        {"Path",
         "Sum of the proxy's steps from tick to tick in contact, in three dimensions, "
         "pixels times the pixel pitch [mm]; a surface that moves under a resting hand "
         "counts. Mean speed: path over contact time."},
        {"Speed", "Distance between now and " + milliseconds(kSpeedWindow_s) +
                      " ago over the time between [mm/s], while in contact; none in the first " +
                      milliseconds(kSpeedWindow_s) + " after a jump."},
        {"Place",
         "Pixels of the depth image, column and row from the upper left. An episode's "
         "is the mean of the proxy's places, by time."},
        {"Primitive",
         "What the proxy rested on: share of the contact time on a triangle, an edge "
         "and a vertex of the depth surface."},
        {"Heat map",
         "Contact time of each pixel of the depth image, spread by the Gaussian that "
         "is named, on a logarithmic scale over two powers of ten; less is not "
         "coloured. The picture is the frame that was touched longest."},
        {"Over time",
         "In long sessions a point of a line stands for several ticks: lowest and "
         "highest of them are drawn, so that no peak is lost."},
        {"Median, 95 %",
         "By time in contact: half, and 95 %, of it was below. To 0.001 N and 0.1 mm/s."},
        {"Late", "A tick that began a whole period (1 ms) or more after its deadline."},
    };
}

std::string device_text(const std::string& device, const HandTicks& hand) {
    if (hand.mouse_fallback <= 0) return device;
    if (hand.is_mouse_only()) return "mouse";
    constexpr double kLeast = 0.1;  // percent; not none, and not all
    const double percent =
        100.0 * static_cast<double>(hand.mouse_fallback) / static_cast<double>(hand.all);
    return device + "; the mouse replaced it for " +
           number_text(std::clamp(percent, kLeast, 100.0 - kLeast), 1) + " % of the ticks";
}

HandTicks hand_of(const TickCounts& ticks) {
    return {ticks.all - ticks.without_surface, ticks.mouse_fallback};
}

SessionFacts facts_of_hand(SessionFacts facts, const HandTicks& hand,
                           const std::vector<std::string>& kinds) {
    if (!hand.is_mouse_only()) return facts;
    std::erase_if(facts, [&kinds](const auto& fact) {
        const auto begins_with = [&fact](const std::string& kind) {
            return fact.first.starts_with(kind + "-");
        };
        return begins_with("device") || std::any_of(kinds.begin(), kinds.end(), begins_with);
    });
    if (const auto device = facts.find("device"); device != facts.end()) device->second = "mouse";
    return facts;
}

}  // namespace dibhr
