// The memory of the process: in large pages, locked for the haptic thread, returned when unused.
#pragma once

#include "core/realtime/priority_broker.hpp"

namespace dibhr {

/// Makes malloc() keep one heap for all threads, in pages of 2 MiB where the system has them, and
/// keep what is freed for the next frames: a first write to a page of 4 KiB takes up to 60 times as
/// long as a later one, so that new memory for a frame of 4K would take longer than to decode it.
/// Reserves addresses, not memory; where the system or the user limits them, nothing is reserved.
/// To be called once, before the process has a second thread.
void prepare_heap();

/// Returns the memory that malloc() keeps for later to the system. For any thread but the haptic
/// one; takes up to some tens of milliseconds for a gigabyte.
void return_unused_memory();

/// Locks all memory of the process, also what it allocates later, so that no tick waits for a page.
/// Refused where later allocations could fail then.
[[nodiscard]] Grant ask_for_memory_lock();

}  // namespace dibhr
