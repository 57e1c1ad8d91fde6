#include "support/accuracy.hpp"

#include <stdexcept>

namespace zonal::accuracy {

Error compare(int order, const oracle::Rotation& exact, const oracle::Matrix3& rotation,
              const std::vector<oracle::Real>& f, const std::vector<oracle::Real>& result) {
    const std::vector<oracle::Real> expected = exact(rotation, f);
    oracle::Real difference = 0, norm = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
        difference += (result[i] - expected[i]) * (result[i] - expected[i]);
        norm += f[i] * f[i];
    }
    Error error;
    // A vector of zeros must come out as zeros: any difference counts in full.
    error.relative = static_cast<double>(std::sqrt(norm > 0 ? difference / norm : difference));
    error.excused = static_cast<double>((order - 1) * oracle::orthonormality_error(rotation) / 2);
    return error;
}

double zhf_contract(int order, bool is_float) {
    struct Point {
        int order;
        double float_bound, double_bound;
    };
    static const std::vector<Point> points{{3, 6e-7, 2e-14}, {4, 1e-6, 3e-14}, {5, 2e-6, 4e-14},
                                           {6, 3e-6, 6e-14}, {8, 5e-6, 1e-13}, {10, 8e-6, 1e-13},
                                           {20, 3e-5, 1e-12}};
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const Point &a = points[k], &b = points[k + 1];
        if (order < a.order || order > b.order) continue;
        const double t = static_cast<double>(order - a.order) / (b.order - a.order);
        return is_float ? a.float_bound + t * (b.float_bound - a.float_bound)
                        : a.double_bound + t * (b.double_bound - a.double_bound);
    }
    throw std::out_of_range("no contract for this order");
}

}  // namespace zonal::accuracy
