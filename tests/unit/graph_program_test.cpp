// Kernels as loops over tables: run by a small interpreter, in numbers and in symbols.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "emit/cpp.hpp"
#include "graph/evaluate.hpp"
#include "graph/passes.hpp"
#include "graph/program.hpp"
#include "kernels/registry.hpp"
#include "support/empty_kernel.hpp"

namespace zonal::graph {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Runs a program over values of any kind: `compute(loop, operands)` is told what to do. Rows run in order;
/// `inputs` and `output` are the memory of the caller, so that they may be the same.
template <class X>
class Interpreter {
  public:
    Interpreter(const Program& program, std::vector<X> constants, std::vector<X*> inputs, X* output)
        : program_(program),
          constants_(std::move(constants)),
          inputs_(std::move(inputs)),
          output_(output),
          rotation_slots_(program.rotation_slots),
          signal_slots_(program.signal_slots) {}

    template <class Compute>
    void run(Compute compute) {
        for (const Loop& loop : program_.loops)
            for (const Run& run : loop.runs)
                for (int i = 0; i < run.count; ++i) {
                    std::vector<X> operands;
                    for (std::size_t k = 0; k < run.operands.size(); ++k)
                        operands.push_back(at(loop.operands[k], run.operands[k], i));
                    at(loop.result, run.result, i) = compute(loop, operands);
                }
    }

  private:
    X& at(const Place& place, const Elements& elements, int i) {
        const int index = elements.start + i * elements.step;
        switch (place.memory) {
            case Memory::rotation_slots:
                return rotation_slots_.at(index);
            case Memory::signal_slots:
                return signal_slots_.at(index);
            case Memory::constants:
                return constants_.at(index);
            case Memory::input:
                return inputs_.at(place.array)[index];
            case Memory::output:
                break;
        }
        return output_[index];
    }

    const Program& program_;
    std::vector<X> constants_;
    std::vector<X*> inputs_;
    X* output_;
    std::vector<X> rotation_slots_, signal_slots_;
};

template <class T>
T compute_number(const Loop& loop, const std::vector<T>& x) {
    switch (loop.op) {
        case Op::constant:
        case Op::input:
            return x[0];
        case Op::negate:
            return -x[0];
        case Op::add:
            return x[0] + x[1];
        case Op::subtract:
            return x[0] - x[1];
        case Op::multiply:
            return x[0] * x[1];
        case Op::fused:
            return std::fma(loop.negated_product ? -x[0] : x[0], x[1], loop.negated_addend ? -x[2] : x[2]);
        case Op::divide:
            return x[0] / x[1];
        case Op::square_root:
            return std::sqrt(x[0]);
        case Op::copy_sign:
            return std::copysign(std::is_same_v<T, float> ? x[1] : x[0], x[2]);
    }
    return T(0);
}

template <class T>
std::vector<T> rounded(const std::vector<Number>& numbers) {
    std::vector<T> result;
    for (const Number& number : numbers) result.push_back(static_cast<T>(static_cast<double>(number)));
    return result;
}

/// A rotation, or scalars as `prepare` would make them, and a signal.
template <class T>
std::vector<std::vector<T>> random_inputs(const Kernel& kernel, std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<std::vector<T>> inputs;
    for (const Array& array : kernel.inputs) {
        inputs.emplace_back(array.size);
        for (T& value : inputs.back()) value = static_cast<T>(uniform(random));
    }
    return inputs;
}

template <class T>
void expect_same_bits(const Kernel& kernel) {
    std::mt19937_64 random(1);
    std::vector<std::vector<T>> inputs = random_inputs<T>(kernel, random);
    // Room for the output where it is the longer one.
    inputs.back().resize(std::max<std::size_t>(inputs.back().size(), kernel.output.size));
    std::vector<T*> pointers;
    for (auto& input : inputs) pointers.push_back(input.data());
    std::vector<T> expected(kernel.output.size);
    Evaluator<T>{kernel}({pointers.begin(), pointers.end()}, expected.data());

    const Program program = make_program(kernel);
    std::vector<T> apart(kernel.output.size);
    Interpreter<T>(program, rounded<T>(program.constants), pointers, apart.data()).run(compute_number<T>);
    EXPECT_EQ(apart, expected);
    if (kernel.inputs.back().kind != Kind::signal) return;
    Interpreter<T>(program, rounded<T>(program.constants), pointers, pointers.back()).run(compute_number<T>);
    inputs.back().resize(expected.size());
    EXPECT_EQ(inputs.back(), expected) << "in place";
}

/// The nodes of a kernel by what they are: what a program computes has a name there, or is wrong.
class Symbols {
  public:
    explicit Symbols(const Kernel& kernel) : graph_(kernel.graph) {
        for (Id id = 0; id < graph_.size(); ++id) {
            const Node& node = graph_[id];
            if (node.op == Op::constant)
                constants_[node.value] = id;
            else if (node.op == Op::input)
                inputs_[{node.array, node.index}] = id;
            else
                ids_[{node.op, node.negated_product, node.negated_addend,
                      std::vector<Id>(node.operands.begin(), node.operands.end())}] = id;
        }
    }
    Id constant(const Number& value) const { return constants_.at(value); }
    Id input(int array, int index) const {
        const auto found = inputs_.find({array, index});
        return found == inputs_.end() ? -1 : found->second;
    }
    Id compute(const Loop& loop, const std::vector<Id>& operands) {
        if (loop.op == Op::constant || loop.op == Op::input) return operands[0];
        const auto found = ids_.find({loop.op, loop.negated_product, loop.negated_addend, operands});
        if (found == ids_.end()) return -1;
        ++times_computed_[found->second];
        return found->second;
    }
    void expect_each_computed_once() const {
        EXPECT_EQ(times_computed_.size(), ids_.size());
        for (const auto& [id, times] : times_computed_) EXPECT_EQ(times, 1) << "node " << id;
    }

