// Reads XMP packets, the metadata of photos as RDF in XML; inside the room.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dibhr {

/// An attribute, or an element with text alone.
struct XmpProperty {
    std::string space{};  ///< namespace: "http://ns.google.com/photos/1.0/depthmap/"
    std::string name{};   ///< without prefix: "Near"
    std::string value{};
    int entry{0};  ///< number of the innermost list entry or item that holds it; 0: none
};

/// The properties of a packet in its order, at most 10000. Of damaged XML those before the damage.
[[nodiscard]] std::vector<XmpProperty> xmp_properties(std::string_view packet);

}  // namespace dibhr
