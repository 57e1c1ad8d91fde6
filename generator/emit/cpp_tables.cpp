// Prints programs as C++: arrays of small integers and one call of a loop for all runs of one form.
#include "emit/cpp_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <vector>

#include "emit/text.hpp"

namespace zonal::emit {

namespace {

using graph::Elements;
using graph::Kind;
using graph::Loop;
using graph::Memory;
using graph::Op;
using graph::Place;
using graph::Program;
using graph::Run;
using graph::Spacing;

constexpr std::size_t kColumns = 100;

/// The row of a run: its count, where its elements start and how they go on, as far as the loop does not
/// know.
std::vector<int> row_of(const Loop& loop, const Run& run) {
    std::vector<int> row;
    if (loop.spacing != Spacing::scattered) row.push_back(run.count);
    const auto append = [&](const Elements& elements) {
        row.push_back(elements.start);
        if (loop.spacing == Spacing::spaced) row.push_back(elements.step);
    };
    append(run.result);
    for (const Elements& operand : run.operands) append(operand);
    return row;
}

std::vector<int> rows_of(const Loop& loop) {
    std::vector<int> rows;
    for (const Run& run : loop.runs)
        for (const int entry : row_of(loop, run)) rows.push_back(entry);
    return rows;
}

/// Items separated by commas, in lines as full as they may be.
std::string filled_lines(const std::vector<std::string>& items) {
    std::string text, line;
    for (const std::string& item : items) {
        if (line.size() + item.size() + 2 > kColumns) {
            text += line + "\n";
            line.clear();
        }
        line += (line.empty() ? "    " : " ") + item + ",";
    }
    return text + line + "\n";
}

/// The smallest type that holds every entry.
const char* integer_for(const std::vector<int>& entries) {
    constexpr int kLargest = std::numeric_limits<short>::max();
    const bool is_short =
        std::all_of(entries.begin(), entries.end(), [](int e) { return -kLargest <= e && e <= kLargest; });
    return is_short ? "short" : "int";
}

std::string expression(const Loop& loop) {
    const auto operand = [&](int k) {
        const std::string letter(1, static_cast<char>('a' + k));
        return loop.operands[k].memory == Memory::constants ? "T(" + letter + ")" : letter;
    };
    const auto signed_operand = [&](int k, bool is_negated) {
        return fmt::format("{}{}", is_negated ? "-" : "", operand(k));
    };
    switch (loop.op) {
        case Op::constant:
        case Op::input:
            return operand(0);
        case Op::negate:
            return signed_operand(0, true);
        case Op::add:
            return fmt::format("{} + {}", operand(0), operand(1));
        case Op::subtract:
            return fmt::format("{} - {}", operand(0), operand(1));
        case Op::multiply:
            return fmt::format("{} * {}", operand(0), operand(1));
        case Op::fused:
            return fmt::format("fma({}, {}, {})", signed_operand(0, loop.negated_product), operand(1),
                               signed_operand(2, loop.negated_addend));
        case Op::divide:
            return fmt::format("{} / {}", operand(0), operand(1));
        case Op::square_root:
            return fmt::format("sqrt({})", operand(0));
        case Op::copy_sign:
            return fmt::format("copysign(is_single<T>::value ? {} : {}, {})", operand(1), operand(0),
                               operand(2));
    }
    throw std::logic_error("an operation without an expression");
}

const char* function_for(const Loop& loop) {
    switch (loop.spacing) {
        case Spacing::even:
            return "even_runs";
        case Spacing::spaced:
            return "spaced_runs";
        case Spacing::scattered:
            return "scattered";
    }
    throw std::logic_error("runs without a loop");
}

std::string columns(const Loop& loop) {
    const std::string columns = fmt::format("Columns<{}>{{}}", loop.operands.size());
    if (loop.spacing != Spacing::even) return columns;
    return fmt::format("Steps<{}>{{}}, {}", fmt::join(loop.steps, ", "), columns);
}

}  // namespace

const char* const kTableLoops = R"(
// Large kernels are loops over tables: the operations of straight code, in an order of their own.
// Values lie in arrays: t rotation scalars, v signal values, k constants, and the arguments. A loop
// does one operation; each row of its table is a run of elements:
//   even_runs   : count, start of the result and of each operand. Results are neighbours; operands
//                 are neighbours, or one and the same where the step is 0
//   spaced_runs : count, then start and step of the result and of each operand
//   scattered   : one element: the result and each operand
// No row reads what a row of the same loop writes. T and V need a default constructor.

// Constants are of the scalar type that they are used as: a float kernel has no double.
template <class T>
using constant_of =
    std::conditional_t<std::is_same_v<typename scalar_of<T>::type, float>, float, double>;

template <class C, std::size_t size>
struct Constants {
    C values[size];
    constexpr explicit Constants(const double (&exact)[size]) : values{} {
        for (std::size_t i = 0; i < size; ++i) values[i] = static_cast<C>(exact[i]);
    }
};

template <int... steps>
using Steps = std::integer_sequence<int, steps...>;
template <std::size_t operands>
using Columns = std::make_index_sequence<operands>;

// One copy that stays in the instruction cache, not one for each call.
#if defined(__clang__)
#define ZONAL_SHARED_LOOP static __attribute__((noinline))
#elif defined(__GNUC__)
#define ZONAL_SHARED_LOOP static __attribute__((noinline, noclone))
#else
#define ZONAL_SHARED_LOOP static
#endif

// Runs are too short for what compilers do to loops at -O3.
#if defined(__GNUC__)
ZONAL_INLINE void keep_loop_short() { __asm__ volatile(""); }
#else
ZONAL_INLINE void keep_loop_short() {}
#endif

// Blocks of a fixed size, read before written, become vector instructions.
template <int... steps, class Result, class Operation, class... Operand>
static void even_run(int count, Result* result, Operation operation, const Operand*... operands) {
    constexpr int kBlock = 4;
    int i = 0;
    for (; i + kBlock <= count; i += kBlock) {
        keep_loop_short();
        Result block[kBlock];
        for (int k = 0; k < kBlock; ++k) block[k] = operation(operands[steps * (i + k)]...);
        for (int k = 0; k < kBlock; ++k) result[i + k] = block[k];
    }
    for (; i < count; ++i) {
        keep_loop_short();
        result[i] = operation(operands[steps * i]...);
    }
}

template <class Row, int... steps, std::size_t... k, class Result, class Operation,
          class... Operand>
ZONAL_SHARED_LOOP void even_runs(const Row* row, int runs, Steps<steps...>,
                                 std::index_sequence<k...>, Result* result, Operation operation,
                                 const Operand*... operands) {
    for (; runs > 0; --runs, row += 2 + sizeof...(k))
        even_run<steps...>(row[0], result + row[1], operation, (operands + row[2 + k])...);
}

template <class Row, std::size_t... k, class Result, class Operation, class... Operand>
ZONAL_SHARED_LOOP void spaced_runs(const Row* row, int runs, std::index_sequence<k...>,
                                   Result* result, Operation operation,
                                   const Operand*... operands) {
    for (; runs > 0; --runs, row += 3 + 2 * sizeof...(k)) {
        for (int i = 0; i < row[0]; ++i) {
            keep_loop_short();
            result[row[1] + i * row[2]] =
                operation(operands[row[3 + 2 * k] + i * row[4 + 2 * k]]...);
        }
    }
}

template <class Row, std::size_t... k, class Result, class Operation, class... Operand>
ZONAL_SHARED_LOOP void scattered(const Row* row, int elements, std::index_sequence<k...>,
                                 Result* result, Operation operation,
                                 const Operand*... operands) {
    for (; elements > 0; --elements, row += 1 + sizeof...(k)) {
        keep_loop_short();
        result[row[0]] = operation(operands[row[1 + k]]...);
    }
}
#undef ZONAL_SHARED_LOOP
)";

