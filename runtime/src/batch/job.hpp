#pragma once

// What passes between the door (compiled for every processor) and the kernels (each compiled for one
// instruction set): plain data only, so that neither side instantiates a function of the other.

#include <cstddef>

namespace zonal::batch {

enum class RotationForm { matrix, quaternion };

/// One checked call. `rotations` holds `count` rotations for `each`, one for `all`.
template <class T>
struct Job {
    const T* rotations;
    std::size_t rotation_stride;
    RotationForm form;
    const T* in;
    T* out;
    std::size_t count;
    std::size_t stride;
    std::size_t channels;
    bool is_interleaved;  ///< never with one channel
    bool is_dc_apart;
    bool is_large;     ///< larger than the caches
    bool is_streamed;  ///< write past the caches; only where vectors touch and `in` is not `out`
};

template <class T>
struct Kernel {
    int order;
    void (*each)(const Job<T>&);
    void (*all)(const Job<T>&);
};

template <class T>
struct KernelTable {
    const Kernel<T>* kernels;
    int count;
};

}  // namespace zonal::batch
