// The kernel's state of another thread of this program: whether it waits, and in which call.
#pragma once

#include <sys/types.h>

#include <fstream>
#include <string>

#include "tests/support/eventually.hpp"

namespace dibhr::test {

/// Whether a thread has come to wait in that system call (proc_pid_syscall(5)).
inline bool comes_to_wait_in(long system_call, pid_t thread) {
    return eventually([=] {
        std::ifstream file("/proc/self/task/" + std::to_string(thread) + "/syscall");
        long number = -1;
        return file >> number && number == system_call;
    });
}

}  // namespace dibhr::test
