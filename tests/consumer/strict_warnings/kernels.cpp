// Kernels of every kind, instantiated: templates warn only then.
#include "all_headers.hpp"
#include "zonal/order03.hpp"
#include "zonal/order04.hpp"

template <class T>
void use_all(const T* rotation, const T* f, T* out) {
    zonal::order4::rotate(rotation, f, out);
    zonal::order4::rotate_accurate(rotation, f, out);
    zonal::order4::rotate_zhf(rotation, f, out);
    zonal::order4::factorize(f, out);
    zonal::order4::expand(f, out);
    zonal::order4::resample(f, out);
    zonal::order4::lobes(rotation, out);
    zonal::order4::blocks(rotation, out);
    zonal::order3::rotate(rotation, f, out);
    zonal::Rgb<T> colours[16];
    zonal::order4::rotate<T, zonal::Rgb<T>>(rotation, colours, colours);
}
template void use_all(const float*, const float*, float*);
template void use_all(const double*, const double*, double*);

bool use_templates(const Eigen::Matrix3d& matrix, zonal::EnvironmentMap& map) {
    const zonal::RotationMatrix<float> single(matrix);
    const zonal::RotationMatrix<double> twice{Eigen::Quaterniond(matrix)};
    const zonal::Direction direction = Eigen::Vector3f(1, 0, 0);
    const Eigen::Vector3d vector = direction;
    map.at(1, 2) = map.at(0, 0).cast<double>().cast<float>();
    return zonal::is_mirror(zonal::checked_rotation(single, 1e-6)) && single.cast<double>() == twice &&
           single.matrix()(0, 0) > 0 && vector.x() > 0;
}
