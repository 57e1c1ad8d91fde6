#pragma once

// What passes between the door (compiled for every processor) and the kernels (each compiled for one
// instruction set): plain data only, so that neither side instantiates a function of the other.

#include <cstddef>

namespace zonal::batch {

enum class RotationForm { matrix, quaternion_xyzw, quaternion_wxyz };

/// How the vectors of a job lie.
enum class Shape {
    rows,         ///< coefficients touch; channels, if there are several, follow one another
    interleaved,  ///< several channels of a coefficient touch
    planes,       ///< one array a coefficient, channels of a vector touch in each
};

/// What makes of a convention's matrices those of a kernel: value i is sign[i] times value from[i].
template <class T>
struct MatrixForm {
    unsigned char from[9];
    T sign[9];
};

/// What makes of a convention's coefficients ours where a matrix alone does not: coefficient index[j] of ours
/// is to_ours[j] times their j, which is from_ours[j] times it.
template <class T>
struct CoefficientForm {
    static constexpr int kMost = 16;
    unsigned char index[kMost];
    T to_ours[kMost], from_ours[kMost];
};

/// One checked call. `rotations` holds `count` rotations for `each`, one for `all`.
template <class T>
struct Job {
    const T* rotations;
    std::size_t rotation_stride;
    RotationForm form;
    const MatrixForm<T>* matrix_form;            ///< of rotations for `each`; null: as they are
    const CoefficientForm<T>* coefficient_form;  ///< null: as they are

    Shape shape;
    std::size_t count;
    std::size_t channels;
    const T* in;  ///< not of planes
    T* out;
    const T* const* in_planes;  ///< of planes: order^2 arrays, the first of no meaning where band 0 is apart
    T* const* out_planes;
    std::size_t in_begin, out_begin;    ///< of planes: where the first vector lies in each array
    std::size_t in_stride, out_stride;  ///< from one vector to the next
    bool is_dc_apart;
    bool is_large;     ///< larger than the caches
    bool is_streamed;  ///< write past the caches; only rows or interleaved that touch, `in` not `out`
};

template <class T>
struct Kernel {
    int order;
    void (*each)(const Job<T>&);
    void (*all)(const Job<T>&);
    /// Batches of no more vectors take less time one by one: with rotations of their own, by one, and by one
    /// where channels are turned densely.
    std::size_t few_each, few_all, few_dense;
};

template <class T>
struct KernelTable {
    const Kernel<T>* kernels;
    int count;
};

}  // namespace zonal::batch
