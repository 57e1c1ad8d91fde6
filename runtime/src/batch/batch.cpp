// The door of the batches: checks each call once and hands it to the kernels of the processor at hand.

#include "zonal/batch.hpp"

#include <cstdint>

#include "core/text.hpp"
#include "targets.hpp"
#include "zonal/error.hpp"
#include "zonal/rotate.hpp"

namespace zonal {
namespace {

/// `count` runs of `length` values, each `stride` after the one before.
template <class T>
struct Runs {
    const char* field;
    const T* data;
    std::size_t count;
    std::size_t length;
    std::size_t stride;

    std::size_t extent() const { return count == 0 ? 0 : (count - 1) * stride + length; }
};

[[noreturn]] void throw_problem(std::string field, std::string found, std::string wanted,
                                std::string next_step) {
    throw Error({.field = std::move(field),
                 .found = std::move(found),
                 .wanted = std::move(wanted),
                 .next_step = std::move(next_step)});
}

template <class T>
const batch::Kernel<T>& kernel_of(int order) {
    const batch::KernelTable<T> table = batch::kernels<T>();
    for (int i = 0; i < table.count; ++i)
        if (table.kernels[i].order == order) return table.kernels[i];
    throw_problem("order", text_of(order),
                  joined("an order that is compiled in: ", list_of(compiled_orders())),
                  "add the order to cmake/orders.cmake, generate its kernels and build again");
}

/// The runs of a span, which must hold them all.
template <class T>
Runs<T> checked_runs(const char* field, std::span<const T> span, std::size_t count, std::size_t length,
                     std::size_t stride) {
    if (stride < length)
        throw_problem(joined("stride of ", field), text_of(stride),
                      joined("at least ", length, ", the values of one"),
                      "give the distance from one to the next in values");
    const bool fits = count == 0 || (span.size() >= length && (span.size() - length) / stride >= count - 1);
    if (!fits)
        throw_problem(joined("length of ", field), text_of(span.size()),
                      joined(length + (count - 1) * stride, " for ", count, " of ", length, " values, ",
                             stride, " apart"),
                      "pass every value of the batch, or a smaller count");
    return {field, span.data(), count, length, stride};
}

/// Runs may lie in the gaps of others, as members of one struct do, where their strides agree.
template <class T>
void check_apart(const Runs<T>& a, const Runs<T>& b) {
    const auto begin_a = reinterpret_cast<std::uintptr_t>(a.data);
    const auto begin_b = reinterpret_cast<std::uintptr_t>(b.data);
    if (begin_a + a.extent() * sizeof(T) <= begin_b || begin_b + b.extent() * sizeof(T) <= begin_a) return;
    if (a.count == 0 || b.count == 0) return;
    if (a.stride == b.stride) {
        const std::size_t period = a.stride * sizeof(T);
        const std::size_t b_after_a = begin_b >= begin_a ? (begin_b - begin_a) % period
                                                         : (period - (begin_a - begin_b) % period) % period;
        if (b_after_a >= a.length * sizeof(T) && period - b_after_a >= b.length * sizeof(T)) return;
    }
    throw_problem(joined(a.field, " and ", b.field), "arrays that overlap in part",
                  "separate arrays (in and out may also be the same)", "rotate into a separate array");
}

template <class T>
batch::Job<T> checked_job(int order, const Runs<T>& rotations, batch::RotationForm form,
                          const BatchLayout& layout, std::span<const T> in, std::span<T> out) {
    if (layout.channels < 1)
        throw_problem("layout.channels", text_of(layout.channels), "at least 1",
                      "give the number of channels of a vector");
    const auto channels = static_cast<std::size_t>(layout.channels);
    const std::size_t coefficients = static_cast<std::size_t>(order) * order - (layout.dc_apart ? 1 : 0);
    const std::size_t length = channels * coefficients;
    const std::size_t stride = layout.stride == 0 ? length : layout.stride;
    const Runs<T> from = checked_runs("in", in, layout.count, length, stride);
    const Runs<T> to = checked_runs<T>("out", out, layout.count, length, stride);
    if (from.data != to.data) check_apart(from, to);
    check_apart(rotations, to);
    const std::size_t moved = (2 * length * layout.count + rotations.length * rotations.count) * sizeof(T);
    const bool is_large = moved > batch::streamed_bytes();
    return {.rotations = rotations.data,
            .rotation_stride = rotations.stride,
            .form = form,
            .in = from.data,
            .out = out.data(),
            .count = length == 0 ? 0 : layout.count,
            .stride = stride,
            .channels = channels,
            .is_interleaved = channels > 1 && layout.arrangement == ChannelArrangement::interleaved,
            .is_dc_apart = layout.dc_apart,
            .is_large = is_large,
            .is_streamed = is_large && stride == length && from.data != to.data};
}

/// The whole job by the calling thread, or ranges of it by the executor.
template <class T>
void run(void (*kernel)(const batch::Job<T>&), const batch::Job<T>& job, const Executor& executor) {
    if (!executor) return kernel(job);
    executor(job.count, [&](std::size_t begin, std::size_t end) {
        batch::Job<T> part = job;
        part.rotations += begin * job.rotation_stride;
        part.in += begin * job.stride;
        part.out += begin * job.stride;
        part.count = end - begin;
        kernel(part);
    });
}

template <class T>
void checked_rotate_each(int order, std::span<const T> rotations, std::size_t rotation_stride,
                         batch::RotationForm form, const BatchLayout& layout, std::span<const T> in,
                         std::span<T> out, const Executor& executor) {
    const batch::Kernel<T>& kernel = kernel_of<T>(order);
    const std::size_t length = form == batch::RotationForm::matrix ? 9 : 4;
    const Runs<T> runs = checked_runs("rotations", rotations, layout.count, length, rotation_stride);
    run(kernel.each, checked_job(order, runs, form, layout, in, out), executor);
}

template <class T>
void checked_rotate_all(int order, const RotationMatrix<T>& rotation, const BatchLayout& layout,
                        std::span<const T> in, std::span<T> out, const Executor& executor) {
    const batch::Kernel<T>& kernel = kernel_of<T>(order);
    const RotationMatrix<T> copy = rotation;  // it may lie in a gap of `out`
    const Runs<T> runs{"rotation", copy.data(), 1, 9, 0};
    run(kernel.all, checked_job(order, runs, batch::RotationForm::matrix, layout, in, out), executor);
}

}  // namespace

void rotate_each(int order, const RotationMatrices<float>& rotations, const BatchLayout& layout,
                 std::span<const float> in, std::span<float> out, const Executor& executor) {
    checked_rotate_each(order, rotations.values, rotations.stride, batch::RotationForm::matrix, layout, in,
                        out, executor);
}

void rotate_each(int order, const RotationMatrices<double>& rotations, const BatchLayout& layout,
                 std::span<const double> in, std::span<double> out, const Executor& executor) {
    checked_rotate_each(order, rotations.values, rotations.stride, batch::RotationForm::matrix, layout, in,
                        out, executor);
}

void rotate_each(int order, const RotationQuaternions<float>& rotations, const BatchLayout& layout,
                 std::span<const float> in, std::span<float> out, const Executor& executor) {
    checked_rotate_each(order, rotations.values, rotations.stride, batch::RotationForm::quaternion, layout,
                        in, out, executor);
}

void rotate_each(int order, const RotationQuaternions<double>& rotations, const BatchLayout& layout,
                 std::span<const double> in, std::span<double> out, const Executor& executor) {
    checked_rotate_each(order, rotations.values, rotations.stride, batch::RotationForm::quaternion, layout,
                        in, out, executor);
}

void rotate_all(int order, const RotationMatrix<float>& rotation, const BatchLayout& layout,
                std::span<const float> in, std::span<float> out, const Executor& executor) {
    checked_rotate_all(order, rotation, layout, in, out, executor);
}

void rotate_all(int order, const RotationMatrix<double>& rotation, const BatchLayout& layout,
                std::span<const double> in, std::span<double> out, const Executor& executor) {
    checked_rotate_all(order, rotation, layout, in, out, executor);
}

}  // namespace zonal
