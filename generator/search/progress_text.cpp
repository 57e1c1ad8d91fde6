#include "search/progress_text.hpp"

#include <fmt/format.h>

namespace zonal::search {

std::string progress_text(const Progress& progress) {
    const std::string of = progress.generations > 0 ? fmt::format("/{}", progress.generations) : "";
    const std::string left =
        progress.seconds_left > 0 ? fmt::format(", {:.0f} s left", progress.seconds_left) : "";
    const Score& best = progress.best;
    const std::string lobes =
        best.is_singular() ? "nothing but singular sets yet"
                           : fmt::format("{} nonzeros ({} zeros), {} multiplications, cond {:.2f}",
                                         best.nonzeros, best.zeros, best.multiplications, best.condition);
    const std::string emitted =
        progress.instructions > 0 ? fmt::format("{} instructions, ", progress.instructions) : "";
    const double rate =
        progress.seconds > 0 ? static_cast<double>(progress.evaluations) / progress.seconds : 0;
    return fmt::format("generation {}{}: {}{}; {:.0f}k/s, {:.0f} s{}", progress.generation, of, emitted,
                       lobes, rate / 1000, progress.seconds, left);
}

}  // namespace zonal::search
