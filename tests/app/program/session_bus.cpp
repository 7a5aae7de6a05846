// dbus-daemon, and the portal's side of org.freedesktop.portal.FileChooser and .Request.
#include "tests/app/program/session_bus.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "tests/support/text.hpp"

namespace dibhr::test {

namespace {

using Clock = std::chrono::steady_clock;

std::array<int, 2> pipe_to_daemon() {
    std::array<int, 2> ends{-1, -1};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    return ends;
}

/// Without the machine's services: none is started when somebody asks for it.
std::vector<std::string> daemon_arguments(const TemporaryFolder& folder, int descriptor) {
    write_text(folder / "bus.conf",
               "<busconfig><type>session</type><listen>unix:dir=" + folder.path().string() +
                   "</listen><policy context='default'><allow send_destination='*' "
                   "eavesdrop='true'/><allow eavesdrop='true'/><allow own='*'/></policy>"
                   "</busconfig>");
    return {"dbus-daemon", "--nofork", "--config-file=" + (folder / "bus.conf").string(),
            "--print-address=" + std::to_string(descriptor)};
}

std::string line_from(int descriptor) {
    std::string line;
    for (char c = 0; ::read(descriptor, &c, 1) == 1 && c != '\n';) line += c;
    if (line.empty()) throw std::runtime_error("dbus-daemon did not start");
    return line;
}

void require_done(int result, const char* what) {
    if (result < 0) throw std::runtime_error(std::string("the test's service: ") + what);
}

}  // namespace

SessionBus::SessionBus()
    : told_(pipe_to_daemon()),
      daemon_(daemon_arguments(folder_, told_[1]), {}, folder_ / "errors.txt", told_[1]) {
    ::close(told_[1]);
    address_ = line_from(told_[0]);
    ::close(told_[0]);
}

sd_bus* SessionBus::connect() const {
    sd_bus* bus = nullptr;
    require_done(sd_bus_new(&bus), "new");
    require_done(sd_bus_set_address(bus, address_.c_str()), "address");
    require_done(sd_bus_set_bus_client(bus, 1), "client");
    require_done(sd_bus_start(bus), "start");
    return bus;
}

Portal::Portal(const SessionBus& bus, PortalManner manner)
    : manner_(std::move(manner)), bus_(bus.connect(), sd_bus_flush_close_unref) {
    require_done(sd_bus_add_filter(bus_.get(), nullptr, &on_message, this), "filter");
    require_done(sd_bus_request_name(bus_.get(), "org.freedesktop.portal.Desktop", 0), "name");
    thread_ = std::jthread([this](const std::stop_token& stop) {
        while (!stop.stop_requested()) serve();
    });
}

Portal::~Portal() {
    thread_.request_stop();
    thread_.join();
}

PortalAsked Portal::asked() const {
    const std::lock_guard lock(guard_);
    return asked_;
}

void Portal::serve() {
    constexpr std::uint64_t kLook_us = 10'000;
    while (sd_bus_process(bus_.get(), nullptr) > 0) continue;
    if (Clock::now() >= due_) answer();
    sd_bus_wait(bus_.get(), kLook_us);
}

int Portal::on_message(sd_bus_message* message, void* self, sd_bus_error* /*error*/) {
    Portal& portal = *static_cast<Portal*>(self);
    if (sd_bus_message_is_method_call(message, "org.freedesktop.portal.FileChooser", "OpenFile") >
        0)
        return portal.take_question(message);
    if (sd_bus_message_is_method_call(message, "org.freedesktop.portal.Request", "Close") > 0) {
        const std::lock_guard lock(portal.guard_);
        portal.asked_.closed = sd_bus_message_get_path(message) == portal.request_;
        portal.due_ = Clock::time_point::max();
        return 1;
    }
    return 0;
}

int Portal::take_question(sd_bus_message* call) {
    const char* parent = nullptr;
    const char* title = nullptr;
    require_done(sd_bus_message_read(call, "ss", &parent, &title), "question");
    {
        const std::lock_guard lock(guard_);
        asked_ = {.times = asked_.times + 1, .parent = parent, .title = title};
        read_options(call);
    }
    who_ = sd_bus_message_get_sender(call);
    std::string sender = who_.substr(1);
    std::replace(sender.begin(), sender.end(), '.', '_');
    request_ = "/org/freedesktop/portal/desktop/request/" + sender + "/" + token_;
    if (manner_.old) request_ += "_of_old";
    if (!manner_.replies) return 1;
    if (manner_.refuses)
        return sd_bus_reply_method_errorf(call, SD_BUS_ERROR_UNKNOWN_METHOD, "no file chooser");
    if (manner_.answers || manner_.vanishes) due_ = Clock::now();
    require_done(sd_bus_reply_method_return(call, "o", request_.c_str()), "reply");
    return 1;
}

void Portal::read_options(sd_bus_message* call) {
    require_done(sd_bus_message_enter_container(call, 'a', "{sv}"), "options");
    while (sd_bus_message_enter_container(call, 'e', "sv") > 0) {
        const char* name = nullptr;
        require_done(sd_bus_message_read(call, "s", &name), "name of an option");
        const std::string_view option = name;
        int truth = 0;
        const char* text = nullptr;
        const void* bytes = nullptr;
        std::size_t size = 0;
        if (option == "filters") {
            read_filters(call);
        } else if (option == "current_folder") {
            require_done(sd_bus_message_enter_container(call, 'v', "ay"), "folder");
            require_done(sd_bus_message_read_array(call, 'y', &bytes, &size), "folder's bytes");
            asked_.folder = static_cast<const char*>(bytes);
            require_done(sd_bus_message_exit_container(call), "folder's end");
        } else if (option == "handle_token") {
            require_done(sd_bus_message_read(call, "v", "s", &text), "token");
            token_ = text;
        } else {
            require_done(sd_bus_message_read(call, "v", "b", &truth), "truth");
            if (option == "multiple") asked_.multiple = truth != 0;
            if (option == "modal") asked_.modal = truth != 0;
        }
        require_done(sd_bus_message_exit_container(call), "end of an option");
    }
}

void Portal::read_filters(sd_bus_message* call) {
    require_done(sd_bus_message_enter_container(call, 'v', "a(sa(us))"), "filters");
    require_done(sd_bus_message_enter_container(call, 'a', "(sa(us))"), "list of filters");
    while (sd_bus_message_enter_container(call, 'r', "sa(us)") > 0) {
        const char* name = nullptr;
        require_done(sd_bus_message_read(call, "s", &name), "name of a filter");
        asked_.filters.emplace_back(name);
        require_done(sd_bus_message_enter_container(call, 'a', "(us)"), "patterns");
        std::uint32_t kind = 0;
        while (sd_bus_message_read(call, "(us)", &kind, &name) > 0)
            asked_.patterns.emplace_back(name);
        require_done(sd_bus_message_exit_container(call), "end of patterns");
        require_done(sd_bus_message_exit_container(call), "end of a filter");
    }
    require_done(sd_bus_message_exit_container(call), "end of filters");
    require_done(sd_bus_message_exit_container(call), "end of filters");
}

void Portal::answer() {
    // Who asks an old one begins to listen when it has its reply: the first answers may be missed.
    constexpr std::chrono::milliseconds kAgain{10};
    due_ = manner_.old ? Clock::now() + kAgain : Clock::time_point::max();
    if (manner_.vanishes) {
        sd_bus_release_name(bus_.get(), "org.freedesktop.portal.Desktop");
        return;
    }
    sd_bus_message* signal = nullptr;
    require_done(sd_bus_message_new_signal(bus_.get(), &signal, request_.c_str(),
                                           "org.freedesktop.portal.Request", "Response"),
                 "signal");
    require_done(sd_bus_message_set_destination(signal, who_.c_str()), "destination");
    require_done(sd_bus_message_append(signal, "u", manner_.response), "response");
    require_done(sd_bus_message_open_container(signal, 'a', "{sv}"), "results");
    require_done(sd_bus_message_append(signal, "{sv}", "choices", "a(ss)", 0), "another result");
    require_done(sd_bus_message_open_container(signal, 'e', "sv"), "uris");
    require_done(sd_bus_message_append(signal, "s", "uris"), "uris");
    require_done(sd_bus_message_open_container(signal, 'v', "as"), "uris");
    require_done(sd_bus_message_open_container(signal, 'a', "s"), "uris");
    for (const std::string& address : manner_.addresses)
        require_done(sd_bus_message_append(signal, "s", address.c_str()), "uri");
    for (int k = 0; k < 4; ++k) require_done(sd_bus_message_close_container(signal), "end");
    require_done(sd_bus_send(bus_.get(), signal, nullptr), "send");
    sd_bus_message_unref(signal);
}

}  // namespace dibhr::test
