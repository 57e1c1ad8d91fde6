#include "bench/baselines/quarter_turn.hpp"

#include "bench/baselines/ivanic_ruedenberg.hpp"

namespace zonal::baselines {

template <class T>
std::vector<T> quarter_turn_blocks(int order) {
    constexpr long double kTurn[9] = {1, 0, 0, 0, 0, -1, 0, 1, 0};
    std::vector<long double> dense(block_offset(order));
    IvanicRuedenberg<long double>(order).blocks(kTurn, dense.data());
    std::vector<T> rounded;
    for (const long double value : dense) rounded.push_back(static_cast<T>(value));
    return rounded;
}

template std::vector<float> quarter_turn_blocks(int);
template std::vector<double> quarter_turn_blocks(int);

}  // namespace zonal::baselines
