// Units of this process for other programs: their system calls come in over a unix socket.
#pragma once

#include <list>
#include <string>
#include <thread>

#include "tests/device/falcon/usbfs_files.hpp"

namespace dibhr::test::falcon {

/// Threads that begin in its life, and this one, do a kernel's work: they have a priority above
/// every program's, where that is allowed.
class KernelWork {
  public:
    KernelWork() noexcept;
    ~KernelWork();
    KernelWork(const KernelWork&) = delete;
    KernelWork& operator=(const KernelWork&) = delete;
};

/// Plays the kernel to every program that has a UsbfsClient: one thread a connection, for a call
/// may wait.
class UsbfsHost {
  public:
    /// Throws std::runtime_error when there can be no socket at `path`. `files` must outlive it.
    UsbfsHost(const std::string& path, UsbfsFiles& files);
    ~UsbfsHost();
    UsbfsHost(const UsbfsHost&) = delete;
    UsbfsHost& operator=(const UsbfsHost&) = delete;

  private:
    /// One that a program made; ends with its thread.
    struct Connection {
        Connection(int accepted, UsbfsFiles& files);
        ~Connection();
        Connection(const Connection&) = delete;
        Connection& operator=(const Connection&) = delete;

        int socket;
        std::jthread thread;
    };

    void accept_all();

    UsbfsFiles& files_;
    int listening_{-1};
    std::list<Connection> connections_{};  // the thread's
    std::jthread thread_{};
};

}  // namespace dibhr::test::falcon
