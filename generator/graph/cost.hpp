#pragma once

namespace zonal::graph {

/// Operations of one kind of value. A minus sign alone is no operation: it is part of the literal or of the
/// instruction beside it. `add` counts additions and subtractions, `other` divisions and
/// roots; to copy a sign is a bitwise matter and counts as little as a minus sign.
struct Counts {
    int mul = 0;
    int add = 0;
    int fma = 0;
    int other = 0;

    int multiplications() const { return mul + fma; }
    int instructions() const { return mul + add + fma + other; }
    friend Counts operator+(const Counts& a, const Counts& b) {
        return {a.mul + b.mul, a.add + b.add, a.fma + b.fma, a.other + b.other};
    }
};

/// What a kernel costs once per rotation and once per vector; one vector pays the sum.
struct Cost {
    Counts per_rotation;
    Counts per_vector;
    Counts total() const { return per_rotation + per_vector; }
};

}  // namespace zonal::graph
