#pragma once

#include <array>
#include <vector>

/// Numbers of Nowrouzezahrai, Simari, Fiume, "Sparse Zonal Harmonic Factorization for Efficient SH Rotation".
namespace zonal::paper::published {

/// Table I: lobes of y_l^{-l} … y_l^l for l = 2 … 6.
inline const std::vector<std::vector<int>> kLobesOfFunctions{
    {2, 2, 1, 2, 2},
    {2, 2, 2, 1, 3, 3, 3},
    {3, 4, 4, 5, 1, 5, 2, 4, 3},
    {3, 7, 5, 10, 5, 1, 7, 5, 7, 3, 4},
    {9, 4, 8, 4, 9, 7, 1, 10, 6, 10, 5, 8, 5},
};

/// Table I: zeros of Â_l in percent, l = 2 … 18.
inline constexpr std::array kZerosOfBands{64, 67, 62, 53, 49, 46, 42, 39, 38, 38, 37, 37, 36, 36, 36, 35, 35};

/// Table II: multiplications of one rotation.
struct Multiplications {
    int order;
    int z_rotation, z_rotation_optimized, x_rotation;
    int zxzxz;  ///< 3 z + 2 x
    int basis;  ///< y_0^0 … of one lobe
    int y_product, sparse;
    int standard_cpu;  ///< (2N-2) basis + y_product + sparse
    int standard_gpu;  ///< y_product + sparse

    /// The best the paper's table allows, which it does not print: three optimized z-rotations.
    int zxzxz_optimized() const { return 3 * z_rotation_optimized + 2 * x_rotation; }
};

inline constexpr std::array kMultiplications{
    Multiplications{3, 34, 16, 5, 112, 14, 25, 9, 90, 34},
    Multiplications{4, 52, 32, 18, 192, 28, 74, 33, 275, 107},
    Multiplications{5, 74, 52, 39, 300, 47, 155, 75, 606, 230},
    Multiplications{6, 100, 76, 71, 442, 71, 276, 137, 1123, 413},
    Multiplications{7, 130, 104, 115, 620, 100, 445, 246, 1891, 691},
    Multiplications{8, 164, 136, 171, 834, 134, 670, 384, 2930, 1054},
    Multiplications{9, 202, 172, 243, 1092, 173, 959, 570, 4297, 1529},
    Multiplications{10, 244, 212, 334, 1400, 217, 1320, 820, 6046, 2140},
    Multiplications{11, 290, 256, 445, 1760, 266, 1761, 1118, 8199, 2879},
    Multiplications{12, 340, 304, 576, 2172, 320, 2290, 1453, 10783, 3743},
    Multiplications{13, 394, 356, 733, 2648, 379, 2915, 1849, 13860, 4764},
    Multiplications{14, 452, 412, 916, 3188, 443, 3644, 2333, 17495, 5977},
    Multiplications{15, 514, 472, 1757, 5056, 512, 4485, 2851, 21672, 7336},
    Multiplications{16, 580, 536, 2718, 7176, 586, 5446, 3524, 26550, 8970},
    Multiplications{17, 650, 604, 3807, 9564, 665, 6535, 4199, 32014, 10734},
    Multiplications{18, 724, 676, 5032, 12236, 749, 7760, 5030, 38256, 12790},
    Multiplications{19, 802, 752, 6401, 15208, 838, 9129, 6014, 45311, 15143},
};

/// Figure 3 in its caption: percent of zeros at one order.
struct Sparsity {
    int order, random_mean, random_largest, searched;
};
inline constexpr Sparsity kSparsity{8, 3, 29, 45};

/// Section 4: seconds to solve eq. 8, l = 2 … 10.
inline constexpr std::array kSolverSeconds{2, 5, 7, 10, 16, 25, 38, 53, 69};

}  // namespace zonal::paper::published
