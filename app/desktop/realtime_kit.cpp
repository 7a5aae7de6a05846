// Calls RealtimeKit (its interface: org.freedesktop.RealtimeKit1.xml of github.com/heftig/rtkit).
#include "app/desktop/realtime_kit.hpp"

#include <sched.h>
#include <sys/resource.h>
#include <systemd/sd-bus.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <memory>
#include <utility>

#include "app/desktop/bus.hpp"
#include "app/desktop/cancellation.hpp"
#include "core/files/plain_text.hpp"

namespace dibhr {

namespace {

constexpr const char* kRealtimeKit = "org.freedesktop.RealtimeKit1";
constexpr const char* kRealtimeKitPath = "/org/freedesktop/RealtimeKit1";

/// Threads that RealtimeKit made real-time ones; 0: a free place. dibhr has fewer at a time.
std::array<std::atomic<pid_t>, 32> granted_threads{};
static_assert(std::atomic<pid_t>::is_always_lock_free);  // a signal handler reads them

/// On SIGXCPU: one of the threads runs without a pause.
void end_priorities(int /*signal*/) {
    const int error = errno;
    const sched_param none{};
    for (const std::atomic<pid_t>& thread : granted_threads) {
        const pid_t id = thread.load(std::memory_order_relaxed);
        if (id != 0) (void)sched_setscheduler(id, SCHED_OTHER | SCHED_RESET_ON_FORK, &none);
    }
    errno = error;
}

bool has_ended(pid_t thread) {
    return thread == 0 || (tgkill(getpid(), thread, 0) != 0 && errno == ESRCH);
}

/// Before the grant: a thread that runs without a pause must be known. False: no place is free.
bool note_granted(pid_t thread) {
    const auto free = std::find_if(granted_threads.begin(), granted_threads.end(),
                                   [](const std::atomic<pid_t>& one) {
                                       return has_ended(one.load(std::memory_order_relaxed));
                                   });
    if (free == granted_threads.end()) return false;
    free->store(thread, std::memory_order_relaxed);
    struct sigaction action {};
    action.sa_handler = end_priorities;
    action.sa_flags = SA_RESTART;
    (void)sigaction(SIGXCPU, &action, nullptr);
    return true;
}

/// Limits are only lowered: a user cannot raise them again. False: refused.
bool bound_running_time(std::int64_t most_us) {
    if (most_us <= 0) return false;
    rlimit limits{};
    if (getrlimit(RLIMIT_RTTIME, &limits) != 0) return false;
    limits.rlim_max = std::min(limits.rlim_max, static_cast<rlim_t>(most_us));
    limits.rlim_cur = std::min(limits.rlim_cur, limits.rlim_max / 2);
    return setrlimit(RLIMIT_RTTIME, &limits) == 0;
}

/// Calls of RealtimeKit over one connection. A missing reply is empty.
class RealtimeKit {
  public:
    RealtimeKit(sd_bus* bus, const Cancellation& cancellation, const Deadline& latest)
        : bus_(bus), cancellation_(cancellation), latest_(latest) {}

    [[nodiscard]] bool is_connected() const {
        return run_until(bus_, cancellation_, latest_,
                         [this] { return sd_bus_is_ready(bus_) > 0; });
    }

    /// A number of this D-Bus type, "x" or "i"; 0: no reply has it.
    template <typename Number>
    Number property(const char* name, const char* type) {
        const Message call = call_of("org.freedesktop.DBus.Properties", "Get");
        if (!call || sd_bus_message_append(call.get(), "ss", kRealtimeKit, name) < 0) return 0;
        const Message reply = reply_to(call.get());
        Number value = 0;
        if (reply && sd_bus_message_enter_container(reply.get(), 'v', type) > 0)
            sd_bus_message_read(reply.get(), type, &value);
        return value;
    }

    [[nodiscard]] bool make_realtime(pid_t thread, std::uint32_t priority) {
        const Message call = call_of(kRealtimeKit, "MakeThreadRealtime");
        if (!call || sd_bus_message_append(call.get(), "tu", static_cast<std::uint64_t>(thread),
                                           priority) < 0)
            return false;
        return reply_to(call.get()) != nullptr;
    }

