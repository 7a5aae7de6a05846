// Where the files are that a session names.
#include "core/session/media_places.hpp"

namespace dibhr {

std::array<std::filesystem::path, 2> places_of(const SessionMedia& media,
                                               const std::filesystem::path& session) {
    const std::filesystem::path folder = std::filesystem::absolute(session).parent_path();
    return {(folder / media.file).lexically_normal(), folder / media.file.filename()};
}

}  // namespace dibhr
