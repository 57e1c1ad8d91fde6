#pragma once

#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

namespace zonal::gpu {

/// Sets an environment variable for as long as it lives. Loader and drivers read theirs when an instance or a
/// device is made. Not for programs whose other threads read the environment meanwhile.
class EnvironmentVariable {
  public:
    EnvironmentVariable(std::string name, const std::string& value) : name_(std::move(name)) {
        if (const char* before = std::getenv(name_.c_str())) before_ = before;
        ::setenv(name_.c_str(), value.c_str(), 1);
    }
    EnvironmentVariable(const EnvironmentVariable&) = delete;
    EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;
    ~EnvironmentVariable() {
        if (before_)
            ::setenv(name_.c_str(), before_->c_str(), 1);
        else
            ::unsetenv(name_.c_str());
    }

  private:
    std::string name_;
    std::optional<std::string> before_;
};

}  // namespace zonal::gpu
