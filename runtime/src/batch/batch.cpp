// The door of the batches: checks each call once and hands it to the kernels of the processor at hand.

#include "zonal/batch.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <limits>

#include "core/convention_places.hpp"
#include "core/text.hpp"
#include "few.hpp"
#include "most_coefficients.hpp"
#include "targets.hpp"
#include "zonal/error.hpp"
#include "zonal/kernel_support.hpp"
#include "zonal/rotate.hpp"

namespace zonal {
namespace {

constexpr std::size_t kMostSize = std::numeric_limits<std::size_t>::max();

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

/// Whether `available` values hold `count` runs; no product of these wraps.
ZONAL_INLINE bool holds(std::size_t available, std::size_t count, std::size_t length, std::size_t stride) {
    if (count == 0) return true;
    if (available < length) return false;
    constexpr std::size_t kHalf = std::size_t{1} << (std::numeric_limits<std::size_t>::digits / 2);
    const bool cannot_wrap = count <= kHalf && stride < kHalf;  // the usual case, without a division
    return cannot_wrap ? (count - 1) * stride <= available - length
                       : (available - length) / stride >= count - 1;
}

/// Values that `count` runs need, for messages.
std::string needed(std::size_t count, std::size_t length, std::size_t stride) {
    if (holds(kMostSize, count, length, stride)) return text_of(length + (count - 1) * stride);
    return joined("more than ", kMostSize);
}

/// What a call names in its messages: put together only when there is one.
struct Field {
    const char* before;
    const char* name;
    std::ptrdiff_t number = -1;

    Field(const char* whole_name) : before(""), name(whole_name) {}
    Field(const char* text_before, const char* last_name, std::ptrdiff_t number_between = -1)
        : before(text_before), name(last_name), number(number_between) {}

    std::string text() const {
        return number < 0 ? joined(before, name) : joined(before, number, " of ", name);
    }
};

template <class T>
ZONAL_INLINE void check_address(const Field& field, const T* data) {
    if (reinterpret_cast<std::uintptr_t>(data) % alignof(T) == 0) return;
    throw_problem(joined("address of ", field.text()), joined("one that is not a multiple of ", alignof(T)),
                  "the address of a value, as every array of them has it",
                  "copy the bytes into an array of float or double first");
}

ZONAL_INLINE void check_stride(const Field& field, std::size_t stride, std::size_t length) {
    if (stride >= length) return;
    throw_problem(joined("stride of ", field.text()), text_of(stride),
                  joined("at least ", length, ", the values of one"),
                  "give the distance from one to the next in values");
}

/// The runs of a span, which must hold them all.
template <class T>
ZONAL_INLINE Runs<T> checked_runs(const Field& field, std::span<const T> span, std::size_t count,
                                  std::size_t length, std::size_t stride) {
    check_stride(field, stride, length);
    if (!holds(span.size(), count, length, stride))
        throw_problem(joined("length of ", field.text()), text_of(span.size()),
                      joined(needed(count, length, stride), " for ", count, " of ", length, " values, ",
                             stride, " apart"),
                      "pass every value of the batch, or a smaller count");
    check_address(field, span.data());
    return {field.name, span.data(), count, length, stride};
}

template <class T>
bool are_apart(const T* a, std::size_t length_of_a, const T* b, std::size_t length_of_b) {
    const auto begin_a = reinterpret_cast<std::uintptr_t>(a), begin_b = reinterpret_cast<std::uintptr_t>(b);
    return begin_a + length_of_a * sizeof(T) <= begin_b || begin_b + length_of_b * sizeof(T) <= begin_a;
}

[[noreturn]] void throw_overlap(const char* a, const char* b) {
    throw_problem(joined(a, " and ", b), "arrays that overlap in part",
                  "separate arrays (in and out may also be the same, with one stride)",
                  "rotate into a separate array");
}

/// Runs may lie in the gaps of others, as members of one struct do, where their strides agree.
template <class T>
ZONAL_INLINE void check_apart(const Runs<T>& a, const Runs<T>& b) {
    if (a.count == 0 || b.count == 0 || are_apart(a.data, a.extent(), b.data, b.extent())) return;
    if (a.stride == b.stride) {
        const auto begin_a = reinterpret_cast<std::uintptr_t>(a.data);
        const auto begin_b = reinterpret_cast<std::uintptr_t>(b.data);
        const std::size_t period = a.stride * sizeof(T);
        const std::size_t b_after_a = begin_b >= begin_a ? (begin_b - begin_a) % period
                                                         : (period - (begin_a - begin_b) % period) % period;
        if (b_after_a >= a.length * sizeof(T) && period - b_after_a >= b.length * sizeof(T)) return;
    }
    throw_overlap(a.field, b.field);
}

std::size_t channels_of(int channels) {
    if (channels < 1)
        throw_problem("layout.channels", text_of(channels), "at least 1",
                      "give the number of channels of a vector");
    return static_cast<std::size_t>(channels);
}

/// The rotations of a call, and the kernel that turns by them.
template <class T>
struct Rotations {
    Runs<T> runs;
    batch::RotationForm form;
    bool is_one_for_all;
};

template <class T>
ZONAL_INLINE Rotations<T> rotations_of(const RotationMatrices<T>& rotations, std::size_t count) {
    return {checked_runs("rotations", rotations.values, count, 9, rotations.stride),
            batch::RotationForm::matrix, false};
}

template <class T>
ZONAL_INLINE Rotations<T> rotations_of(const RotationQuaternions<T>& rotations, std::size_t count) {
    return {checked_runs("rotations", rotations.values, count, 4, rotations.stride),
            rotations.order == QuaternionOrder::xyzw ? batch::RotationForm::quaternion_xyzw
                                                     : batch::RotationForm::quaternion_wxyz,
            false};
}

template <class T>
ZONAL_INLINE Rotations<T> rotations_of(const RotationMatrix<T>& rotation, std::size_t) {
    return {{"rotation", rotation.data(), 1, 9, 9}, batch::RotationForm::matrix, true};
}

/// What kernels need to know of the convention of a batch.
template <class T>
class Form {
  public:
    Form(std::optional<Convention> convention, int order) : convention_(convention) {
        if (!convention) return;
        const std::span<const Place> places = places_scaled_within_bands(*convention, order);
        is_scaled_ = !places.empty();
        for (std::size_t j = 0; j < places.size(); ++j) {
            coefficients_.index[j] = static_cast<unsigned char>(places[j].index);
            coefficients_.to_ours[j] = static_cast<T>(places[j].inverse);
            coefficients_.from_ours[j] = static_cast<T>(places[j].scale);
        }
    }

