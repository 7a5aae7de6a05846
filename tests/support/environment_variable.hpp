// An environment variable, changed until the end of a scope.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace dibhr::test {

/// Restored by the destructor. No other thread may read the environment meanwhile.
class EnvironmentVariable {
  public:
    /// `value`: null takes it away.
    EnvironmentVariable(const char* name, const char* value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        set(value);
    }
    ~EnvironmentVariable() { set(before_ ? before_->c_str() : nullptr); }
    EnvironmentVariable(const EnvironmentVariable&) = delete;
    EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

  private:
    void set(const char* value) const {
        if (value == nullptr) {
            ::unsetenv(name_);
        } else {
            ::setenv(name_, value, 1);
        }
    }

    const char* name_;
    std::optional<std::string> before_{};
};

}  // namespace dibhr::test
