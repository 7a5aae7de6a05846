// Signals through a descriptor: no handler, no global.
#include "app/window_signals.hpp"

#include <sys/signalfd.h>
#include <unistd.h>
#include <csignal>
#include <initializer_list>

namespace dibhr {

namespace {

sigset_t ending_signals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
    return signals;
}

}  // namespace

EndingSignals::EndingSignals() {
    const sigset_t signals = ending_signals();
    descriptor_ = signalfd(-1, &signals, SFD_NONBLOCK | SFD_CLOEXEC);
    if (descriptor_ >= 0) pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

EndingSignals::~EndingSignals() {
    if (descriptor_ < 0) return;
    while (arrived()) {
    }
    close(descriptor_);
    const sigset_t signals = ending_signals();
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

bool EndingSignals::arrived() {
    signalfd_siginfo one{};
    return descriptor_ >= 0 &&
           read(descriptor_, &one, sizeof one) == static_cast<ssize_t>(sizeof one);
}

}  // namespace dibhr