    /// Of the last call that failed; empty: there is no such service.
    [[nodiscard]] const std::string& error() const noexcept { return error_; }

  private:
    struct UnrefSlot {
        void operator()(sd_bus_slot* slot) const { sd_bus_slot_unref(slot); }
    };
    struct Reply {
        Message message{};

        static int on_reply(sd_bus_message* message, void* self, sd_bus_error* /*error*/) {
            static_cast<Reply*>(self)->message.reset(sd_bus_message_ref(message));
            return 1;
        }
    };

    [[nodiscard]] Message call_of(const char* interface, const char* method) const {
        sd_bus_message* made = nullptr;
        (void)sd_bus_message_new_method_call(bus_, &made, kRealtimeKit, kRealtimeKitPath, interface,
                                             method);
        return Message(made);
    }

    /// Null after an error, whose text is kept, and without a reply.
    [[nodiscard]] Message reply_to(sd_bus_message* call) {
        Reply reply;
        sd_bus_slot* made = nullptr;
        if (sd_bus_call_async(bus_, &made, call, &Reply::on_reply, &reply, UINT64_MAX) < 0)
            return nullptr;
        const std::unique_ptr<sd_bus_slot, UnrefSlot> slot(made);  // ends with `reply`
        if (!run_until(bus_, cancellation_, latest_,
                       [&reply] { return reply.message != nullptr; })) {
            error_ = "no answer";
            return nullptr;
        }
        const sd_bus_error* const error = sd_bus_message_get_error(reply.message.get());
        if (error == nullptr) return std::move(reply.message);
        if (sd_bus_error_has_name(error, SD_BUS_ERROR_SERVICE_UNKNOWN) == 0)
            error_ = one_line(error->message != nullptr ? error->message : error->name);
        return nullptr;
    }

    sd_bus* bus_;
    const Cancellation& cancellation_;
    Deadline latest_;
    std::string error_{};
};

/// Empty: the thread has no real-time priority.
std::string priority_of(pid_t thread) {
    const int policy = sched_getscheduler(thread) & ~SCHED_RESET_ON_FORK;
    sched_param parameters{};
    if ((policy != SCHED_RR && policy != SCHED_FIFO) || sched_getparam(thread, &parameters) != 0)
        return {};
    return (policy == SCHED_RR ? "SCHED_RR " : "SCHED_FIFO ") +
           std::to_string(parameters.sched_priority) + " by RealtimeKit";
}

constexpr const char* kNotThere = "it is not there";

/// Empty: granted. Else why not.
std::string refusal_of(RealtimeKit& kit, pid_t thread) {
    const auto or_not_there = [&kit] { return kit.error().empty() ? kNotThere : kit.error(); };
    if (!kit.is_connected()) return kNotThere;
    const auto most_us = kit.property<std::int64_t>("RTTimeUSecMax", "x");
    const auto highest = kit.property<std::int32_t>("MaxRealtimePriority", "i");
    if (highest <= 0) return or_not_there();
    if (!bound_running_time(most_us)) return "RLIMIT_RTTIME cannot be set";
    if (!note_granted(thread)) return "dibhr has too many threads with priority";
    if (!kit.make_realtime(thread, static_cast<std::uint32_t>(highest))) return or_not_there();
    return priority_of(thread).empty() ? "its priority is not in force" : std::string();
}

}  // namespace

Grant ask_realtime_kit(pid_t thread, const std::string& limits_file, const std::stop_token& stop,
                       std::chrono::milliseconds patience) {
    const Cancellation cancellation;
    const std::stop_callback cancel(stop, [&cancellation] { cancellation.cancel(); });
    std::string refusal = kNotThere;
    sd_bus* opened = nullptr;
    if (sd_bus_open_system(&opened) >= 0) {
        const Bus bus(opened);
        RealtimeKit kit(bus.get(), cancellation, SteadyClock::now() + patience);
        refusal = refusal_of(kit, thread);
    }
    if (refusal.empty()) return {true, priority_of(thread)};
    if (refusal == kNotThere)
        return {false, "refused: `sudo apt install rtkit` grants it at the next start"};
    return {false, "refused by RealtimeKit (" + refusal + "): `sudo cp " + limits_file +
                       " /etc/security/limits.d/` grants it at the next login"};
}

}  // namespace dibhr