  private:
    const Graph& graph_;
    std::map<Number, Id> constants_;
    std::map<std::pair<int, int>, Id> inputs_;
    std::map<std::tuple<Op, bool, bool, std::vector<Id>>, Id> ids_;
    std::map<Id, int> times_computed_;
};

void expect_the_nodes_of_the_graph(const Kernel& kernel) {
    const Program program = make_program(kernel);
    Symbols symbols(kernel);
    std::vector<std::vector<Id>> inputs;
    std::vector<Id*> pointers;
    for (int array = 0; array < static_cast<int>(kernel.inputs.size()); ++array) {
        inputs.emplace_back();
        for (int k = 0; k < kernel.inputs[array].size; ++k) inputs.back().push_back(symbols.input(array, k));
    }
    for (auto& input : inputs) pointers.push_back(input.data());
    std::vector<Id> constants, output(kernel.output.size, -1);
    for (const Number& value : program.constants) constants.push_back(symbols.constant(value));
    Interpreter<Id>(program, constants, pointers, output.data())
        .run([&](const Loop& loop, const auto& operands) { return symbols.compute(loop, operands); });
    for (const Store& store : kernel.stores) EXPECT_EQ(output[store.index], store.value);
    symbols.expect_each_computed_once();
}

/// Loops are vectorized: no element may be read once another row of the loop has written it, or before.
void expect_independent_rows(const Loop& loop) {
    std::set<std::pair<Place, int>> written;
    for (const Run& run : loop.runs)
        for (int i = 0; i < run.count; ++i)
            EXPECT_TRUE(written.emplace(loop.result, run.result.start + i * run.result.step).second);
    for (const Run& run : loop.runs)
        for (std::size_t k = 0; k < run.operands.size(); ++k)
            for (int i = 0; i < run.count; ++i)
                EXPECT_FALSE(
                    written.contains({loop.operands[k], run.operands[k].start + i * run.operands[k].step}));
}

void expect_what_the_spacing_says(const Loop& loop) {
    for (const Run& run : loop.runs) {
        EXPECT_TRUE(loop.spacing != Spacing::scattered || run.count == 1);
        if (loop.spacing != Spacing::even) continue;
        EXPECT_EQ(run.result.step, 1);
        for (std::size_t k = 0; k < run.operands.size(); ++k) EXPECT_EQ(run.operands[k].step, loop.steps[k]);
    }
}

template <class Check>
void for_each_kernel(Check check) {
    for (const int order : {2, 3, 4, 6, 9, 11}) {
        for (const Kernel& kernel : kernels::build_order(order, {})) {
            SCOPED_TRACE(fmt::format("order {} {}", order, kernel.name));
            check(kernel);
        }
    }
}

TEST(Program, gives_the_bits_of_the_graph_apart_and_in_place) {
    for_each_kernel([](const Kernel& kernel) {
        expect_same_bits<float>(kernel);
        expect_same_bits<double>(kernel);
    });
}

TEST(Program, computes_every_node_once_from_its_own_operands) {
    for_each_kernel(expect_the_nodes_of_the_graph);
}

TEST(Program, rows_of_a_loop_are_independent_and_spaced_as_it_says) {
    for_each_kernel([](const Kernel& kernel) {
        for (const Loop& loop : make_program(kernel).loops) {
            expect_independent_rows(loop);
            expect_what_the_spacing_says(loop);
        }
    });
}

TEST(Program, slots_are_used_again_when_their_value_is_done) {
    Kernel kernel = empty_kernel();
    Value power = kernel.input(0, 0);
    for (int k = 0; k < 50; ++k) power = power * power;
    kernel.store(0, power * kernel.input(1, 0), 0);
    EXPECT_LE(make_program(kernel).rotation_slots, 3);
    expect_the_nodes_of_the_graph(kernel);
}

TEST(Program, neighbours_become_one_run) {
    Kernel kernel = empty_kernel();
    for (int k = 0; k < 9; ++k) kernel.store(k, kernel.input(0, 0) * kernel.input(1, k), 0);
    int products = 0;
    for (const Loop& loop : make_program(kernel).loops) {
        if (loop.op != Op::multiply) continue;
        ++products;
        ASSERT_EQ(loop.runs.size(), 1u);
        EXPECT_EQ(loop.runs[0].count, 9);
        EXPECT_THAT(loop.steps, testing::ElementsAre(0, 1));
    }
    EXPECT_EQ(products, 1);
}

TEST(Program, equal_runs_share_their_constants) {
    Kernel kernel = empty_kernel();
    const Number half = Number(1) / 2, third = Number(1) / 3;
    for (int k = 0; k < 8; ++k)
        kernel.store(k, (k % 2 == 0 ? half : third) * (kernel.input(0, k) * kernel.input(1, k)), k / 4);
    EXPECT_LE(make_program(kernel).constants.size(), 4u);
    expect_the_nodes_of_the_graph(kernel);
}

/// A kernel of so many additions.
emit::Unit unit_of(int operations) {
    Kernel kernel = empty_kernel();
    Value sum = kernel.input(1, 0);
    for (int k = 0; k < operations; ++k) sum = sum + kernel.input(1, k % 9);
    kernel.store(0, sum, 0);
    emit::Unit unit;
    unit.name = "test";
    unit.folder = "test";
    unit.kernels = {kernel};
    unit.command = [](const std::string&) { return ""; };
    return unit;
}

std::string header_of(int operations) {
    for (const emit::File& file : emit::print_cpp(unit_of(operations)))
        if (file.path == "zonal/test/test.hpp") return file.content;
    return "no such file";
}

TEST(Tables, drive_large_kernels_only) {
    EXPECT_THAT(header_of(100), testing::AllOf(HasSubstr("void test("), Not(HasSubstr("kTestRuns"))));
    EXPECT_THAT(header_of(10000), HasSubstr("kTestRuns"));
}

}  // namespace
}  // namespace zonal::graph
