#include "search/angle_model.hpp"

#include <Eigen/LU>
#include <cmath>

#include "exact/spherical_harmonics.hpp"
#include "search/score.hpp"

namespace zonal::search {

BandDerivatives differentiate_band(int l, double theta, double phi) {
    // On the meridian phi = 0, y_l^m is the profile p_m of theta alone, and
    //   2 dp_m/dtheta = sqrt((l+m)(l-m+1)) p_{m-1} - sqrt((l-m)(l+m+1)) p_{m+1},
    // where p_0 counts sqrt(2) times as a neighbour, since the others carry the sqrt(2) of eq. 1.
    const exact::Vector<double> meridian =
        exact::evaluate_band<double>(l, {std::sin(theta), 0.0, std::cos(theta)});
    const auto profile = [&](int m) { return m > l ? 0.0 : meridian(l + m); };
    const auto up = [&](int m) { return std::sqrt((l - m) * (l + m + 1.0)); };
    BandDerivatives band{exact::Vector<double>(2 * l + 1), exact::Vector<double>(2 * l + 1),
                         exact::Vector<double>(2 * l + 1)};
    band.values(l) = profile(0);
    band.by_theta(l) = -up(0) * profile(1) / std::sqrt(2.0);
    band.by_phi(l) = 0;
    for (int m = 1; m <= l; ++m) {
        const double below = profile(m - 1) * (m == 1 ? std::sqrt(2.0) : 1.0);
        const double slope = 0.5 * (up(m - 1) * below - up(m) * profile(m + 1));
        const double cosine = std::cos(m * phi), sine = std::sin(m * phi);
        band.values(l + m) = profile(m) * cosine;
        band.values(l - m) = profile(m) * sine;
        band.by_theta(l + m) = slope * cosine;
        band.by_theta(l - m) = slope * sine;
        band.by_phi(l + m) = -m * band.values(l - m);
        band.by_phi(l - m) = m * band.values(l + m);
    }
    return band;
}

bool AngleModel::evaluate(const std::vector<double>& angles) {
    is_lobe_at_pole_.clear();
    for (std::size_t i = 0; i < angles.size(); i += 2) is_lobe_at_pole_.push_back(is_at_pole(angles[i]));
    for (std::size_t b = 0; b < bands_.size(); ++b) {
        const int l = problem_.bands[b], size = 2 * l + 1;
        Band& band = bands_[b];
        exact::Matrix<double> y(size, size);
        band.by_theta.resize(size, size);
        band.by_phi.resize(size, size);
        for (int d = 0; d < size; ++d) {
            const BandDerivatives row = differentiate_band(l, angles[2 * d], angles[2 * d + 1]);
            y.row(d) = row.values;
            band.by_theta.row(d) = row.by_theta;
            band.by_phi.row(d) = row.by_phi;
        }
        band.a_hat = y.inverse();
        if (!(band.a_hat.squaredNorm() < kSingularSquaredNorm)) return false;
    }
    return true;
}

std::vector<exact::Matrix<double>> AngleModel::a_hats() const {
    std::vector<exact::Matrix<double>> a_hats;
    for (const Band& band : bands_) a_hats.push_back(band.a_hat);
    return a_hats;
}

exact::Vector<double> AngleModel::residual_gradient(const Relation& relation) const {
    const Band& band = bands_[relation.band_index];
    const auto column = band.a_hat.col(relation.column);
    const exact::Vector<double> by_theta = band.by_theta * column, by_phi = band.by_phi * column;
    exact::Vector<double> gradient = exact::Vector<double>::Zero(2 * problem_.lobe_count);
    for (int d = 0; d < band.a_hat.cols(); ++d) {
        double weight = -band.a_hat(relation.row, d);
        if (relation.other_row >= 0) weight += relation.sign * band.a_hat(relation.other_row, d);
        gradient(2 * d) = weight * by_theta(d);
        gradient(2 * d + 1) = weight * by_phi(d);
    }
    return gradient;
}

exact::Matrix<double> AngleModel::jacobian(const Pattern& pattern) const {
    // Entry (d, column): g^T Â of lobe d, as in `residual_gradient` but for all columns at once.
    std::vector<exact::Matrix<double>> slopes_by_theta, slopes_by_phi;
    for (const Band& band : bands_) {
        slopes_by_theta.push_back(band.by_theta * band.a_hat);
        slopes_by_phi.push_back(band.by_phi * band.a_hat);
    }
    exact::Matrix<double> jacobian = exact::Matrix<double>::Zero(pattern.size(), 2 * problem_.lobe_count);
    for (std::size_t r = 0; r < pattern.size(); ++r) {
        const auto [band_index, row, column, other_row, sign] = pattern[r];
        const exact::Matrix<double>& a_hat = bands_[band_index].a_hat;
        for (int d = 0; d < a_hat.cols(); ++d) {
            if (is_lobe_at_pole_[d]) continue;
            const double weight = (other_row < 0 ? 0 : sign * a_hat(other_row, d)) - a_hat(row, d);
            jacobian(r, 2 * d) = weight * slopes_by_theta[band_index](d, column);
            jacobian(r, 2 * d + 1) = weight * slopes_by_phi[band_index](d, column);
        }
    }
    return jacobian;
}

double AngleModel::log_norm(double weight, double* gradient) const {
    double sum = 0;
    for (const Band& band : bands_) {
        const double square = band.a_hat.squaredNorm();
        sum += 0.5 * std::log2(square);
        // d ||Â||^2 = -2 <Â^T Â Â^T, dY>
        const exact::Matrix<double> slope = band.a_hat.transpose() * band.a_hat * band.a_hat.transpose();
        const double factor = -weight / (square * std::log(2.0));
        for (int d = 0; d < slope.rows(); ++d) {
            gradient[2 * d] += factor * slope.row(d).dot(band.by_theta.row(d));
            gradient[2 * d + 1] += factor * slope.row(d).dot(band.by_phi.row(d));
        }
    }
    return sum;
}

}  // namespace zonal::search
