// Declares what is used of libspeechd, loads it, and hands it the newest text.
#include "app/sound/speaker.hpp"

#include <dlfcn.h>

#include <mutex>
#include <utility>

#include "app/sound/worker_control.hpp"
#include "core/files/module.hpp"

namespace dibhr {

namespace {

// From the reference of speech-dispatcher's C interface (info speech-dispatcher, "C API"), stable
// since 0.8: a connection is opaque, modes and priorities are enumerations.
struct SpeechConnection;
constexpr int kModeSingle = 0;  // SPD_MODE_SINGLE: no callbacks, no thread of the library
constexpr int kPriority = 2;    // SPD_MESSAGE: spoken after the messages before

/// The functions that are used; null until they are loaded.
struct SpeechFunctions {
    SpeechConnection* (*open)(const char* client, const char* connection, const char* user,
                              int mode){nullptr};
    int (*say)(SpeechConnection* to, int priority, const char* text){nullptr};
    int (*cancel)(SpeechConnection* to){nullptr};
    void (*close)(SpeechConnection* to){nullptr};

    [[nodiscard]] bool complete() const noexcept { return open && say && cancel && close; }
};

template <typename Function>
void find(void* library, const char* name, Function*& function) {
    function = reinterpret_cast<Function*>(dlsym(library, name));
}

SpeechFunctions functions_of(const std::string& library) {
    std::string why_not;
    SpeechFunctions functions;
    void* const loaded = load_library(library, Resolve::now, why_not);
    if (loaded == nullptr) return functions;
    find(loaded, "spd_open", functions.open);
    find(loaded, "spd_say", functions.say);
    find(loaded, "spd_cancel", functions.cancel);
    find(loaded, "spd_close", functions.close);
    return functions;
}

/// `number`: of the text, so that the same text can be said again; 0: nothing was said yet.
struct Saying {
    std::uint64_t number{0};
    std::string text{};
    bool next{false};  ///< after the one before, which is not broken off

    bool operator==(const Saying&) const = default;
};

}  // namespace

class Speaker::Work {
  public:
    explicit Work(std::string library) : library_(std::move(library)) {}

    void run() {
        constexpr double kLong_s = 3600.0;
        while (const std::optional<Saying> saying = control.wait()) {
            speak(*saying);
            while (control.unchanged_for(*saying, kLong_s)) {
            }
        }
        if (connection_ != nullptr) {
            functions_.cancel(connection_);
            functions_.close(connection_);
        }
        control.report_stopped();
    }

    [[nodiscard]] std::optional<std::string> take_trouble() {
        const std::lock_guard lock(mutex_);
        return std::exchange(trouble_, {});
    }

    WorkerControl<Saying> control{};

  private:
    void speak(const Saying& saying) {
        const std::string& text = saying.text;
        if (gave_up_ || !connect()) return;
        if (!saying.next) functions_.cancel(connection_);
        if (text.empty() || functions_.say(connection_, kPriority, text.c_str()) >= 0) return;
        functions_.close(connection_);  // the daemon has ended; once more with a new one
        connection_ = nullptr;
        if (connect() && functions_.say(connection_, kPriority, text.c_str()) < 0)
            give_up("speech-dispatcher does not take what is to be spoken: restart it");
    }

    bool connect() {
        if (connection_ != nullptr) return true;
        if (!functions_.complete()) functions_ = functions_of(library_);
        if (!functions_.complete()) {
            give_up("Nothing is spoken, as " + library_ +
                    " is missing: install the packages libspeechd2 and speech-dispatcher");
            return false;
        }
        connection_ = functions_.open("dibhr", "main", nullptr, kModeSingle);
        if (connection_ == nullptr)
            give_up(
                "Nothing is spoken, as speech-dispatcher does not answer: install the package "
                "speech-dispatcher, and check that spd-say hello speaks");
        return connection_ != nullptr;
    }

    void give_up(const std::string& trouble) {
        gave_up_ = true;
        const std::lock_guard lock(mutex_);
        trouble_ = trouble;
    }

    std::string library_;
    SpeechFunctions functions_{};
    SpeechConnection* connection_{nullptr};
    bool gave_up_{false};
    std::mutex mutex_{};
    std::optional<std::string> trouble_{};  // under the mutex
};

Speaker::Speaker(std::string library)
    : work_(std::make_shared<Work>(std::move(library))), thread_([work = work_] { work->run(); }) {}

Speaker::~Speaker() {
    work_->control.stop(thread_);
}

void Speaker::say(const std::string& text) {
    work_->control.request({++said_, text});
}

void Speaker::say_next(const std::string& text) {
    work_->control.request({++said_, text, true});
}

std::optional<std::string> Speaker::take_trouble() {
    return work_->take_trouble();
}

}  // namespace dibhr
