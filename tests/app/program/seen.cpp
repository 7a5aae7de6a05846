// Memory that a test and the program under test share.
#include "tests/app/program/seen.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace dibhr::test {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file) {
    throw std::system_error(errno, std::generic_category(), "cannot map " + file.string());
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const Seen& seen) {
    out << "turn " << seen.turn << ", picture " << seen.picture << " of " << seen.file.str() << ", "
        << (seen.playing ? "playing" : "paused") << " at " << seen.media_s << " s (drawn: frame "
        << seen.drawn_frame << ", " << seen.drawn_s << " s), message '" << seen.message.str()
        << "', notice '" << seen.notice.str() << "', " << seen.ticks << " ticks, "
        << (seen.contact ? "contact, " : "") << seen.spring_newton << " N, sent "
        << seen.sent_newton << " N, cut " << seen.cut << (seen.ready ? ", ready" : "")
        << (seen.mouse_fallback ? ", by mouse" : "") << (seen.opening ? ", opening" : "")
        << (seen.dialog ? ", dialog" : "") << (seen.in_front ? "" : ", not in front")
        << (seen.lead > 0 ? ", lead " + std::to_string(seen.lead) : "")
        << (seen.regions > 0 ? ", region '" + seen.region.str() + "'" : "") << ", focus '"
        << seen.focus.str() << "'";
    if (seen.replays)
        out << ", replays tick " << seen.tick << (seen.surface ? "" : " without a surface");
    if (seen.records) out << ", records " << seen.recorded_rows;
    if (seen.clip) out << ", clip " << seen.clip_s << " s";
    if (seen.study)
        out << ", study: step " << seen.study_step << " trial " << seen.trial << " interval "
            << seen.interval << (seen.waits ? ", waits" : "");
    return out;
}

// A new file is all zeros, which is a board without a picture; numbers start at zero or below.
MappedBoard::MappedBoard(const std::filesystem::path& file) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    if (descriptor < 0 || ::ftruncate(descriptor, sizeof(SeenBoard)) != 0) fail(file);
    void* const memory =
        ::mmap(nullptr, sizeof(SeenBoard), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    ::close(descriptor);
    if (memory == MAP_FAILED) fail(file);
    board_ = static_cast<SeenBoard*>(memory);
}

MappedBoard::~MappedBoard() {
    ::munmap(board_, sizeof(SeenBoard));
}

}  // namespace dibhr::test
