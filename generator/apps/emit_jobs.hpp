#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace zonal {

/// Parts of a text, empty ones too: of "3," the second one, and the only one of "".
std::vector<std::string> split(const std::string& text, char separator);

/// Orders as text: numbers and ranges joined by `separator`, "3-6,8". Throws `UserError` that names the
/// option and what it cannot read.
std::set<int> orders_of(const std::string& option, const std::string& text, char separator = ',');

/// What one run emits: the languages of every order, each language once.
using EmitJobs = std::map<int, std::vector<std::string>>;

/// `languages` joined by commas, each of the given orders or, behind a colon, of its own, those joined by +:
/// "cpp:2-10,glsl:3-6+8". `check_language` throws for one that is unknown. Throws `UserError`
/// where a language has no orders or comes twice.
EmitJobs emit_jobs(const std::set<int>& orders, const std::string& languages,
                   const std::function<void(const std::string&)>& check_language);

}  // namespace zonal
