#include "search/angle_walk.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace zonal::search {
namespace {

using exact::Matrix;
using exact::Vector;

/// A derivative below this is zero: the entry stays as it is to first order.
constexpr double kFlat = 1e-7;

/// Lobes whose heights differ by less than this are on one parallel; this near the pole, they are on it.
constexpr double kAlike = 1e-7;

/// Entries that are farther away than this, in radians along the freedom, are not tried.
constexpr double kReach = 1.5;

/// Nonzeros that are tried at most in one move, and how often one after another in vain.
constexpr int kMostGains = 6, kMostTrials = 3;

}  // namespace

/// Evaluates the model there. A lobe that comes to the pole is put on it. False when a band is singular.
bool AngleWalk::go_to(std::vector<double> angles) {
    for (std::size_t i = 0; i < angles.size(); i += 2)
        if (std::abs(std::sin(angles[i])) < kAlike) angles[i] = angles[i + 1] = 0;
    angles_ = std::move(angles);
    ++evaluations_;
    return model_.evaluate(angles_);
}

/// As `Score::cost`, from the inverses in double.
double AngleWalk::cost(const std::vector<Matrix<double>>& a_hats) const {
    Score score;
    score.condition = 0;
    for (std::size_t b = 0; b < a_hats.size(); ++b) {
        const int size = static_cast<int>(a_hats[b].cols());
        score.bands.emplace_back(problem_->bands[b], band_cost(a_hats[b].data(), size));
        const Eigen::SelfAdjointEigenSolver<Matrix<double>> squares(a_hats[b].transpose() * a_hats[b],
                                                                    Eigen::EigenvaluesOnly);
        const Vector<double> values = squares.eigenvalues();
        if (!(values(0) > 0)) return std::numeric_limits<double>::infinity();
        score.condition = std::max(score.condition, std::sqrt(values(size - 1) / values(0)));
    }
    return score.cost(objective_);
}

AngleWalk::Place AngleWalk::here() const {
    const std::vector<Matrix<double>> a_hats = model_.a_hats();
    return {angles_, zeros_of(a_hats), cost(a_hats)};
}

void AngleWalk::start_from(const AngledSet& lobes) {
    [[maybe_unused]] const bool is_regular = go_to(angles_in_double(lobes));
    assert(is_regular);
    current_ = best_ = here();
}

/// To first order, from one decomposition of the Jacobian's transpose: what its columns span, and the rest.
/// Columns of the angles of lobes at the pole hold these.
AngleWalk::Freedom AngleWalk::freedom_of(const Pattern& pattern) const {
    const int angles = static_cast<int>(angles_.size()), relations = static_cast<int>(pattern.size());
    Matrix<double> columns = Matrix<double>::Zero(angles, relations + angles);
    columns.leftCols(relations) = model_.jacobian(pattern).transpose();
    const double norm = std::max(1.0, columns.norm());  // so that they count beside any other
    for (int i = 0; i < angles; ++i)
        if (is_at_pole(angles_[i - i % 2])) columns(i, relations + i) = norm;
    Eigen::ColPivHouseholderQR<Matrix<double>> decomposition;
    decomposition.setThreshold(kFlat);
    decomposition.compute(columns);
    const int rank = static_cast<int>(decomposition.rank());
    Freedom freedom;
    for (int i = 0; i < rank; ++i) {
        const int column = decomposition.colsPermutation().indices()(i);
        if (column < relations) freedom.independent.push_back(pattern[column]);
    }
    if (rank == angles) return freedom;
    freedom.directions = Matrix<double>::Zero(angles, angles - rank);
    freedom.directions.bottomRows(angles - rank).setIdentity();
    freedom.directions.applyOnTheLeft(decomposition.householderQ());
    return freedom;
}

/// Gives up the zeros that would break if one lobe, or all lobes of one parallel, were moved; and sometimes
/// most of those that another lobe would break.
Pattern AngleWalk::without_some(const Pattern& zeros) {
    const Matrix<double> jacobian = model_.jacobian(zeros);
    const int lobes = problem_->lobe_count;
    const int lobe = random_.below(lobes), angle = random_.below(2);
    Matrix<double> directions = Matrix<double>::Zero(2 * lobes, 2);
    const int kind = random_.below(3);
    if (kind == 0) {
        directions(2 * lobe + angle, 0) = 1;
    } else if (kind == 1) {
        directions(2 * lobe, 0) = directions(2 * lobe + 1, 1) = 1;
    } else {
        const double height = std::cos(angles_[2 * lobe]);
        for (int d = 0; d < lobes; ++d) {
            const double other = std::cos(angles_[2 * d]);
            if (std::abs(std::abs(other) - std::abs(height)) > kAlike) continue;
            const bool goes_along = angle == 0 ? other * height >= 0 : random_.chance(0.5);
            directions(2 * d + angle, 0) = goes_along ? 1 : -1;
        }
    }
    const Vector<double> breaks = (jacobian * directions).rowwise().norm();
    const int second = kind < 2 && random_.chance(0.3) ? random_.below(lobes) : -1;
    Pattern kept;
    for (std::size_t r = 0; r < zeros.size(); ++r) {
        if (breaks(r) > kFlat) continue;
        const bool breaks_with_second = second >= 0 && jacobian.row(r).segment(2 * second, 2).norm() > kFlat;
        if (!breaks_with_second || random_.chance(0.3)) kept.push_back(zeros[r]);
    }
    return kept;
}

