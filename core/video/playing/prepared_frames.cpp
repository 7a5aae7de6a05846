// Gives up a damaged surface.
#include "core/video/playing/prepared_frames.hpp"

#include "core/error.hpp"

namespace dibhr {

void PreparedFrames::turn_off() noexcept {
    on_ = false;
    surface_.reset();
}

void PreparedFrames::look(const MediaDescription& media, const CleaningOptions& cleaning) {
    if (!on_ || looked_for_ == cleaning) return;
    looked_for_ = cleaning;
    surface_.reset();
    try {
        surface_ = find_prepared(media, cleaning);
    } catch (const InputError& error) {
        trouble_ = error.what();
        turn_off();
    }
}

bool PreparedFrames::fill(Frame& frame) {
    if (!surface_) return false;
    try {
        if (surface_->reader.fill(frame)) return true;
    } catch (const InputError& error) {
        trouble_ = error.what();
        drop_prepared(*surface_);
    }
    turn_off();
    return false;
}

}  // namespace dibhr
