// The file chooser of the desktop's portal (XDG Desktop Portal, org.freedesktop.portal.FileChooser
// and .Request): called over the session bus; its answer is a signal.
#include <systemd/sd-bus.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "app/desktop/bus.hpp"
#include "app/desktop/file_dialog.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr const char* kPortal = "org.freedesktop.portal.Desktop";
constexpr const char* kPortalPath = "/org/freedesktop/portal/desktop";
constexpr const char* kChooser = "org.freedesktop.portal.FileChooser";
constexpr const char* kRequest = "org.freedesktop.portal.Request";
constexpr const char* kToken = "dibhr";  // the same for all: each has its own connection
constexpr const char* kPortalLost =
    "type='signal',sender='org.freedesktop.DBus',member='NameOwnerChanged',"
    "arg0='org.freedesktop.portal.Desktop',arg2=''";

/// Decodes "file:///home/me/a%20film.mp4"; returns other addresses unchanged.
std::filesystem::path path_of(const std::string& address) {
    constexpr std::string_view kFile = "file://";
    if (!address.starts_with(kFile)) return address;
    const std::size_t path = address.find('/', kFile.size());  // behind the machine's name
    if (path == std::string::npos) return address;
    return percent_decoded(std::string_view(address).substr(path));
}

/// The state of one request to the portal; its static members are the bus's callbacks.
struct PortalRequest {
    std::string request{};  ///< the path of its object
    bool accepted{false}, refused{false}, answered{false},
        portal_lost{false};     ///< gone: the portal
    std::uint32_t response{0};  ///< 0: chosen, 1: cancelled, 2: ended in another way
    std::vector<std::filesystem::path> files{};

    static int on_reply(sd_bus_message* reply, void* self, sd_bus_error* /*error*/) {
        auto& question = *static_cast<PortalRequest*>(self);
        const char* path = nullptr;
        question.accepted = sd_bus_message_is_method_error(reply, nullptr) == 0 &&
                            sd_bus_message_read(reply, "o", &path) > 0;
        question.refused = !question.accepted;
        if (question.refused || question.request == path) return 0;
        question.request = path;  // of portals before version 0.9
        question.refused = !question.listen(sd_bus_message_get_bus(reply));
        return 0;
    }

    static int on_portal_lost(sd_bus_message* /*signal*/, void* self, sd_bus_error* /*error*/) {
        static_cast<PortalRequest*>(self)->portal_lost = true;
        return 0;
    }

    /// Subscribes to the answer, a signal of the object `request`.
    bool listen(sd_bus* bus) {
        return sd_bus_match_signal_async(bus, nullptr, nullptr, request.c_str(), kRequest,
                                         "Response", &on_response, nullptr, this) >= 0;
    }

    static int on_response(sd_bus_message* signal, void* self, sd_bus_error* /*error*/) {
        auto& question = *static_cast<PortalRequest*>(self);
        question.answered = true;
        if (sd_bus_message_read(signal, "u", &question.response) < 0) question.response = 2;
        question.read_files(signal);
        return 0;
    }

    /// Reads "uris" of the results.
    void read_files(sd_bus_message* signal) {
        if (sd_bus_message_enter_container(signal, 'a', "{sv}") <= 0) return;
        while (sd_bus_message_enter_container(signal, 'e', "sv") > 0) {
            const char* name = nullptr;
            const bool read = sd_bus_message_read(signal, "s", &name) > 0;
            if (read && std::string_view(name) == "uris") {
                read_addresses(signal);
            } else {
                sd_bus_message_skip(signal, "v");
            }
            if (sd_bus_message_exit_container(signal) < 0) return;
        }
    }

    void read_addresses(sd_bus_message* signal) {
        if (sd_bus_message_enter_container(signal, 'v', "as") <= 0) return;
        if (sd_bus_message_enter_container(signal, 'a', "s") < 0) return;
        const char* address = nullptr;
        while (sd_bus_message_read(signal, "s", &address) > 0) files.push_back(path_of(address));
        sd_bus_message_exit_container(signal);
        sd_bus_message_exit_container(signal);
    }
};

/// The path the request object will have. Known before the call, so that no answer is missed.
std::string expected_request(sd_bus* bus) {
    const char* name = nullptr;
    if (sd_bus_get_unique_name(bus, &name) < 0) return {};
    std::string sender(name + 1);  // ":1.42"
    std::replace(sender.begin(), sender.end(), '.', '_');
    return std::string(kPortalPath) + "/request/" + sender + "/" + kToken;
}

int append_filter(sd_bus_message* call, const FileFilter& filter) {
    constexpr std::uint32_t kPattern = 0;
    int failed = sd_bus_message_open_container(call, 'r', "sa(us)");
    failed = std::min(failed, sd_bus_message_append(call, "s", filter.name.c_str()));
    failed = std::min(failed, sd_bus_message_open_container(call, 'a', "(us)"));
    for (const std::string& pattern : filter.patterns)
        failed = std::min(failed, sd_bus_message_append(call, "(us)", kPattern, pattern.c_str()));
    failed = std::min(failed, sd_bus_message_close_container(call));
    return std::min(failed, sd_bus_message_close_container(call));
}

int append_filters(sd_bus_message* call, const FileQuestion& question) {
    int failed = sd_bus_message_open_container(call, 'e', "sv");
    failed = std::min(failed, sd_bus_message_append(call, "s", "filters"));
    failed = std::min(failed, sd_bus_message_open_container(call, 'v', "a(sa(us))"));
    failed = std::min(failed, sd_bus_message_open_container(call, 'a', "(sa(us))"));
    for (const FileFilter& filter : question.filters)
        failed = std::min(failed, append_filter(call, filter));
    for (int k = 0; k < 3; ++k) failed = std::min(failed, sd_bus_message_close_container(call));
    return failed;
}

