#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "graph/kernel.hpp"
#include "kernels/zxzxz.hpp"

namespace zonal::kernels {

/// A rotation whose bands are built one by one; what several of them need is made when first asked for.
class RotationBuilder {
  public:
    /// Input 0 is R, input 1 the signal f of N² values, the output as many; all of it still empty.
    explicit RotationBuilder(int bands);
    RotationBuilder(const RotationBuilder&) = delete;  // values point into the graph

    graph::Kernel kernel;
    int order;
    Matrix3 rows;  ///< R as given

    EulerScalars& euler();
    /// The dense matrix of band l, row-major.
    const std::vector<graph::Value>& block(int l);

  private:
    std::optional<EulerScalars> euler_;
    std::vector<std::vector<graph::Value>> blocks_;
};

/// One exact way to rotate a band.
struct BandMethod {
    std::string name;    ///< "contraction"; "zxzxz, even m update, odd m transform"
    std::string family;  ///< its name without the form: "zxzxz"
    std::string source;  ///< for banners: author, year, section
    bool takes_mirrors = true;
    int first_band = 1;
    int last_band = 0;         ///< the last that it is weighed for
    bool is_chain = false;     ///< its steps wait for one another, where those of its like do not
    std::string scalars = {};  ///< scope of its rotation scalars, where that is not the band's own
    /// Reads the band of input 1 and stores it.
    std::function<void(RotationBuilder&, int l)> build = {};
};

/// All of them. A new method is one entry: planner, banners and statistics take it from there.
const std::vector<BandMethod>& band_methods();

/// The one of that name. Throws std::logic_error where there is none.
const BandMethod& band_method(const std::string& name);

}  // namespace zonal::kernels
