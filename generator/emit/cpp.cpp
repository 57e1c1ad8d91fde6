// Prints expression graphs as C++: one statement a node, products with the scalar on the left.
#include "emit/cpp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <stdexcept>

#include "emit/cpp_tables.hpp"
#include "emit/straight_line.hpp"
#include "emit/text.hpp"
#include "graph/counts.hpp"
#include "graph/schedule.hpp"

namespace zonal::emit {

namespace {

using graph::Id;
using graph::Kernel;
using graph::Kind;
using graph::Node;
using graph::Op;

/// Kernels of more operations are loops over tables. Dense blocks of so many operations by g++ 12, -O2 -mfma,
/// scalar float, 256 rotations in turn:
///     operations                              3916  8004  14280  35030  69728
///     seconds to compile, unrolled, tables     3 1   6 1   14 1   49 1  140 1
///     microseconds a call, unrolled, tables  1.6 2.2  3.3 4.1  6.5 7.1  17 17  36 34
/// Below 30000 operations only the time to compile speaks for tables, so the limit lies as high as it may for
/// the kernels of order 10 to take well under 10 s together: above its `rotate_accurate`.
/// `rotate` and its like stay below it at every order (order 20: 4 s, and 2.1 us instead of 5.1).
constexpr int kLargestUnrolled = 9000;

/// Once for all headers that a file includes.
const char* const kMacros = R"(
#if !defined(__GNUC__)
#include <cmath>
#endif

#ifndef ZONAL_HOST_DEVICE
// Kernels are functions of both sides where a compiler for GPUs reads this.
#if defined(__CUDACC__) || defined(__HIPCC__)
#define ZONAL_HOST_DEVICE __host__ __device__
#else
#define ZONAL_HOST_DEVICE
#endif
// Always inlined: files compiled for different targets must not share a copy.
#if defined(__GNUC__)
#define ZONAL_INLINE ZONAL_HOST_DEVICE inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define ZONAL_INLINE ZONAL_HOST_DEVICE __forceinline
#else
#define ZONAL_INLINE ZONAL_HOST_DEVICE inline
#endif
#endif
)";

const char* const kPrelude = R"(
// What T and V must have: copies; T, of rotation scalars, construction from a constant, + - * and
// unary -, and where a kernel says so / and the functions sqrt and copysign; V, of signal values,
// + - and unary -, and T * V. They may have fma(a, b, c), a b + c by one rounding. Functions of
// their own are found by argument-dependent lookup; what follows serves float, double and the rest.
namespace detail {

// One instruction where the target has it, a product and a sum elsewhere, never a library call.
// ZONAL_NO_FMA: always a product and a sum; with -ffp-contract=off the same bits everywhere.
template <class S, class V>
ZONAL_INLINE V fma(const S& a, const V& b, const V& c) {
    return a * b + c;
}
#if !defined(ZONAL_NO_FMA) && defined(__GNUC__) && \
    (defined(__FMA__) || defined(__ARM_FEATURE_FMA) || defined(__CUDA_ARCH__))
ZONAL_INLINE float fma(float a, float b, float c) { return __builtin_fmaf(a, b, c); }
ZONAL_INLINE double fma(double a, double b, double c) { return __builtin_fma(a, b, c); }
#endif
#if defined(__GNUC__)
ZONAL_INLINE float sqrt(float a) { return __builtin_sqrtf(a); }
ZONAL_INLINE double sqrt(double a) { return __builtin_sqrt(a); }
ZONAL_INLINE float copysign(float size, float sign) { return __builtin_copysignf(size, sign); }
ZONAL_INLINE double copysign(double size, double sign) { return __builtin_copysign(size, sign); }
#else
ZONAL_INLINE float sqrt(float a) { return std::sqrt(a); }
ZONAL_INLINE double sqrt(double a) { return std::sqrt(a); }
ZONAL_INLINE float copysign(float size, float sign) { return std::copysign(size, sign); }
ZONAL_INLINE double copysign(double size, double sign) { return std::copysign(size, sign); }
#endif

// Whether T computes in single precision: float, and what has float as its value_type.
template <class T, class = void>
struct is_single : std::is_same<T, float> {};
template <class T>
struct is_single<T, std::void_t<typename T::value_type>> : is_single<typename T::value_type> {};

// The scalar that multiplies a signal value: V itself, or V::value_type where V is a vector.
template <class V, class = void>
struct scalar_of {
    using type = V;
};
template <class V>
struct scalar_of<V, std::void_t<typename V::value_type>> {
    using type = typename V::value_type;
};
)";

void append(std::vector<std::string>& lines, const std::vector<std::string>& more) {
    lines.insert(lines.end(), more.begin(), more.end());
}

const char* type_of(Kind kind) { return kind == Kind::signal ? "V" : "T"; }

std::string template_line(const Kernel& kernel) {
    if (!kernel.uses(Kind::signal)) return "template <class T>\n";
    if (!kernel.uses(Kind::rotation))
        return "template <class V, class T = typename detail::scalar_of<V>::type>\n";
    return "template <class T, class V = T>\n";
}

bool reads(const Kernel& kernel, int input) {
    for (Id id = 0; id < kernel.graph.size(); ++id)
        if (kernel.graph[id].op == Op::input && kernel.graph[id].array == input) return true;
    return false;
}

std::string parameters(const Kernel& kernel) {
    std::string text;
    for (int k = 0; k < static_cast<int>(kernel.inputs.size()); ++k) {
        const graph::Array& array = kernel.inputs[k];
        const bool is_read = reads(kernel, k) || !kernel.for_channels.empty();
        text += fmt::format("const {}* {}, ", type_of(array.kind),
                            is_read ? array.name : fmt::format("/*{}*/", array.name));
    }
    return text + fmt::format("{}* {}", type_of(kernel.output.kind), kernel.output.name);
}

/// rotate_zhf -> RotateZhf
std::string pascal_case(const std::string& name) {
    std::string result;
    bool is_start = true;
    for (const char c : name) {
        if (c != '_') result += is_start ? static_cast<char>(std::toupper(c)) : c;
        is_start = c == '_';
    }
    return result;
}

/// Whether an angle is chosen where the rotation leaves it free: the result is right all the same, its
/// derivative is not.
bool has_pole(const Kernel& kernel) {
    for (Id id = 0; id < kernel.graph.size(); ++id)
        if (kernel.graph[id].op == Op::copy_sign) return true;
    return false;
}

std::string kernel_comment(const Kernel& kernel) {
    const graph::Array& last = kernel.inputs.back();
    std::vector<std::string> lines = purpose_lines(kernel);
    lines.push_back(
        last.kind == Kind::signal
            ? fmt::format("{} may be {}; they must not overlap in part.", kernel.output.name, last.name)
            : fmt::format("{} must not overlap {}.", kernel.output.name, last.name));
    append(lines, precondition_lines(kernel));
    if (!kernel.for_channels.empty())
        lines.push_back(
            fmt::format("Where V is not T, a value of several channels, this is {}.", kernel.for_channels));
    if (kernel.has_bound)
        lines.push_back(fmt::format("Error: at most (k{0}Bound... + k{0}Excess |R R^T - I|_F) |{1}|.",
                                    pascal_case(kernel.name),
                                    last.kind == Kind::signal ? last.name : "signal"));
    if (has_pole(kernel)) lines.push_back("T needs /, sqrt and copysign too.");
    if (kernel.uses(Kind::rotation) && kernel.inputs[0].name == "R")
        lines.push_back(
            has_pole(kernel)
                ? "Not for derivatives by R: where R turns z onto itself or -z they come out wrong."
                : "May be differentiated: T and V may be numbers that carry derivatives.");
    append(lines, source_lines(kernel));
    std::string text;
    for (const std::string& line : lines) text += "/// " + line + "\n";
    return text;
}

void check_in_place(const Kernel& kernel) {
    const std::vector<graph::Statement> statements = graph::schedule(kernel);
    for (int k = 0; k < static_cast<int>(kernel.inputs.size()); ++k)
        if (kernel.inputs[k].kind == Kind::signal && !graph::is_safe_in_place(kernel, statements, k))
            throw std::logic_error(kernel.name + " reads what it has overwritten");
}

class CppSyntax : public Syntax {
  public:
    std::string declare(Kind kind, const std::string& name, const std::string& value) const override {
        return fmt::format("const {} {} = {};", type_of(kind), name, value);
    }
    std::string constant(const graph::Number& value) const override {
        return fmt::format("T({})", literal(value));
    }
    std::string fused(const std::string& a, const std::string& b, const std::string& c) const override {
        return fmt::format("fma({}, {}, {})", a, b, c);
    }
    std::string copy_sign(const graph::Number& size, const graph::Number& size_in_float,
                          const std::string& sign) const override {
        return fmt::format("copysign(T(is_single<T>::value ? {} : {}), {})",
                           static_cast<double>(size_in_float), static_cast<double>(size), sign);
    }
};

bool is_table_driven(const Kernel& kernel) {
    return graph::count_operations(kernel).total().instructions() > kLargestUnrolled;
}

/// The body by its indentation, and what stands in front of the function.
struct Body {
    std::string tables;
    std::function<std::string(int indentation)> print;
};

Body body_of(const Kernel& kernel) {
    check_in_place(kernel);
    if (!is_table_driven(kernel))
        return {"", [&](int indentation) { return print_statements(kernel, CppSyntax(), indentation); }};
    const TablePrinter printer(kernel, pascal_case(kernel.name));
    return {printer.tables(), [=](int indentation) { return printer.body(indentation); }};
}

bool needs_helpers(const Kernel& kernel) {
    for (Id id = 0; id < kernel.graph.size(); ++id) {
        const Op op = kernel.graph[id].op;
        if (op == Op::fused || op == Op::square_root || op == Op::copy_sign) return true;
    }
    return is_table_driven(kernel);
}

std::string print_kernel(const Kernel& kernel) {
    const Body body = body_of(kernel);
    // Static: a copy for each file, compiled as that file is.
    const std::string head =
        fmt::format("{}\n{}{}ZONAL_HOST_DEVICE static void {}({}) {{\n{}", body.tables,
                    kernel_comment(kernel), template_line(kernel), kernel.name, parameters(kernel),
                    needs_helpers(kernel) ? "    using namespace detail;\n" : "");
    if (kernel.for_channels.empty()) return head + body.print(4) + "}\n";
    std::string arguments;
    for (const graph::Array& array : kernel.inputs) arguments += array.name + ", ";
    return head + fmt::format(
                      "    if constexpr (!std::is_same_v<T, V>) {{\n        {}({}{});\n    }} else {{\n{}    "
                      "}}\n}}\n",
                      kernel.for_channels, arguments, kernel.output.name, body.print(8));
}

std::string print_constants(const Unit& unit) {
    std::string text;
    for (const Constant& constant : unit.constants)
        text += fmt::format("\n/// {}.\ninline constexpr int {} = {};\n", constant.meaning, constant.name,
                            constant.value);
    return text;
}

std::string print_bounds(const Unit& unit, const std::string& variant) {
    std::string text;
    for (const Kernel& kernel : unit.kernels) {
        const auto bound = unit.bounds.find(kernel.full_name());
        if (bound == unit.bounds.end() || kernel.variant != variant) continue;
        const std::string name = pascal_case(kernel.name);
        text += fmt::format("\n/// Largest relative error of {} for {} where R is orthonormal,\n",
                            kernel.name, domain_text(kernel));
        text += "/// and what is added for each unit of |R R^T - I|_F.\n";
        text += fmt::format("inline constexpr double k{}BoundFloat = {};\n", name, bound->second.float_text);
        text +=
            fmt::format("inline constexpr double k{}BoundDouble = {};\n", name, bound->second.double_text);
        text += fmt::format("inline constexpr double k{}Excess = {};\n", name, bound->second.excess_text);
    }
    return text;
}

/// The bounds and kernels of one variant.
std::string print_variant(const Unit& unit, const std::string& variant) {
    std::string text = print_bounds(unit, variant);
    for (const Kernel& kernel : unit.kernels)
        if (kernel.variant == variant) text += print_kernel(kernel);
    return text;
}

/// Every variant that occurs, in the order of the kernels.
std::vector<std::string> variants_of(const Unit& unit) {
    std::vector<std::string> variants;
    for (const Kernel& kernel : unit.kernels)
        if (std::find(variants.begin(), variants.end(), kernel.variant) == variants.end())
            variants.push_back(kernel.variant);
    return variants;
}

}  // namespace

std::string print_cpp(const Unit& unit) {
    std::string text;
    for (const std::string& line : banner_lines(unit)) text += "// " + line + "\n";
    const bool has_tables = std::any_of(unit.kernels.begin(), unit.kernels.end(), is_table_driven);
    text += fmt::format("#pragma once\n\n{}#include <type_traits>\n{}{}\nnamespace zonal::{} {{\n",
                        has_tables ? "#include <cstddef>\n" : "", has_tables ? "#include <utility>\n" : "",
                        kMacros, unit.name);
    text += kPrelude;
    if (has_tables) text += kTableLoops;
    text += "\n}  // namespace detail\n";
    text += print_constants(unit);
    for (const std::string& variant : variants_of(unit)) {
        const std::string body = print_variant(unit, variant);
        text += variant.empty()
                    ? body
                    : fmt::format("\nnamespace {0} {{\n{1}\n}}  // namespace {0}\n", variant, body);
    }
    return text + fmt::format("\n}}  // namespace zonal::{}\n", unit.name);
}

}  // namespace zonal::emit
