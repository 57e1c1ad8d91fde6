#pragma once

#include <map>
#include <string>
#include <vector>

#include "emit/unit.hpp"
#include "graph/counts.hpp"

namespace zonal::emit {

/// The banner that the file of a kernel opens with, one line an entry, without comment signs: the fixed keys
/// command, table, basis, cost, bound, source in that order.
std::vector<std::string> banner_lines(const Unit& unit, const graph::Kernel& kernel);
/// The same for a file that another command makes.
std::vector<std::string> banner_lines(const Unit& unit, const graph::Kernel& kernel,
                                      const std::string& command);

/// The first of them: command, table and basis.
std::vector<std::string> opening_lines(const Unit& unit, const std::string& command,
                                       const std::vector<std::string>& tables);

/// Appends a key of the banner and its values, one a line: "key     : first", "          second" …
void append_key(std::vector<std::string>& lines, const std::string& key,
                const std::vector<std::string>& values);

/// "12 mul 3 add 4 fma 0 other"
std::string counts_text(const graph::Counts& counts);

/// The rotations that a kernel is right for: "det R = +1".
std::string domain_text(const graph::Kernel& kernel);

/// A kernel's name where a language has no namespaces: rotate_zhf, stable_rotate_zhf.
std::string plain_name(const graph::Kernel& kernel);

/// What a kernel computes and what its arguments hold, for the comment in front of it, without comment signs.
std::vector<std::string> purpose_lines(const graph::Kernel& kernel);

/// What R must be, if not every orthonormal matrix will do.
std::vector<std::string> precondition_lines(const graph::Kernel& kernel);

/// Cost, published error and sources, for the end of that comment.
std::vector<std::string> closing_lines(const Unit& unit, const graph::Kernel& kernel);

/// The kernel that runs where signal values hold three channels: another one, where that costs less.
const graph::Kernel& for_channels(const Unit& unit, const graph::Kernel& kernel);

/// The kernels to print in languages where three channels are a form of the same name: not those that another
/// one takes for its channels.
std::vector<graph::Kernel> shader_kernels(const Unit& unit);

/// Lines behind a language's sign of comments.
std::string comment(const std::string& sign, const std::vector<std::string>& lines);

/// What stands in front of a shader's function, behind //.
std::string shader_comment(const Unit& unit, const graph::Kernel& kernel);

/// A constant as a decimal of at most 17 digits that reads back as the double nearest to it.
std::string literal(const graph::Number& value);

/// The float nearest to that double, as a decimal of at most 9 digits that reads back as the same float.
std::string float_literal(const graph::Number& value);

/// A unique identifier for every computed or named node: its own name, or its scope and a number.
std::map<graph::Id, std::string> node_names(const graph::Kernel& kernel);

}  // namespace zonal::emit
