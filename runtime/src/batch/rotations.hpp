#pragma once

// The rotations of a pack, a lane each, as matrices of determinant +1 where the kernel needs them so.

#include "job.hpp"
#include "pack.hpp"
#include "transpose.hpp"

namespace zonal::batch {
namespace {

/// Values of a rotation.
HWY_INLINE constexpr std::size_t rotation_length(RotationForm form) {
    return form == RotationForm::matrix ? 9 : 4;
}

/// Matrices of the quaternions w + x i + y j + z k.
template <class T>
HWY_INLINE void matrices_of(Pack<T> x, Pack<T> y, Pack<T> z, Pack<T> w, Pack<T>* R) {
    using P = Pack<T>;
    const P x2 = x + x, y2 = y + y, z2 = z + z;
    const P xx = x2 * x, xy = x2 * y, xz = x2 * z, xw = x2 * w;
    const P yy = y2 * y, yz = y2 * z, yw = y2 * w;
    const P zz = z2 * z, zw = z2 * w;
    const P one(1);
    R[0] = one - (yy + zz);
    R[1] = xy - zw;
    R[2] = xz + yw;
    R[3] = xy + zw;
    R[4] = one - (xx + zz);
    R[5] = yz - xw;
    R[6] = xz - yw;
    R[7] = yz + xw;
    R[8] = one - (xx + yy);
}

template <class T>
HWY_INLINE void matrices_of(const Pack<T>* q, RotationForm form, Pack<T>* R) {
    if (form == RotationForm::quaternion_xyzw)
        matrices_of(q[0], q[1], q[2], q[3], R);
    else
        matrices_of(q[1], q[2], q[3], q[0], R);
}

template <class T>
HWY_NOINLINE void write_in_form(const MatrixForm<T>& form, const Pack<T>* given, Pack<T>* R) {
    for (int i = 0; i < 9; ++i)
        R[i].lanes = hn::Mul(hn::Set(Tag<T>(), form.sign[i]), given[form.from[i]].lanes);
}

/// Goes by way of copies: R itself can stay in registers then.
template <class T>
HWY_INLINE void bring_to_form(const MatrixForm<T>& form, Pack<T>* R) {
    Pack<T> given[9], moved[9];
    for (int i = 0; i < 9; ++i) given[i] = R[i];
    write_in_form(form, given, moved);
    for (int i = 0; i < 9; ++i) R[i] = moved[i];
}

/// The rotations of kLanes rows. kAreTouching: without gaps and in our form.
template <bool kAreTouching, class T>
HWY_INLINE void load_rotations(const Job<T>& job, const T* rows, Pack<T>* R) {
    if (HWY_LIKELY(job.form == RotationForm::matrix)) {
        read_columns<9>(rows, kAreTouching ? 9 : job.rotation_stride, R);
    } else {
        Pack<T> q[4];
        read_columns<4>(rows, kAreTouching ? 4 : job.rotation_stride, q);
        matrices_of(q, job.form, R);
    }
    if constexpr (!kAreTouching)
        if (HWY_UNLIKELY(job.matrix_form != nullptr)) bring_to_form(*job.matrix_form, R);
}

/// What makes rotations proper, where the kernel needs them so: the sign of each determinant, +1 for a NaN. A
/// mirror is a rotation by -R with odd bands negated.
template <class T, int N, bool kMayMirror>
class Sign {
  public:
    /// Multiplies R by the signs.
    HWY_INLINE void take_from(Pack<T>* R, RotationForm form) {
        if constexpr (kMayMirror) {
            if (form != RotationForm::matrix) return;
            const Pack<T> determinant =
                R[0] * fma(R[4], R[8], -(R[5] * R[7])) +
                (R[1] * fma(R[5], R[6], -(R[3] * R[8])) + R[2] * fma(R[3], R[7], -(R[4] * R[6])));
            const auto is_mirror = hn::Lt(determinant.lanes, hn::Zero(Tag<T>()));
            has_mirror_ = !hn::AllFalse(Tag<T>(), is_mirror);
            sign_.lanes = hn::IfThenElse(is_mirror, Pack<T>(-1).lanes, Pack<T>(1).lanes);
            if (HWY_LIKELY(!has_mirror_)) return;
            for (int i = 0; i < 9; ++i) R[i] = sign_ * R[i];
        }
    }

    /// The kernel is linear: negating odd bands before it is as good as after.
    HWY_INLINE void negate_odd_bands(Pack<T>* f) const {
        if constexpr (kMayMirror) {
            if (HWY_LIKELY(!has_mirror_)) return;
            for (int l = 1; l < N; l += 2)
                for (int i = l * l; i < (l + 1) * (l + 1); ++i) f[i] = sign_ * f[i];
        }
    }

    /// Every lane as `lane` of another pack's.
    HWY_INLINE void broadcast(const Sign& signs, std::size_t lane) {
        if constexpr (kMayMirror) {
            has_mirror_ = signs.has_mirror_;
            if (HWY_LIKELY(!has_mirror_)) return;
            HWY_ALIGN T lanes[kLanes<T>];
            hn::Store(signs.sign_.lanes, Tag<T>(), lanes);
            sign_.lanes = hn::Set(Tag<T>(), lanes[lane]);
        }
    }

  private:
    Pack<T> sign_ = Pack<T>(1);
    bool has_mirror_ = false;
};

}  // namespace
}  // namespace zonal::batch
