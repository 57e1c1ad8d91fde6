#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "search/swap_annealing.hpp"

namespace zonal::search {

/// Settings of the algorithm.
struct Genetic {
    int population = 0;
    double crossover_fraction = 0.8;  ///< of the children that have two parents; the others are mutants
    double mutation_rate = 0;         ///< of an angle; 0 stands for 1/v, where v is the number of angles
    int elite = 2;
    int stall_generations = 50;
    bool is_plain = true;         ///< genes are angles and there is no local step
    bool starts_aligned = false;  ///< from `draw_aligned` sets, annealed first; not with plain genes
    Annealing local_step;         ///< of every child; its norm weight is drawn anew for each

    /// As section 5 of the paper has it.
    static Genetic of_paper();

    /// Genes are lobes, and every child is annealed for long. Few such children do more than many plain ones.
    static Genetic with_local_steps(const Problem& problem);
};

struct Individual {
    LobeSet lobes;
    Score score;
    double cost = 0;
};

/// One island: a population that breeds by itself. All its randomness comes from the stream it is given.
class Population {
  public:
    /// Plain, lobes are drawn from the grid, else from the pool.
    Population(const Problem& problem, const CandidateGrid& grid, const Pool& pool,
               const Objective& objective, const Genetic& settings, Random random);

    /// One generation; a part of it once `is_stopped()`.
    void evolve(const std::function<bool()>& is_stopped = [] { return false; });

    /// Begins anew from random individuals; the stream of random numbers goes on.
    void restart();

    /// Puts a set in the place of the worst individual.
    void adopt(const LobeSet& lobes);

    const Individual& best() const { return individuals_.front(); }

    /// The best `count` individuals of different cost.
    std::vector<Individual> best_of_each_cost(int count) const;

    /// Generations since the best one improved.
    int stalled() const { return stalled_; }
    bool has_stalled() const { return stalled_ >= settings_.stall_generations; }

    /// Sets judged so far, by rank-one updates or afresh.
    std::int64_t evaluations() const { return evaluations_; }

  private:
    Individual judge(LobeSet lobes);
    LobeSet random_lobes();
    LobeSet start();
    LobeSet improve(const LobeSet& lobes);
    Lobe draw() { return settings_.is_plain ? grid_->random(random_) : pool_->draw(random_); }
    LobeSet breed();
    const LobeSet& draw_parent();
    LobeSet cross_angles(const LobeSet& mother, const LobeSet& father);
    LobeSet cross_lobes(const LobeSet& mother, const LobeSet& father);
    Lobe random_lobe_outside(const LobeSet& lobes);
    void mutate_angles(LobeSet& lobes);
    void mutate_lobes(LobeSet& lobes);
    void sort();

    const Problem* problem_;
    const CandidateGrid* grid_;
    const Pool* pool_;
    Objective objective_;
    Genetic settings_;
    Random random_;
    std::vector<Individual> individuals_;  // best first
    bool are_founders_ = false;            // not annealed yet, which the first generation does
    int stalled_ = 0;
    std::int64_t evaluations_ = 0;
};

}  // namespace zonal::search