/// A nonzero of a band >= 2 that the freedom can make zero; the nearer, the likelier.
std::optional<Relation> AngleWalk::draw_target(const Matrix<double>& freedom) {
    constexpr double kBlur = 0.15;
    const Pattern nonzeros = nonzeros_of(*problem_, model_.a_hats());
    const Vector<double> slopes = (model_.jacobian(nonzeros) * freedom).rowwise().norm();
    std::optional<Relation> target;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < nonzeros.size(); ++i) {
        const double distance = std::abs(model_.residual(nonzeros[i])) / slopes(i);
        if (!(slopes(i) > 1e-6) || distance > kReach) continue;
        const double blurred = distance - kBlur * std::log(1 - random_.uniform());
        if (blurred >= nearest) continue;
        nearest = blurred;
        target = nonzeros[i];
    }
    return target;
}

/// Moves the angles, from where they are, until the pattern is zero. False when that does not happen: then
/// they are anywhere.
bool AngleWalk::make_zero(const Pattern& pattern) {
    constexpr int kMostSteps = 60;
    constexpr double kSolved = 1e-12, kLongestStep = 0.4;
    double damping = 1e-3, least = std::numeric_limits<double>::infinity();
    int slow_steps = 0;
    std::vector<double> angles = angles_;
    for (int step = 0; step < kMostSteps && slow_steps < 8; ++step) {
        if (!go_to(angles)) return false;
        Vector<double> residuals(pattern.size());
        for (std::size_t r = 0; r < pattern.size(); ++r) residuals(r) = model_.residual(pattern[r]);
        if (residuals.cwiseAbs().maxCoeff() < kSolved) return true;
        const double square = residuals.squaredNorm();
        slow_steps += square > 0.9 * least;
        damping = square > least ? 8 * damping : 0.2 * damping;
        least = std::min(least, square);
        const Matrix<double> jacobian = model_.jacobian(pattern);
        Matrix<double> squares = jacobian.transpose() * jacobian;
        // With the residuals the damping vanishes, so that the end is quadratic; never all of it, since the
        // zeros of a pattern depend on each other.
        squares.diagonal().array() += std::min(damping, 10 * square) + 1e-13;
        Vector<double> change = squares.ldlt().solve(jacobian.transpose() * residuals);
        change *= std::min(1.0, kLongestStep / change.cwiseAbs().maxCoeff());
        for (std::size_t i = 0; i < angles.size(); ++i) angles[i] = angles_[i] - change(i);
    }
    return false;
}

void AngleWalk::move() {
    if (!go_to(current_.angles)) return;
    Pattern kept = current_.zeros;
    Freedom freedom;
    if (random_.chance(0.5)) freedom = freedom_of(kept);
    if (!freedom.is_any()) {
        kept = without_some(kept);
        freedom = freedom_of(kept);
    }
    Place reached;
    for (int gain = 0; gain < kMostGains && freedom.is_any(); ++gain) {
        if (!gain_a_zero(kept, freedom)) break;
        Place place = here();
        kept = place.zeros;
        freedom = freedom_of(kept);
        if (place.cost < reached.cost) reached = std::move(place);
    }
    if (!(reached.cost <= current_.cost - temperature_ * std::log(1 - random_.uniform()))) return;
    if (reached.cost < best_.cost - kZeroInDouble) best_ = reached;
    current_ = std::move(reached);
}

/// From where the angles are. False when they came to no further zero: then they are anywhere.
bool AngleWalk::gain_a_zero(const Pattern& kept, const Freedom& freedom) {
    const std::vector<double> from = angles_;
    for (int trial = 0; trial < kMostTrials; ++trial) {
        if (trial > 0 && !go_to(from)) return false;
        const auto target = draw_target(freedom.directions);
        if (!target) return false;
        if (random_.chance(0.5)) {  // from somewhere else along the freedom
            Vector<double> along(freedom.directions.cols());
            for (double& part : along) part = 0.4 * random_.uniform() - 0.2;
            const Vector<double> change = freedom.directions * along;
            for (std::size_t i = 0; i < from.size(); ++i) angles_[i] += change(i);
        }
        Pattern independent = freedom.independent, all = kept;
        independent.push_back(*target);
        all.push_back(*target);
        // Mostly the others hold too, and a step costs far less.
        if (make_zero(independent) && make_zero(all)) return true;
    }
    return false;
}

}  // namespace zonal::search