/// As bytes with a final zero, as the portal expects.
int append_folder(sd_bus_message* call, const std::filesystem::path& folder) {
    int failed = sd_bus_message_open_container(call, 'e', "sv");
    failed = std::min(failed, sd_bus_message_append(call, "s", "current_folder"));
    failed = std::min(failed, sd_bus_message_open_container(call, 'v', "ay"));
    failed = std::min(
        failed, sd_bus_message_append_array(call, 'y', folder.c_str(), folder.native().size() + 1));
    for (int k = 0; k < 2; ++k) failed = std::min(failed, sd_bus_message_close_container(call));
    return failed;
}

/// Not modal, so that the force can be switched off in the window meanwhile.
int append_options(sd_bus_message* call, const FileQuestion& question) {
    int failed = sd_bus_message_open_container(call, 'a', "{sv}");
    failed = std::min(failed, sd_bus_message_append(call, "{sv}", "handle_token", "s", kToken));
    failed = std::min(failed, sd_bus_message_append(call, "{sv}", "multiple", "b", 1));
    failed = std::min(failed, sd_bus_message_append(call, "{sv}", "modal", "b", 0));
    failed = std::min(failed, append_filters(call, question));
    failed = std::min(failed, append_folder(call, question.folder));
    return std::min(failed, sd_bus_message_close_container(call));
}

std::string parent_of(const FileQuestion& question) {
    if (question.x11_window == 0) return {};
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "x11:%lx", question.x11_window);
    return text.data();
}

/// Sends the call; on_reply() gets its reply, or an error after `patience`.
bool send_question(sd_bus* bus, const FileQuestion& question, std::chrono::microseconds patience,
                   PortalRequest& portal_request) {
    sd_bus_message* made = nullptr;
    if (sd_bus_message_new_method_call(bus, &made, kPortal, kPortalPath, kChooser, "OpenFile") < 0)
        return false;
    const Message call(made);
    int failed =
        sd_bus_message_append(made, "ss", parent_of(question).c_str(), question.title.c_str());
    failed = std::min(failed, append_options(made, question));
    return failed >= 0 &&
           sd_bus_call_async(bus, nullptr, made, &PortalRequest::on_reply, &portal_request,
                             static_cast<std::uint64_t>(patience.count())) >= 0;
}

/// Also if the portal has not replied: it may only be slow.
void close_request(sd_bus* bus, const PortalRequest& portal_request) {
    sd_bus_message* made = nullptr;
    if (sd_bus_message_new_method_call(bus, &made, kPortal, portal_request.request.c_str(),
                                       kRequest, "Close") < 0)
        return;
    const Message call(made);
    sd_bus_message_set_expect_reply(made, 0);
    sd_bus_message_set_auto_start(made, 0);
    if (sd_bus_send(bus, made, nullptr) >= 0) sd_bus_flush(bus);
}

FileAnswer answer_of(PortalRequest& portal_request, bool at_once) {
    if (portal_request.response == 0 && !portal_request.files.empty())
        return {FileAnswer::Outcome::chosen, std::move(portal_request.files)};
    // A dialog that a person closes may also end "in another way".
    const bool refused = portal_request.response != 1 && at_once;
    return {refused ? FileAnswer::Outcome::unavailable : FileAnswer::Outcome::cancelled};
}

/// Sends the request and waits for the person. False: there is no answer.
bool wait_for_answer(sd_bus* bus, const FileQuestion& question, const Cancellation& cancellation,
                     const DialogTimeouts& timeouts, PortalRequest& portal_request) {
    const auto ready = [bus] { return sd_bus_is_ready(bus) > 0; };
    if (!run_until(bus, cancellation, SteadyClock::now() + timeouts.bus, ready)) return false;
    portal_request.request = expected_request(bus);
    const bool sent =
        sd_bus_add_match_async(bus, nullptr, kPortalLost, &PortalRequest::on_portal_lost, nullptr,
                               &portal_request) >= 0 &&
        portal_request.listen(bus) && send_question(bus, question, timeouts.portal, portal_request);
    const auto replied = [&portal_request] {
        return portal_request.accepted || portal_request.refused || portal_request.answered;
    };
    const auto ended = [&portal_request] {
        return portal_request.answered || portal_request.refused || portal_request.portal_lost;
    };
    return sent && run_until(bus, cancellation, SteadyClock::now() + timeouts.portal, replied) &&
           run_until(bus, cancellation, {}, ended) && portal_request.answered;
}

}  // namespace

FileAnswer ask_portal(const FileQuestion& question, const Cancellation& cancellation,
                      const DialogTimeouts& timeouts) {
    sd_bus* opened = nullptr;
    if (sd_bus_open_user(&opened) < 0) return {};
    const Bus bus(opened);
    const auto begin = SteadyClock::now();
    PortalRequest portal_request;
    if (wait_for_answer(bus.get(), question, cancellation, timeouts, portal_request))
        return answer_of(portal_request,
                         SteadyClock::now() - begin < timeouts.shortest_human_reply);
    if (!portal_request.request.empty() && !portal_request.portal_lost)
        close_request(bus.get(), portal_request);
    return {cancellation.is_cancelled() ? FileAnswer::Outcome::cancelled
                                        : FileAnswer::Outcome::unavailable};
}

}  // namespace dibhr
