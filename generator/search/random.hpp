#pragma once

#include <cstdint>
#include <random>

namespace zonal::search {

/// A stream of random numbers of its own for each (seed, stream). The distributions are written out, because
/// those of the standard library differ between implementations.
class Random {
  public:
    Random(std::uint64_t seed, std::uint64_t stream) {
        std::seed_seq words{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                            static_cast<std::uint32_t>(stream), static_cast<std::uint32_t>(stream >> 32)};
        engine_.seed(words);
    }

    /// Uniform in [0, 1).
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

    /// Uniform in 0 … count-1.
    int below(int count) { return static_cast<int>(uniform() * count); }

    bool chance(double probability) { return uniform() < probability; }

  private:
    std::mt19937_64 engine_;
};

}  // namespace zonal::search
