#pragma once

#include <filesystem>
#include <string>

#include "lobes/lobe_use.hpp"

namespace zonal {

/// What is wrong with the file of a table, as `UserError`: file, field, value found, value wanted, next step.
class TableComplaints {
  public:
    TableComplaints(std::filesystem::path path, LobeUse use) : path_(std::move(path)), use_(std::move(use)) {}

    [[noreturn]] void unreadable(const std::string& reason) const;
    /// A whole table, but for other kernels than those that are to be made of it.
    [[noreturn]] void of_another_use(const std::string& field, const std::string& found,
                                     const std::string& wanted) const;
    [[noreturn]] void complain(const std::string& field, const std::string& found,
                               const std::string& wanted) const;

  private:
    std::string other_table() const;

    std::filesystem::path path_;
    LobeUse use_;
};

}  // namespace zonal
