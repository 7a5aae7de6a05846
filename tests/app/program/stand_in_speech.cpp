// A stand-in for libspeechd, loaded by its name in place of it: writes a line for each call into
// the file that DIBHR_SPOKEN names, each with the steady clock's seconds.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace {

void write_line(const char* call, const char* text) {
    const char* const name = std::getenv("DIBHR_SPOKEN");
    if (name == nullptr) return;
    std::FILE* const file = std::fopen(name, "a");
    if (file == nullptr) return;
    const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
    std::fprintf(file, "%.6f %s %s\n", now.count(), call, text);
    std::fclose(file);
}

}  // namespace

extern "C" {

/// DIBHR_NO_SPEECH set: no daemon answers.
void* spd_open(const char* client, const char* /*connection*/, const char* /*user*/, int /*mode*/) {
    static int connection = 0;
    if (std::getenv("DIBHR_NO_SPEECH") != nullptr) return nullptr;
    write_line("open", client);
    return &connection;
}

/// DIBHR_SPEECH_HANGS set: it never returns.
int spd_say(void* /*connection*/, int /*priority*/, const char* text) {
    write_line("say", text);
    while (std::getenv("DIBHR_SPEECH_HANGS") != nullptr) ::pause();
    return 1;
}

int spd_cancel(void* /*connection*/) {
    write_line("cancel", "");
    return 0;
}

void spd_close(void* /*connection*/) {
    write_line("close", "");
}
}