    /// The kernel's matrix of the one rotation of a batch, a copy; of several the identity.
    RotationMatrix<T> kernel_matrix(const Rotations<T>& rotations) const {
        if (!rotations.is_one_for_all) return {};
        const auto rotation = RotationMatrix<T>::from_row_major(rotations.runs.data);
        return convention_ ? kernel_rotation(*convention_, rotation) : rotation;
    }

    /// Of rotations for each vector; null where a kernel takes them as they are. kernel_rotation moves values
    /// and changes signs: what it makes of a matrix that numbers its values tells how. A quaternion becomes
    /// the matrix that acts on columns.
    const batch::MatrixForm<T>* matrices(const Rotations<T>& rotations) {
        if (!convention_ || rotations.is_one_for_all) return nullptr;
        const bool is_transposed =
            rotations.form != batch::RotationForm::matrix && *convention_ == Convention::kDirectX;
        const RotationMatrix<T> numbers = is_transposed ? RotationMatrix<T>(1, 4, 7, 2, 5, 8, 3, 6, 9)
                                                        : RotationMatrix<T>(1, 2, 3, 4, 5, 6, 7, 8, 9);
        const RotationMatrix<T> moved = kernel_rotation(*convention_, numbers);
        for (int i = 0; i < 9; ++i) {
            const int number = static_cast<int>(moved.data()[i]);
            matrices_.from[i] = static_cast<unsigned char>(std::abs(number) - 1);
            matrices_.sign[i] = static_cast<T>(number < 0 ? -1 : 1);
        }
        return moved == RotationMatrix<T>(1, 2, 3, 4, 5, 6, 7, 8, 9) ? nullptr : &matrices_;
    }

    /// Null where a kernel turns coefficients as they are.
    const batch::CoefficientForm<T>* coefficients() const { return is_scaled_ ? &coefficients_ : nullptr; }

