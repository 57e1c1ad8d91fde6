#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

namespace zonal::test {

/// Where a direction lies on a face of a cube: s and t in [0, 1] on the face itself.
struct FacePoint {
    int face = 0;
    double s = 0, t = 0;
};

/// The Vulkan specification, "Cube Map Face Selection and Transformations": signed s and t over the major
/// axis, of a face that is given.
inline FacePoint project_onto_face(int face, const Eigen::Vector3d& r) {
    struct Axes {
        double s, t, major;
    };
    const std::array<Axes, 6> axes{{{-r.z(), -r.y(), r.x()},
                                    {r.z(), -r.y(), r.x()},
                                    {r.x(), r.z(), r.y()},
                                    {r.x(), -r.z(), r.y()},
                                    {r.x(), -r.y(), r.z()},
                                    {-r.x(), -r.y(), r.z()}}};
    const auto [s, t, major] = axes[face];
    return {face, (s / std::abs(major) + 1) / 2, (t / std::abs(major) + 1) / 2};
}

/// The same of the face that the direction meets: z before y before x where components are equal.
inline FacePoint project_onto_cube(const Eigen::Vector3d& r) {
    const Eigen::Vector3d size = r.cwiseAbs();
    const int axis = size.z() >= size.x() && size.z() >= size.y() ? 2 : size.y() >= size.x() ? 1 : 0;
    return project_onto_face(2 * axis + (r[axis] < 0 ? 1 : 0), r);
}

}  // namespace zonal::test
