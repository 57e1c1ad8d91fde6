// Few vectors: a pack would have too many empty lanes.

#include "few.hpp"

#include <utility>

#include "core/unchecked.hpp"
#include "most_coefficients.hpp"
#include "zonal/batch.hpp"

namespace zonal::batch {
namespace {

template <class T>
RotationMatrix<T> rotation_of(const Job<T>& job, const T* values) {
    const auto rotation = [&] {
        if (job.form == RotationForm::matrix) return RotationMatrix<T>::from_row_major(values);
        if (job.form == RotationForm::quaternion_xyzw)
            return RotationMatrix<T>::from_quaternion_xyzw(values[0], values[1], values[2], values[3]);
        return RotationMatrix<T>::from_quaternion_wxyz(values[0], values[1], values[2], values[3]);
    }();
    if (job.matrix_form == nullptr) return rotation;
    T moved[9];
    for (int i = 0; i < 9; ++i)
        moved[i] = job.matrix_form->sign[i] * rotation.data()[job.matrix_form->from[i]];
    return RotationMatrix<T>::from_row_major(moved);
}

/// Coefficient i of one channel of vector k, counted from 1 where band 0 is apart.
template <class T>
std::pair<const T*, T*> places_of(const Job<T>& job, std::size_t count, std::size_t i, std::size_t channel,
                                  std::size_t k) {
    const std::size_t column = i - (job.is_dc_apart ? 1 : 0);
    if (job.shape == Shape::planes)
        return {job.in_planes[i] + job.in_begin + k * job.in_stride + channel,
                job.out_planes[i] + job.out_begin + k * job.out_stride + channel};
    const std::size_t place =
        job.shape == Shape::interleaved ? column * job.channels + channel : channel * count + column;
    return {job.in + k * job.in_stride + place, job.out + k * job.out_stride + place};
}

/// One channel by way of the stack.
template <class T>
void turn_copy(int order, const Job<T>& job, const RotationMatrix<T>& rotation, std::size_t channel,
               std::size_t k) {
    const std::size_t first = job.is_dc_apart ? 1 : 0, coefficients = static_cast<std::size_t>(order) * order;
    T f[kMostCoefficients];
    f[0] = 0;
    const CoefficientForm<T>* const form = job.coefficient_form;
    for (std::size_t i = first; i < coefficients; ++i) {
        const T value = *places_of(job, coefficients - first, i, channel, k).first;
        f[form ? form->index[i] : i] = form ? form->to_ours[i] * value : value;
    }
    rotate_unchecked(order, rotation, f, f);
    for (std::size_t i = first; i < coefficients; ++i) {
        T& value = *places_of(job, coefficients - first, i, channel, k).second;
        value = form ? form->from_ours[i] * f[form->index[i]] : f[i];
    }
}

}  // namespace

template <class T>
void turn_few(int order, const Job<T>& job, bool is_one_for_all) {
    const bool is_plain = !job.is_dc_apart && job.coefficient_form == nullptr;
    const bool is_colours = job.shape == Shape::interleaved && job.channels == 3;
    RotationMatrix<T> rotation;
    for (std::size_t k = 0; k < job.count; ++k) {
        if (k == 0 || !is_one_for_all) rotation = rotation_of(job, job.rotations + k * job.rotation_stride);
        const std::size_t in_begin = k * job.in_stride, out_begin = k * job.out_stride;  // not of planes
        if (is_plain && job.shape == Shape::rows) {
            const std::size_t length = static_cast<std::size_t>(order) * order;
            for (std::size_t begin = 0; begin < length * job.channels; begin += length)
                rotate_unchecked(order, rotation, job.in + in_begin + begin, job.out + out_begin + begin);
        } else if (is_plain && is_colours) {
            rotate_unchecked(order, rotation, reinterpret_cast<const Rgb<T>*>(job.in + in_begin),
                             reinterpret_cast<Rgb<T>*>(job.out + out_begin));
        } else {
            for (std::size_t channel = 0; channel < job.channels; ++channel)
                turn_copy(order, job, rotation, channel, k);
        }
    }
}
template void turn_few(int, const Job<float>&, bool);
template void turn_few(int, const Job<double>&, bool);

}  // namespace zonal::batch