  private:
    std::optional<Convention> convention_;
    bool is_scaled_ = false;
    batch::MatrixForm<T> matrices_;
    batch::CoefficientForm<T> coefficients_;
};

/// Where the vectors of a job begin that are `begin` behind its first.
template <class T>
batch::Job<T> part_of(const batch::Job<T>& job, std::size_t begin, std::size_t end, bool has_own_rotations) {
    batch::Job<T> part = job;
    if (has_own_rotations) part.rotations += begin * job.rotation_stride;
    if (job.shape == batch::Shape::planes) {
        part.in_begin += begin * job.in_stride;
        part.out_begin += begin * job.out_stride;
    } else {
        part.in += begin * job.in_stride;
        part.out += begin * job.out_stride;
    }
    part.count = end - begin;
    return part;
}

/// The whole job by the calling thread, or ranges of it by the executor.
template <class T>
void run(const batch::Kernel<T>& kernel, const batch::Job<T>& job, bool is_one_for_all,
         const Executor& executor) {
    const bool is_dense = job.shape == batch::Shape::interleaved && job.coefficient_form == nullptr;
    const std::size_t few = !is_one_for_all ? kernel.few_each : is_dense ? kernel.few_dense : kernel.few_all;
    const auto turn = [&, is_few = job.count <= few](const batch::Job<T>& part) {
        if (is_few) return batch::turn_few(kernel.order, part, is_one_for_all);
        is_one_for_all ? kernel.all(part) : kernel.each(part);
    };
    if (!executor) return turn(job);
    std::atomic<std::size_t> handed = 0;
    executor(job.count, [&](std::size_t begin, std::size_t end) {
        if (begin > end || end > job.count)
            throw_problem("executor", joined("a range from ", begin, " to ", end),
                          joined("ranges within 0 ... ", job.count),
                          "correct the executor, or use zonal::on_all_cores");
        handed += end - begin;
        turn(part_of(job, begin, end, !is_one_for_all));
    });
    if (handed != job.count)
        throw_problem("executor", joined("ranges of ", handed.load(), " vectors in all"), text_of(job.count),
                      "correct the executor, or use zonal::on_all_cores; some vectors were turned");
}

template <class T, class AnyRotations>
void checked_rotate(int order, const AnyRotations& rotations, const BatchLayout& layout,
                    std::span<const T> in, std::span<T> out, const Executor& executor) {
    const batch::Kernel<T>& kernel = kernel_of<T>(order);
    Form<T> form(layout.convention, order);
    const Rotations<T> given = rotations_of(rotations, layout.count);
    const std::size_t channels = channels_of(layout.channels);
    const std::size_t coefficients = static_cast<std::size_t>(order) * order - (layout.dc_apart ? 1 : 0);
    const std::size_t length = channels * coefficients;
    const std::size_t stride = layout.stride == 0 ? length : layout.stride;
    const std::size_t out_stride = layout.out_stride == 0 ? stride : layout.out_stride;
    const Runs<T> from = checked_runs("in", in, layout.count, length, stride);
    const Runs<T> to = checked_runs<T>("out", out, layout.count, length, out_stride);
    const bool is_in_place = from.data == to.data && stride == out_stride;
    if (!is_in_place) check_apart(from, to);
    if (!given.is_one_for_all) check_apart(given.runs, to);
    const std::size_t moved = (2 * length * layout.count + given.runs.length * given.runs.count) * sizeof(T);
    const bool is_interleaved = channels > 1 && layout.arrangement == ChannelArrangement::interleaved;

    const bool is_large = moved > batch::streamed_bytes();
    const RotationMatrix<T> one = form.kernel_matrix(given);
    const batch::Job<T> job{.rotations = given.is_one_for_all ? one.data() : given.runs.data,
                            .rotation_stride = given.runs.stride,
                            .form = given.form,
                            .matrix_form = form.matrices(given),
                            .coefficient_form = form.coefficients(),
                            .shape = is_interleaved ? batch::Shape::interleaved : batch::Shape::rows,
                            .count = length == 0 ? 0 : layout.count,
                            .channels = channels,
                            .in = from.data,
                            .out = out.data(),
                            .in_planes = nullptr,
                            .out_planes = nullptr,
                            .in_begin = 0,
                            .out_begin = 0,
                            .in_stride = stride,
                            .out_stride = out_stride,
                            .is_dc_apart = layout.dc_apart,
                            .is_large = is_large,
                            .is_streamed = is_large && out_stride == length && !is_in_place};
    run(kernel, job, given.is_one_for_all, executor);
}

/// Pointers to the planes of all coefficients; the first of none where band 0 is apart.
template <class T>
using PlanePointers = std::array<T*, batch::kMostCoefficients>;

template <class T>
PlanePointers<T> checked_planes(const char* field, const Planes<T>& planes, std::size_t coefficients,
                                bool is_dc_apart, const Runs<T>& of_one) {
    const std::size_t first = is_dc_apart ? 1 : 0, count = coefficients - first;
    PlanePointers<T> pointers = {};
    if (planes.are_pointers()) {
        if (planes.pointers().size() != count)
            throw_problem(joined("planes of ", field), text_of(planes.pointers().size()),
                          joined(count, ", one for each coefficient"), "pass a pointer to each plane");
        std::ranges::copy(planes.pointers(), pointers.begin() + first);
        for (std::size_t i = first; i < coefficients; ++i) {
            check_address({"plane ", field, static_cast<std::ptrdiff_t>(i - first)}, pointers[i]);
            if (pointers[i] == nullptr && of_one.count > 0)
                throw_problem(joined("plane ", i - first, " of ", field), "a null pointer", "an array",
                              "pass a pointer to each plane");
        }
        if (!holds(kMostSize / sizeof(T) / 2, of_one.count, of_one.length, of_one.stride))
            throw_problem("layout.count", text_of(of_one.count), "as many vectors as a plane can hold",
                          "give the number of vectors");
        return pointers;
    }
    check_stride({"the planes of ", field}, planes.stride(), of_one.extent());
    checked_runs<std::remove_const_t<T>>({"planes of ", field}, planes.values(),
                                         of_one.count == 0 ? 0 : count, of_one.extent(), planes.stride());
    for (std::size_t i = 0; i < count; ++i)
        pointers[first + i] = planes.values().data() + (of_one.count == 0 ? 0 : i * planes.stride());
    return pointers;
}

/// Planes that are met in ascending order and apart from those of `others` need no closer look.
template <class T>
void check_apart(std::span<const T* const> in, std::span<T* const> out, std::size_t extent_of_in,
                 std::size_t extent_of_out, bool is_in_place) {
    const auto ends_before = [](const T* a, std::size_t extent, const T* b) {
        return reinterpret_cast<std::uintptr_t>(a) + extent * sizeof(T) <=
               reinterpret_cast<std::uintptr_t>(b);
    };
    bool is_ascending = true;
    for (std::size_t i = 1; i < out.size(); ++i)
        is_ascending = is_ascending && ends_before(out[i - 1], extent_of_out, out[i]);
    if (!is_ascending)
        for (std::size_t i = 0; i < out.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (!are_apart<T>(out[i], extent_of_out, out[j], extent_of_out))
                    throw_overlap("planes of out", "planes of out");
    if (is_in_place || out.empty()) return;
    const auto [first_in, last_in] = std::ranges::minmax(in);
    const auto [first_out, last_out] = std::ranges::minmax(out);
    if (ends_before(last_in, extent_of_in, first_out) || ends_before(last_out, extent_of_out, first_in))
        return;
    for (const T* a : in)
        for (const T* b : out)
            if (!are_apart(a, extent_of_in, b, extent_of_out)) throw_overlap("planes of in", "planes of out");
}

template <class T, class AnyRotations>
void checked_rotate(int order, const AnyRotations& rotations, const PlanarLayout& layout,
                    const Planes<const T>& in, const Planes<T>& out, const Executor& executor) {
    const batch::Kernel<T>& kernel = kernel_of<T>(order);
    Form<T> form(layout.convention, order);
    const Rotations<T> given = rotations_of(rotations, layout.count);
    const std::size_t channels = channels_of(layout.channels);
    const std::size_t stride = layout.stride == 0 ? channels : layout.stride;
    const std::size_t out_stride = layout.out_stride == 0 ? stride : layout.out_stride;
    check_stride("layout", stride, channels);
    check_stride("the output's layout", out_stride, channels);
    const std::size_t coefficients = static_cast<std::size_t>(order) * order, first = layout.dc_apart ? 1 : 0;
    const Runs<const T> of_in{"in", nullptr, layout.count, channels, stride};
    const Runs<T> of_out{"out", nullptr, layout.count, channels, out_stride};
    const PlanePointers<const T> from = checked_planes("in", in, coefficients, layout.dc_apart, of_in);
    const PlanePointers<T> to = checked_planes("out", out, coefficients, layout.dc_apart, of_out);
    const std::span<const T* const> planes_in(from.data() + first, coefficients - first);
    const std::span<T* const> planes_out(to.data() + first, coefficients - first);
    if (layout.count > 0) {
        const bool is_in_place =
            stride == out_stride && std::equal(planes_in.begin(), planes_in.end(), planes_out.begin());
        check_apart(planes_in, planes_out, of_in.extent(), of_out.extent(), is_in_place);
        if (!given.is_one_for_all)
            for (const T* plane : planes_out)
                check_apart(given.runs, Runs<T>{"out", plane, layout.count, channels, out_stride});
    }

    // By one rotation channels that touch are turned as vectors are.
    const bool are_vectors = given.is_one_for_all && stride == channels && out_stride == channels;
    const RotationMatrix<T> one = form.kernel_matrix(given);
    const batch::Job<T> job{.rotations = given.is_one_for_all ? one.data() : given.runs.data,
                            .rotation_stride = given.runs.stride,
                            .form = given.form,
                            .matrix_form = form.matrices(given),
                            .coefficient_form = form.coefficients(),
                            .shape = batch::Shape::planes,
                            .count = are_vectors ? layout.count * channels : layout.count,
                            .channels = are_vectors ? 1 : channels,
                            .in = nullptr,
                            .out = nullptr,
                            .in_planes = from.data(),
                            .out_planes = to.data(),
                            .in_begin = 0,
                            .out_begin = 0,
                            .in_stride = are_vectors ? 1 : stride,
                            .out_stride = are_vectors ? 1 : out_stride,
                            .is_dc_apart = layout.dc_apart,
                            .is_large = false,
                            .is_streamed = false};
    run(kernel, job, given.is_one_for_all, executor);
}

template <class T, class AnyRotations>
void checked_rotate(int order, const AnyRotations& rotations, std::span<const Rgb<T>> in,
                    std::span<Rgb<T>> out, const Executor& executor) {
    kernel_of<T>(order);
    const std::size_t length = static_cast<std::size_t>(order) * order;
    if (in.size() % length != 0)
        throw_problem(joined("length of in for order ", order), text_of(in.size()),
                      joined("a multiple of ", length, ", the colours of one vector"),
                      "pass whole vectors, or the order that belongs to the data");
    if (out.size() != in.size())
        throw_problem("length of out", text_of(out.size()), joined(in.size(), ", as in has"),
                      "pass as many colours");
    checked_rotate(order, rotations, BatchLayout{.count = in.size() / length, .channels = 3}, values_of(in),
                   values_of(out), executor);
}

}  // namespace

#define ZONAL_ROTATE_EACH(T, Rotations)                                                           \
    void rotate_each(int order, const Rotations<T>& rotations, const BatchLayout& layout,         \
                     std::span<const T> in, std::span<T> out, const Executor& executor) {         \
        checked_rotate(order, rotations, layout, in, out, executor);                              \
    }                                                                                             \
    void rotate_each(int order, const Rotations<T>& rotations, const PlanarLayout& layout,        \
                     const Planes<const T>& in, const Planes<T>& out, const Executor& executor) { \
        checked_rotate(order, rotations, layout, in, out, executor);                              \
    }                                                                                             \
    void rotate_each(int order, const Rotations<T>& rotations, std::span<const Rgb<T>> in,        \
                     std::span<Rgb<T>> out, const Executor& executor) {                           \
        checked_rotate(order, rotations, in, out, executor);                                      \
    }
ZONAL_ROTATE_EACH(float, RotationMatrices)
ZONAL_ROTATE_EACH(double, RotationMatrices)
ZONAL_ROTATE_EACH(float, RotationQuaternions)
ZONAL_ROTATE_EACH(double, RotationQuaternions)
#undef ZONAL_ROTATE_EACH

#define ZONAL_ROTATE_ALL(T)                                                                      \
    void rotate_all(int order, const RotationMatrix<T>& rotation, const BatchLayout& layout,     \
                    std::span<const T> in, std::span<T> out, const Executor& executor) {         \
        checked_rotate(order, rotation, layout, in, out, executor);                              \
    }                                                                                            \
    void rotate_all(int order, const RotationMatrix<T>& rotation, const PlanarLayout& layout,    \
                    const Planes<const T>& in, const Planes<T>& out, const Executor& executor) { \
        checked_rotate(order, rotation, layout, in, out, executor);                              \
    }                                                                                            \
    void rotate_all(int order, const RotationMatrix<T>& rotation, std::span<const Rgb<T>> in,    \
                    std::span<Rgb<T>> out, const Executor& executor) {                           \
        checked_rotate(order, rotation, in, out, executor);                                      \
    }
ZONAL_ROTATE_ALL(float)
ZONAL_ROTATE_ALL(double)
#undef ZONAL_ROTATE_ALL

}  // namespace zonal
