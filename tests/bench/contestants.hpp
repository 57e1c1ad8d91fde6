#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace zonal::bench {

/// Arrays of `count` rotations (nine values) and vectors (N^2 values), all touching.
template <class T>
struct Arrays {
    const T* rotations;
    const T* in;
    T* out;
    std::size_t count;
};

/// A way to turn vectors, one call for each vector and its own rotation.
template <class T>
struct SingleCall {
    std::string name;
    std::function<void(const Arrays<T>&)> run;
    std::function<void(const T* R, const T* f, T* out)> rotate;  ///< one of them, to measure its error
};

/// Name of the one that others are compared with, as the paper's Figure 5 does.
inline constexpr const char* kZxzxz = "zxzxz with angles";
/// Name of DirectXMath's arithmetic, the fastest in use; orders above 10 lack it.
inline constexpr const char* kZyz = "z-y-z without angles";

/// Whoever takes part in the table of single calls for this order: add baselines here (contestants.cpp).
template <class T>
std::vector<SingleCall<T>> single_calls(int order);

/// All vectors by the first rotation, as a user of a matrix library would: blocks once, then Eigen's
/// products.
template <class T>
SingleCall<T> dense_product(int order);

}  // namespace zonal::bench