TablePrinter::TablePrinter(const graph::Kernel& kernel, std::string name)
    : kernel_(kernel), name_(std::move(name)), program_(graph::make_program(kernel)) {}

std::string TablePrinter::tables() const {
    std::vector<int> entries;
    for (const Loop& loop : program_.loops)
        for (const int entry : rows_of(loop)) entries.push_back(entry);
    std::vector<std::string> items;
    for (const int entry : entries) items.push_back(std::to_string(entry));
    std::string text = fmt::format("\ninline constexpr {} k{}Runs[] = {{\n{}}};\n", integer_for(entries),
                                   name_, filled_lines(items));
    if (program_.constants.empty()) return text;
    items.clear();
    for (const graph::Number& constant : program_.constants) items.push_back(literal(constant));
    text += fmt::format("\ninline constexpr double k{}Exact[] = {{\n{}}};\n", name_, filled_lines(items));
    return text + fmt::format(
                      "template <class C>\ninline constexpr kernel_support::Constants<C, {}> "
                      "k{}Constants(k{}Exact);\n",
                      items.size(), name_, name_);
}

std::string TablePrinter::body(int indentation) const {
    const std::string indent(indentation, ' ');
    std::string text;
    if (!program_.constants.empty())
        text +=
            fmt::format("{0}using C = constant_of<T>;\n{0}constexpr const C* k = k{1}Constants<C>.values;\n",
                        indent, name_);
    if (program_.rotation_slots > 0) text += fmt::format("{}T t[{}];\n", indent, program_.rotation_slots);
    if (program_.signal_slots > 0) text += fmt::format("{}V v[{}];\n", indent, program_.signal_slots);
    // Each operation is one lambda, so that all loops over it are one function.
    std::map<std::string, std::string> names;
    std::string calls;
    std::size_t entry = 0;
    for (const Loop& loop : program_.loops) {
        const auto [name, is_new] = names.emplace(operation(loop), fmt::format("op_{}", names.size()));
        if (is_new) text += fmt::format("{}const auto {} = {};\n", indent, name->second, name->first);
        calls += print_call({&loop, entry, name->second}, indent);
        entry += rows_of(loop).size();
    }
    return text + calls;
}

