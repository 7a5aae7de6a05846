// The version of the Inverse Service.
#include "device/inverse3/service_version.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <system_error>

#include "core/files/json.hpp"
#include "core/files/plain_text.hpp"
#include "device/inverse3/service_link.hpp"

namespace dibhr::inverse3 {

namespace {

using Why = LinkError::Why;

constexpr std::chrono::milliseconds kAnswerTimeout{300};
constexpr std::array kUnits{"/usr/lib/systemd/system/haply-inverse-service.service",
                            "/lib/systemd/system/haply-inverse-service.service",
                            "/etc/systemd/system/haply-inverse-service.service"};

std::optional<ServiceVersion> version_at(std::uint16_t port) {
    try {
        const std::string text =
            http_get(port, "/version", std::chrono::steady_clock::now() + kAnswerTimeout);
        const Json answer = parsed_json(text);
        if (!answer.is_object()) return {};
        const auto version = answer.find("project_version");
        if (version == answer.end() || !version->is_string()) return {};
        return version_of(version->get_ref<const std::string&>());
    } catch (const LinkError&) {
        return {};
    }
}

}  // namespace

bool ServiceVersion::at_least(int wanted_major, int wanted_minor) const noexcept {
    return major != wanted_major ? major > wanted_major : minor >= wanted_minor;
}

std::optional<ServiceVersion> version_of(std::string_view text) {
    ServiceVersion version;
    if (text.starts_with('v')) text.remove_prefix(1);
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, version.major);
    if (first.ec != std::errc() || first.ptr == end || *first.ptr != '.') return {};
    const auto second = std::from_chars(first.ptr + 1, end, version.minor);
    if (second.ec != std::errc()) return {};
    // Shown to the user: one short line, whatever the service sends.
    version.text = one_line(text, 32);
    return version;
}

ServiceFault service_fault(const LinkError& error, const Status& status) {
    const auto version = version_of(status.version);
    const std::string service = "the Haply Inverse Service";
    if (error.why() == Why::refused && version && version->at_least(3, 1))
        return {Stage::looking, service + " (" + status.version +
                                    ") does not answer: start it again, or set port under "
                                    "[inverse3] in the settings"};
    if (error.why() == Why::refused) {
        const Stage stage = version ? Stage::too_old : Stage::looking;
        return {stage, sentence_for(stage, status)};
    }
    if (error.why() == Why::not_the_service)
        return {Stage::looking, "something else than the Haply Inverse Service answers (" +
                                    std::string(error.what()) +
                                    "): end it, or set port under [inverse3] in the settings"};
    if (error.why() == Why::too_long)
        return {Stage::not_understood, sentence_for(Stage::not_understood, status)};
    return {Stage::looking,
            service + " does not answer as it should (" + error.what() + "): start it again"};
}

std::optional<ServiceVersion> ask_version(const ConnectionOptions& options) {
    const auto version = version_at(options.port);
    return version ? version : version_at(options.older_port);
}

bool is_installed(const ConnectionOptions& options) {
    const auto is_there = [](const std::filesystem::path& file) {
        std::error_code ignored;
        return std::filesystem::exists(file, ignored);
    };
    const auto& given = options.installed_as;
    return given.empty() ? std::any_of(kUnits.begin(), kUnits.end(), is_there)
                         : std::any_of(given.begin(), given.end(), is_there);
}

}  // namespace dibhr::inverse3
