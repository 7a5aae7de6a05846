// Parses XMP packets by expat.
#include "core/video/formats/xmp.hpp"

#include <expat.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>

namespace dibhr {

namespace {

constexpr XML_Char kBehindNamespace = '\n';  // no namespace holds it
constexpr std::string_view kListEntry = "http://www.w3.org/1999/02/22-rdf-syntax-ns#\nli";
constexpr std::string_view kContainerItem = "\nItem";
constexpr std::size_t kMostProperties = 10000;
constexpr std::size_t kLongestNamespace = 200;
constexpr std::size_t kDeepestElement = 100;

struct XmpParserFreed {
    void operator()(XML_Parser parser) const noexcept { XML_ParserFree(parser); }
};
using XmpParser = std::unique_ptr<XML_ParserStruct, XmpParserFreed>;

struct XmpElement {
    std::string text{};
    int entry{0};
    bool text_alone{true};
};

/// The elements that are open, and the properties so far.
struct XmpReading {
    void add(std::string_view name, std::string value, int entry) {
        const auto end = name.rfind(kBehindNamespace);
        if (end == std::string_view::npos || properties.size() >= kMostProperties) return;
        properties.push_back({std::string(name.substr(0, end)), std::string(name.substr(end + 1)),
                              std::move(value), entry});
    }

    XML_Parser parser{nullptr};
    std::vector<XmpElement> open{};
    std::vector<XmpProperty> properties{};
    int entries{0};
};

XmpReading& xmp_reading(void* user) {
    return *static_cast<XmpReading*>(user);
}

void XMLCALL begin_xmp_element(void* user, const XML_Char* name, const XML_Char** attributes) {
    XmpReading& reading = xmp_reading(user);
    if (reading.open.size() >= kDeepestElement) {
        XML_StopParser(reading.parser, XML_FALSE);
        return;
    }
    XmpElement element;
    if (!reading.open.empty()) {
        reading.open.back().text_alone = false;
        element.entry = reading.open.back().entry;
    }
    const std::string_view whole = name;
    if (whole == kListEntry || whole.ends_with(kContainerItem)) element.entry = ++reading.entries;
    for (; *attributes != nullptr; attributes += 2)
        reading.add(attributes[0], attributes[1], element.entry);
    reading.open.push_back(std::move(element));
}

void XMLCALL end_xmp_element(void* user, const XML_Char* name) {
    XmpReading& reading = xmp_reading(user);
    if (reading.open.empty()) return;  // stopped
    XmpElement& element = reading.open.back();
    if (element.text_alone && !element.text.empty())
        reading.add(name, std::move(element.text), element.entry);
    reading.open.pop_back();
}

void XMLCALL take_xmp_text(void* user, const XML_Char* text, int bytes) {
    XmpReading& reading = xmp_reading(user);
    if (!reading.open.empty() && reading.open.back().text_alone)
        reading.open.back().text.append(text, static_cast<std::size_t>(bytes));
}

/// XMP has no document types; these could define entities that grow without bound.
void XMLCALL refuse_document_type(void* user, const XML_Char* /*name*/, const XML_Char* /*system*/,
                                  const XML_Char* /*known*/, int /*inside*/) {
    XML_StopParser(xmp_reading(user).parser, XML_FALSE);
}

/// Whether a namespace is longer than those of photos. Expat writes it before each name that is in
/// it, so that a packet of a megabyte could take gigabytes.
bool has_long_namespace(std::string_view packet) {
    constexpr std::string_view kDeclaration = "xmlns";  // behind a blank, as an attribute
    constexpr std::string_view kBlanks = " \t\r\n";
    for (auto at = packet.find(kDeclaration); at != std::string_view::npos;
         at = packet.find(kDeclaration, at + 1)) {
        if (at == 0 || kBlanks.find(packet[at - 1]) == std::string_view::npos) continue;
        const auto begin = packet.find_first_of("\"'", at);
        if (begin == std::string_view::npos) return false;
        const auto end = std::min(packet.find(packet[begin], begin + 1), packet.size());
        if (end - begin > kLongestNamespace) return true;
    }
    return false;
}

}  // namespace

std::vector<XmpProperty> xmp_properties(std::string_view packet) {
    // The encoding of all packets in JPEG (ISO 16684-1), whatever they state.
    const XmpParser parser(XML_ParserCreateNS("UTF-8", kBehindNamespace));
    if (parser == nullptr || packet.size() > std::size_t{std::numeric_limits<int>::max()} ||
        has_long_namespace(packet))
        return {};
    XmpReading reading;
    reading.parser = parser.get();
    XML_SetUserData(parser.get(), &reading);
    XML_SetElementHandler(parser.get(), begin_xmp_element, end_xmp_element);
    XML_SetCharacterDataHandler(parser.get(), take_xmp_text);
    XML_SetStartDoctypeDeclHandler(parser.get(), refuse_document_type);
    (void)XML_Parse(parser.get(), packet.data(), static_cast<int>(packet.size()), XML_TRUE);
    return std::move(reading.properties);
}

}  // namespace dibhr
