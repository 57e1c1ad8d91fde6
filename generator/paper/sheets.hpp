#pragma once

#include <string>
#include <vector>

#include "paper/comparison.hpp"

namespace zonal::paper {

/// A table for people: what the numbers are, and the numbers as texts; the first row names the columns.
struct Sheet {
    std::string title, note;
    std::vector<std::vector<std::string>> rows;
};

/// All numbers of `compare` in the order of the paper; a number whose table is missing reads "no table".
std::vector<Sheet> sheets_of(const Json& comparison);

/// Right-aligned columns for a terminal.
std::string text_of(const std::vector<Sheet>& sheets);

/// Figure 3 as a Vega-Lite specification with its data inline.
Json figure_of(const Json& comparison);

/// An HTML page of all sheets with Figure 3 as a picture. Every number is there without scripts and without a
/// network; the picture alone needs vega-embed from cdn.jsdelivr.net.
std::string page_of(const Json& comparison);

}  // namespace zonal::paper
