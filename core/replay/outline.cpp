// Sums up the contacts of a session.
#include "core/replay/outline.hpp"

#include <algorithm>
#include <chrono>

#include "core/error.hpp"
#include "core/session/session.hpp"

namespace dibhr {

namespace {

std::unique_ptr<ContactBand> read_band(const std::filesystem::path& file, double begin_s,
                                       double end_s, const std::atomic<bool>& leaving) {
    auto band = std::make_unique<ContactBand>();
    const double pieces_per_s =
        static_cast<double>(ContactBand::kPieces) / std::max(end_s - begin_s, 1e-3);
    const SessionReader reader(file);
    SessionReader::Query query(reader,
                               "SELECT t, contact, stand_in FROM tick WHERE surface ORDER BY tick");
    while (!leaving && query.next()) {
        ++band->hand.all;
        band->hand.stand_in += query.integer(2);
        if (query.integer(1) == 0) continue;
        const double at = std::max(0.0, (query.real(0) - begin_s) * pieces_per_s);
        band->contact.at(std::min(static_cast<std::size_t>(at), ContactBand::kPieces - 1)) = true;
    }
    return band;
}

}  // namespace

SessionOutline::SessionOutline(const std::filesystem::path& file, double begin_s, double end_s)
    : result_(std::async(std::launch::async, [this, file, begin_s, end_s] {
          return read_band(file, begin_s, end_s, leaving_);
      })) {}

SessionOutline::~SessionOutline() {
    leaving_ = true;
    if (result_.valid()) result_.wait();
}

const ContactBand* SessionOutline::band() {
    using std::chrono::seconds;
    if (result_.valid() && result_.wait_for(seconds(0)) == std::future_status::ready) {
        try {
            band_ = result_.get();
        } catch (const InputError&) {
            return nullptr;  // the player meets the same damage and tells
        }
    }
    return band_.get();
}

}  // namespace dibhr
