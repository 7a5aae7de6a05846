// Work that a person may stop, at a terminal with Ctrl+C: its progress, and how it ends without
// leaving anything half done.
#pragma once

#include <filesystem>
#include <string>

#include "app/commands/output.hpp"
#include "app/window/signals.hpp"
#include "core/error.hpp"

namespace dibhr {

/// A person, or the system, has stopped the work.
class WorkStopped : public InputError {
  public:
    using InputError::InputError;
};

/// As ProgressBar; a shutdown signal becomes an exception of the next show(), so that files that
/// are not complete are removed. Only for a process that has one thread until then.
class StoppableWork {
  public:
    /// `what`: what is written, or read where nothing is written, for the message.
    StoppableWork(std::string title, std::filesystem::path what)
        : what_(std::move(what)), bar_(std::move(title)) {}

    /// Throws WorkStopped.
    void show(double share) {
        if (signals_.arrived())
            throw WorkStopped(what_.string() +
                              ": was not finished, as it was stopped; start it again");
        bar_.show(share);
    }

  private:
    ShutdownSignals signals_{};
    std::filesystem::path what_;
    ProgressBar bar_;
};

}  // namespace dibhr
