// Opens the recording that a command line names.
#include "app/commands/given_media.hpp"

#include "app/commands/output.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

std::unique_ptr<Media> open_given(const std::filesystem::path& colour,
                                  const std::filesystem::path& depth, const TouchRequest& touch,
                                  bool must_be_sure, bool paints, TouchParameters& parameters) {
    DepthRequest request = touch.depth_request();
    request.paints = paints;
    std::unique_ptr<Media> media;
    {
        const WorkingLine line("Opening " + one_line(colour.string()));
        media = open_media(colour, depth, request);
    }
    print_warning(media->description().notice);
    report_doubt(media->description(), must_be_sure);
    touch.given.fit(media->description(), touch.raw_depth, parameters);
    return media;
}

}  // namespace dibhr
