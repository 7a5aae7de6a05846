// How the plots look: colours that a colour-blind reader tells apart, and each algorithm's line and
// marker.
#include "core/plot/style.hpp"

namespace dibhr {
namespace {

// Okabe and Ito, "Color Universal Design" (2008): told apart by every common kind of colour vision.
constexpr Ink kBlue{0, 114, 178};
constexpr Ink kVermillion{213, 94, 0};
constexpr Ink kGreen{0, 158, 115};
constexpr Ink kPurple{204, 121, 167};

}  // namespace

SeriesLook look_of(Algorithm algorithm) {
    switch (algorithm) {
        case Algorithm::dibhr:
            return {"DIBHR", {kBlue, 2.5, Dash::solid}, Marker::circle};
        case Algorithm::pga:
            return {"PGA (proxy graph)", {kVermillion, 2.0, Dash::dashed}, Marker::triangle};
        case Algorithm::neighborhood:
            return {"Neighborhood", {kGreen, 2.0, Dash::dash_dot}, Marker::diamond};
        case Algorithm::god_object:
            return {"God-object", {kPurple, 2.5, Dash::dotted}, Marker::square};
    }
    return {};
}

SeriesLook look_of_exact() {
    return {"exact answer", {kExactInk, 7.0, Dash::solid}, Marker::none};
}

SeriesLook look_of_goal() {
    return {"goal (the hand)", {kGoalInk, 1.5, Dash::dotted}, Marker::none};
}

void draw_legend(Canvas& canvas, Vec2 corner, const std::vector<SeriesLook>& entries) {
    constexpr double kRow_px = 26.0;
    constexpr double kSample_px = 46.0;
    const TextStyle style{kTextInk, kLabelCap_px};
    double y = corner.y + kRow_px / 2.0;
    for (const SeriesLook& entry : entries) {
        canvas.line({corner.x, y}, {corner.x + kSample_px, y}, entry.stroke);
        canvas.marker({corner.x + kSample_px / 2.0, y}, entry.marker, 10.0, entry.stroke.ink,
                      kPaper);
        canvas.text({corner.x + kSample_px + 12.0, y + style.cap_px / 2.0}, entry.name, style);
        y += kRow_px;
    }
}

void draw_title(Canvas& canvas, const std::string& title, const std::string& settings) {
    constexpr double kLeft_px = 36.0;
    canvas.text({kLeft_px, 38.0}, title, {kTextInk, kTitleCap_px, Align::left, true});
    canvas.text({kLeft_px, 64.0}, settings, {kQuietInk, kLabelCap_px});
}

}  // namespace dibhr
