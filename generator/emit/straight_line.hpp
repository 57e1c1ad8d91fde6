#pragma once

#include <string>

#include "graph/kernel.hpp"

namespace zonal::emit {

/// What a language with infix formulas writes its own way. Operands are names, array elements or constants,
/// with a minus sign in front where they are negated.
class Syntax {
  public:
    virtual ~Syntax() = default;
    /// A new value, once and for all.
    virtual std::string declare(graph::Kind kind, const std::string& name,
                                const std::string& value) const = 0;
    virtual std::string constant(const graph::Number& value) const = 0;
    /// a * b + c, in one instruction where the target has it.
    virtual std::string fused(const std::string& a, const std::string& b, const std::string& c) const = 0;
    /// A constant, given in double and in single precision, with the sign of a value.
    virtual std::string copy_sign(const graph::Number& size, const graph::Number& size_in_float,
                                  const std::string& sign) const = 0;
    virtual std::string square_root(const std::string& a) const;
    virtual std::string element(const graph::Array& array, int index) const;
};

/// a * b + c where a language has nothing better; a negated c is subtracted.
std::string product_and_sum(const std::string& a, const std::string& b, const std::string& c);

/// The body of a kernel: the rotation is read first, then one statement a value, in the order of the
/// schedule.
std::string print_statements(const graph::Kernel& kernel, const Syntax& syntax, int indentation);

/// Of that body what depends on the rotation alone, or what is left once that is known.
std::string print_statements_of(graph::Kind kind, const graph::Kernel& kernel, const Syntax& syntax,
                                int indentation);

}  // namespace zonal::emit
