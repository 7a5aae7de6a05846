// Signals through a descriptor, without a global.
#include "app/window/signals.hpp"

#include <sys/signalfd.h>
#include <ucontext.h>
#include <unistd.h>
#include <array>
#include <csignal>

namespace dibhr {

namespace {

// Ctrl+Z would leave the last force in a device's motors, so SIGTSTP is blocked, too.
constexpr std::array kBlockedSignals{SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP};

sigset_t blocked_signals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : kBlockedSignals) sigaddset(&signals, signal);
    return signals;
}

/// Runs only in a thread that a preloaded library started before us, with no signal blocked: blocks
/// this signal in that thread, and sends it again, so that the descriptor gets it.
void block_and_resend(int signal, siginfo_t*, void* context) {
    sigaddset(&static_cast<ucontext_t*>(context)->uc_sigmask, signal);
    kill(getpid(), signal);
}

void catch_in_other_threads() {
    struct sigaction action {};
    action.sa_sigaction = block_and_resend;
    action.sa_flags = SA_SIGINFO | SA_RESTART;
    action.sa_mask = blocked_signals();
    for (const int signal : kBlockedSignals) {
        struct sigaction before {};
        sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);  // nohup
    }
}

}  // namespace

ShutdownSignals::ShutdownSignals() {
    const sigset_t signals = blocked_signals();
    descriptor_ = signalfd(-1, &signals, SFD_NONBLOCK | SFD_CLOEXEC);
    if (descriptor_ < 0) return;
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    catch_in_other_threads();
}

ShutdownSignals::~ShutdownSignals() {
    if (descriptor_ < 0) return;
    while (arrived()) {
    }
    close(descriptor_);
    for (const int signal : kBlockedSignals)
        if (std::signal(signal, SIG_DFL) == SIG_IGN) std::signal(signal, SIG_IGN);
    const sigset_t signals = blocked_signals();
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

bool ShutdownSignals::arrived() {
    signalfd_siginfo one{};
    while (descriptor_ >= 0 &&
           read(descriptor_, &one, sizeof one) == static_cast<ssize_t>(sizeof one)) {
        if (one.ssi_signo != SIGTSTP) return true;
    }
    return false;
}

}  // namespace dibhr