std::string TablePrinter::print_call(const Call& call, const std::string& indentation) const {
    const Loop& loop = *call.loop;
    std::vector<std::string> arrays{array_of(loop.result), call.operation};
    for (const Place& operand : loop.operands) arrays.push_back(array_of(operand));
    const std::string table = fmt::format("{}{}(k{}Runs + {}, {}, {},", indentation, function_for(loop),
                                          name_, call.first_entry, loop.runs.size(), columns(loop));
    const std::string rest = fmt::format("{});", fmt::join(arrays, ", "));
    const bool fits = table.size() + 1 + rest.size() <= kColumns;
    return table + (fits ? " " : "\n    " + indentation) + rest + "\n";
}

std::string TablePrinter::operation(const Loop& loop) const {
    std::vector<std::string> parameters;
    for (const Place& operand : loop.operands)
        parameters.push_back(
            fmt::format("{} {}", type_of(operand), static_cast<char>('a' + parameters.size())));
    return fmt::format("[]({}) {{ return {}; }}", fmt::join(parameters, ", "), expression(loop));
}

const char* TablePrinter::type_of(const Place& place) const {
    const auto name = [](Kind kind) { return kind == Kind::signal ? "V" : "T"; };
    switch (place.memory) {
        case Memory::constants:
            return "C";
        case Memory::rotation_slots:
            return "T";
        case Memory::signal_slots:
            return "V";
        case Memory::input:
            return name(kernel_.inputs[place.array].kind);
        case Memory::output:
            return name(kernel_.output.kind);
    }
    throw std::logic_error("a place without a type");
}

std::string TablePrinter::array_of(const Place& place) const {
    switch (place.memory) {
        case Memory::constants:
            return "k";
        case Memory::rotation_slots:
            return "t";
        case Memory::signal_slots:
            return "v";
        case Memory::input:
            return kernel_.inputs[place.array].name;
        case Memory::output:
            return kernel_.output.name;
    }
    throw std::logic_error("a place without a name");
}

}  // namespace zonal::emit
