// A page in a file, of which the name is in the environment: another process maps it, too.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>
#include <new>
#include <stdexcept>

#include "tests/support/environment_variable.hpp"

namespace dibhr::test {

template <typename Page>
class SharedPage {
  public:
    SharedPage(const std::filesystem::path& file, const char* variable)
        : variable_(variable, file.c_str()) {
        const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
        const bool sized = ::ftruncate(descriptor, sizeof(Page)) == 0;
        void* const memory =
            ::mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
        ::close(descriptor);
        if (!sized || memory == MAP_FAILED) throw std::runtime_error("no page: " + file.string());
        page_ = new (memory) Page;
    }
    ~SharedPage() { ::munmap(page_, sizeof(Page)); }
    SharedPage(const SharedPage&) = delete;
    SharedPage& operator=(const SharedPage&) = delete;

    [[nodiscard]] Page& operator*() const noexcept { return *page_; }
    [[nodiscard]] Page* operator->() const noexcept { return page_; }

  private:
    EnvironmentVariable variable_;
    Page* page_;
};

}  // namespace dibhr::test
