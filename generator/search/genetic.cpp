// The genetic algorithm of Nowrouzezahrai et al., section 5 (one band) and section 6 (shared lobes).
// Plain, an individual is a vector of angles; children come from two parents by uniform crossover, or from
// one by mutation. So read it stalls from band 7 on, since a good angle alone is worth nothing. The cure
// keeps the method and changes the gene: crossover and mutation exchange whole lobes of a structured pool
// (pool.hpp), and every child is improved by a long annealing over swaps of one lobe (swap_annealing.hpp).

#include "search/genetic.hpp"

#include <algorithm>
#include <cmath>

#include "search/starting_sets.hpp"

namespace zonal::search {
namespace {

/// The range of lambda that is worth trying: low finds zeros, high finds good conditions.
constexpr double kSmallestNormWeight = 0.2, kLargestNormWeight = 4;

/// From here on starts are aligned: at N = 12, 16 and 20 that found more. The sparsest sets of fewer than
/// seven bands have another order.
constexpr int kManyBands = 11;

}  // namespace

Genetic Genetic::of_paper() {
    Genetic settings;
    settings.population = 500;
    return settings;
}

Genetic Genetic::with_local_steps(const Problem& problem) {
    Genetic settings;
    settings.population = 6;
    settings.stall_generations = 10;
    settings.is_plain = false;
    settings.starts_aligned = problem.bands.size() >= kManyBands;
    settings.local_step.moves = 400 * problem.lobe_count * problem.lobe_count;
    return settings;
}

Population::Population(const Problem& problem, const CandidateGrid& grid, const Pool& pool,
                       const Objective& objective, const Genetic& settings, Random random)
    : problem_(&problem),
      grid_(&grid),
      pool_(&pool),
      objective_(objective),
      settings_(settings),
      random_(random) {
    if (settings_.mutation_rate == 0) settings_.mutation_rate = 0.5 / problem.lobe_count;
    restart();
}

void Population::restart() {
    individuals_.clear();
    for (int i = 0; i < settings_.population; ++i) individuals_.push_back(judge(start()));
    sort();
    stalled_ = 0;
    are_founders_ = settings_.starts_aligned;
}

Individual Population::judge(LobeSet lobes) {
    ++evaluations_;
    const Score score = search::score(*problem_, *grid_, lobes);
    return {std::move(lobes), score, score.cost(objective_)};
}

LobeSet Population::random_lobes() {
    LobeSet lobes;
    while (static_cast<int>(lobes.size()) < problem_->lobe_count) lobes.push_back(draw());
    return lobes;
}

/// To begin with, or in the place of singular lobes.
LobeSet Population::start() {
    if (settings_.is_plain) return random_lobes();
    return settings_.starts_aligned ? draw_aligned(*problem_, *grid_, *pool_, random_)
                                    : draw_regular(*problem_, *grid_, *pool_, random_);
}

/// Annealed by swaps; from other lobes where these are singular, which crossing two sets may make them.
LobeSet Population::improve(const LobeSet& lobes) {
    const double norm_weight =
        kSmallestNormWeight * std::pow(kLargestNormWeight / kSmallestNormWeight, random_.uniform());
    TrackedInverses state(*problem_, *grid_, objective_, norm_weight);
    constexpr int kTrials = 100;
    bool is_regular = state.reset(lobes);
    for (int trial = 0; !is_regular && trial < kTrials; ++trial) is_regular = state.reset(start());
    if (!is_regular) return lobes;
    evaluations_ += settings_.local_step.moves;
    return anneal_by_swaps(state, *grid_, *pool_, settings_.local_step, random_);
}

void Population::evolve(const std::function<bool()>& is_stopped) {
    const double best_before = best().cost;
    std::vector<Individual> next(individuals_.begin(), individuals_.begin() + settings_.elite);
    while (static_cast<int>(next.size()) < settings_.population && !is_stopped()) {
        LobeSet child = are_founders_ ? individuals_[next.size() - settings_.elite].lobes : breed();
        next.push_back(judge(settings_.is_plain ? std::move(child) : improve(child)));
    }
    // What a stopped generation did not replace stays.
    for (std::size_t i = next.size(); i < individuals_.size(); ++i) next.push_back(individuals_[i]);
    individuals_ = std::move(next);
    are_founders_ = false;
    sort();
    stalled_ = best().cost < best_before ? 0 : stalled_ + 1;
}

LobeSet Population::breed() {
    const bool has_two_parents = random_.chance(settings_.crossover_fraction);
    const LobeSet& mother = draw_parent();
    if (has_two_parents) {
        const LobeSet& father = draw_parent();
        return settings_.is_plain ? cross_angles(mother, father) : cross_lobes(mother, father);
    }
    LobeSet child = mother;
    settings_.is_plain ? mutate_angles(child) : mutate_lobes(child);
    return child;
}

/// The better of two drawn at random.
const LobeSet& Population::draw_parent() {
    const int first = random_.below(settings_.population), second = random_.below(settings_.population);
    return individuals_[std::min(first, second)].lobes;
}

LobeSet Population::cross_angles(const LobeSet& mother, const LobeSet& father) {
    LobeSet child = mother;
    for (std::size_t d = 0; d < child.size(); ++d) {
        const int theta = (random_.chance(0.5) ? mother : father)[d].theta;
        const int phi = (random_.chance(0.5) ? mother : father)[d].phi;
        child[d] = grid_->canonical(theta, phi);
    }
    return child;
}

/// A candidate that the set does not hold yet. Few bands have few candidates, so there may be none: then one
/// that it holds, which makes it singular.
Lobe Population::random_lobe_outside(const LobeSet& lobes) {
    Lobe lobe = draw();
    for (int trial = 0; trial < 100 && contains(lobes, lobe); ++trial) lobe = draw();
    return lobe;
}

LobeSet Population::cross_lobes(const LobeSet& mother, const LobeSet& father) {
    LobeSet child;
    for (std::size_t d = 0; d < mother.size(); ++d) {
        Lobe first = mother[d], second = father[d];
        if (random_.chance(0.5)) std::swap(first, second);
        if (contains(child, first)) first = second;
        child.push_back(contains(child, first) ? random_lobe_outside(child) : first);
    }
    return child;
}

void Population::mutate_angles(LobeSet& lobes) {
    const CandidateGrid& grid = *grid_;
    for (Lobe& lobe : lobes) {
        int theta = lobe.theta, phi = lobe.phi;
        if (random_.chance(settings_.mutation_rate))
            theta = random_.below(static_cast<int>(grid.thetas().size()));
        if (random_.chance(settings_.mutation_rate))
            phi = random_.below(static_cast<int>(grid.phis().size()));
        lobe = grid.canonical(theta, phi);
    }
}

void Population::mutate_lobes(LobeSet& lobes) {
    for (Lobe& lobe : lobes) {
        // A lobe has two angles, so it changes twice as often as an angle.
        if (!random_.chance(2 * settings_.mutation_rate)) continue;
        lobe = random_lobe_outside(lobes);
    }
}

void Population::adopt(const LobeSet& lobes) {
    individuals_.back() = judge(lobes);
    const double best_before = best().cost;
    sort();
    if (best().cost < best_before) stalled_ = 0;
}

std::vector<Individual> Population::best_of_each_cost(int count) const {
    std::vector<Individual> best;
    for (const Individual& individual : individuals_) {
        if (static_cast<int>(best.size()) == count || std::isinf(individual.cost)) break;
        if (best.empty() || individual.cost > best.back().cost + 1e-6) best.push_back(individual);
    }
    return best;
}

void Population::sort() {
    std::ranges::stable_sort(individuals_, {}, [](const Individual& individual) { return individual.cost; });
}

}  // namespace zonal::search
