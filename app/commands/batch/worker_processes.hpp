// Pieces of work, each in a process of its own: on all processors, and what breaks one breaks none
// of the others.
#pragma once

#include <cstddef>
#include <functional>

#include "app/window/signals.hpp"
#include "core/estimate/child_program.hpp"

namespace dibhr {

/// The processors that this process may use, one at least.
[[nodiscard]] std::size_t usable_processors();

struct WorkerRequest {
    std::size_t count{0};
    std::size_t at_once{1};
    /// The piece of that index, in its process: what that ends with. It ends itself soon after a
    /// signal of `signals` has arrived there.
    std::function<int(std::size_t piece)> work{};
    /// In this process, when a piece has ended.
    std::function<void(std::size_t piece, const ChildEnd& end)> ended{};
};

/// Runs all of them, the first ones first. A shutdown signal ends them all: false. However this
/// process ends, they end. Only for a process that has one thread. Throws std::system_error where
/// no process can be started.
[[nodiscard]] bool run_in_processes(const WorkerRequest& request, ShutdownSignals& signals);

}  // namespace dibhr
