#include "paper/sheets.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace zonal::paper {
namespace {

constexpr const char* kMissing = "no table";

std::string count(const Json& value) { return value.is_null() ? kMissing : std::to_string(value.get<int>()); }

std::string number(const Json& value, const char* format) {
    return value.is_null() ? kMissing : fmt::format(fmt::runtime(format), value.get<double>());
}

std::string percent(const Json& value) { return number(value, "{:.1f}"); }

std::string list(const Json& values) {
    if (values.is_null()) return kMissing;
    std::vector<std::string> texts;
    for (const Json& value : values) texts.push_back(count(value));
    return fmt::format("{}", fmt::join(texts, " "));
}

Sheet lobes_sheet(const Json& rows) {
    Sheet sheet{"Table I: lobes of each function",
                "y_l^m for m = -l … l; the ratio is that of the sums",
                {{"l", "paper", "zonal", "ratio"}}};
    for (const Json& row : rows)
        sheet.rows.push_back(
            {count(row["band"]), list(row["paper"]), list(row["ours"]), number(row["ratio"], "{:.3f}")});
    return sheet;
}

Sheet zeros_sheet(const Json& rows) {
    Sheet sheet{"Table I: zeros of each band",
                "of (2l+1)^2 entries, more is better; cond is cond_2(Y_l)",
                {{"l", "entries", "paper %", "zonal %", "ratio", "zeros", "cond"}}};
    for (const Json& row : rows)
        sheet.rows.push_back({count(row["band"]), count(row["entries"]), count(row["paper_percent"]),
                              percent(row["percent"]), number(row["ratio"], "{:.3f}"), count(row["zeros"]),
                              number(row["cond"], "{:.3g}")});
    return sheet;
}

Sheet paper_sheet(const Json& rows) {
    Sheet sheet{
        "Table II: multiplications, the paper's",
        "zxzxz = 3 z + 2 x; CPU = (2N-2) basis + product + sparse; GPU = product + sparse; the column "
        "\"zxzxz opt.\" is derived",
        {{"N", "z", "z opt.", "x", "zxzxz", "zxzxz opt.", "basis", "product", "sparse", "CPU", "GPU"}}};
    for (const Json& row : rows) {
        std::vector<std::string> cells{count(row["order"])};
        for (const char* key :
             {"z_rotation", "z_rotation_optimized", "x_rotation", "zxzxz", "zxzxz_optimized", "basis",
              "y_product", "sparse", "standard_cpu", "standard_gpu"})
            cells.push_back(count(row["paper"][key]));
        sheet.rows.push_back(cells);
    }
    return sheet;
}

Sheet our_sheet(const Json& rows) {
    Sheet sheet{
        "Table II: multiplications, zonal's",
        "sparse: nonzeros of bands >= 2, against the paper's; the kernels as emitted, mul + fma, set-up "
        "included: rotate_zhf against the paper's CPU row, rotate against its least row (whose x-rotations "
        "are dense from N = 15 on)",
        {{"N", "sparse", "ratio", "factorize", "rotate_zhf", "ratio", "rotate", "ratio"}}};
    for (const Json& row : rows) {
        const Json &ours = row["ours"], &ratio = row["ratio"];
        sheet.rows.push_back({count(row["order"]), count(ours["sparse"]), number(ratio["sparse"], "{:.3f}"),
                              count(ours["factorize"]), count(ours["rotate_zhf"]),
                              number(ratio["rotate_zhf"], "{:.3f}"), count(ours["rotate"]),
                              number(ratio["rotate"], "{:.3f}")});
    }
    return sheet;
}

Sheet sparsity_sheet(const Json& rows) {
    Sheet sheet{"Figure 3: zeros in percent of all bands >= 2",
                "of random nonsingular sets of candidates, and of the searched table",
                {{"N", "sets", "drawn", "least", "quartile", "median", "mean", "quartile", "largest",
                  "searched", "paper: mean, largest, searched", "ratio of searched"}}};
    for (const Json& row : rows) {
        const Json& random = row["random"];
        std::vector<std::string> cells{count(row["order"]), random.is_null() ? "0" : count(random["sets"]),
                                       count(row["drawn"])};
        for (const char* key : {"least", "lower_quartile", "median", "mean", "upper_quartile", "largest"})
            cells.push_back(random.is_null() ? "all singular" : percent(random[key]));
        cells.push_back(percent(row["searched_percent"]));
        const Json& paper = row["paper"];
        cells.push_back(paper.is_null() ? ""
                                        : fmt::format("{} {} {}", count(paper["mean"]),
                                                      count(paper["largest"]), count(paper["searched"])));
        cells.push_back(paper.is_null() ? "" : number(row["ratio"], "{:.3f}"));
        sheet.rows.push_back(cells);
    }
    return sheet;
}

Sheet expansion_sheet(const Json& rows) {
    Sheet sheet{"Equation 8: seconds to find weights and lobes of a band",
                "residual |A D Y - I|_F^2, and what rounding in double leaves of an exact solution",
                {{"l", "paper", "zonal", "ratio", "residual", "rounding", "evaluations", "starts"}}};
    for (const Json& row : rows)
        sheet.rows.push_back({count(row["band"]), count(row["paper_seconds"]),
                              number(row["seconds"], "{:.4f}"), number(row["ratio"], "{:.2g}"),
                              number(row["residual"], "{:.1e}"), number(row["rounding"], "{:.1e}"),
                              count(row["evaluations"]), count(row["starts"])});
    return sheet;
}

/// Bytes of UTF-8 that begin a character.
std::size_t width(const std::string& text) {
    return std::ranges::count_if(text, [](char byte) { return (byte & 0xC0) != 0x80; });
}

std::string html_text(const std::string& text) {
    std::string escaped;
    for (const char c : text)
        escaped += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return escaped;
}

std::string html_of(const Sheet& sheet) {
    std::string html =
        fmt::format("<h2>{}</h2>\n<p>{}</p>\n<table>\n", html_text(sheet.title), html_text(sheet.note));
    for (const auto& row : sheet.rows) {
        const char* tag = &row == &sheet.rows.front() ? "th" : "td";
        html += "<tr>";
        for (const std::string& cell : row) html += fmt::format("<{0}>{1}</{0}>", tag, html_text(cell));
        html += "</tr>\n";
    }
    return html + "</table>\n";
}

constexpr const char* kPage = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>zonal beside the paper</title>
<style>
body {{ font-family: sans-serif; max-width: 70em; margin: 2em auto; padding: 0 1em }}
table {{ border-collapse: collapse; font-variant-numeric: tabular-nums }}
th, td {{ text-align: right; padding: .15em .8em; border-bottom: 1px solid #ddd }}
</style>
<script src="https://cdn.jsdelivr.net/npm/vega@5.30.0"></script>
<script src="https://cdn.jsdelivr.net/npm/vega-lite@5.21.0"></script>
<script src="https://cdn.jsdelivr.net/npm/vega-embed@6.26.0"></script>
</head>
<body>
<h1>zonal beside the paper</h1>
<p>Nowrouzezahrai, Simari, Fiume: Sparse Zonal Harmonic Factorization for Efficient SH Rotation. Command:
<code>zonal-gen paper --html FILE</code>, seed {seed}.</p>
<h2>Figure 3</h2>
<div id="figure"><p>The picture needs scripts; its numbers stand below.</p></div>
{sheets}<script>
const figure = {figure};
if (window.vegaEmbed) vegaEmbed("#figure", figure, {{actions: false}});
</script>
</body>
</html>
)";

}  // namespace

std::vector<Sheet> sheets_of(const Json& comparison) {
    return {lobes_sheet(comparison["lobes_of_functions"]), zeros_sheet(comparison["zeros_of_bands"]),
            paper_sheet(comparison["multiplications"]),    our_sheet(comparison["multiplications"]),
            sparsity_sheet(comparison["sparsity"]),        expansion_sheet(comparison["expansion"])};
}

std::string text_of(const std::vector<Sheet>& sheets) {
    std::string text;
    for (const Sheet& sheet : sheets) {
        text += fmt::format("{}\n({})\n", sheet.title, sheet.note);
        std::vector<std::size_t> widths(sheet.rows.front().size(), 0);
        for (const auto& row : sheet.rows)
            for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width(row[c]));
        for (const auto& row : sheet.rows) {
            for (std::size_t c = 0; c < row.size(); ++c)
                text += std::string(widths[c] - width(row[c]) + (c > 0 ? 2 : 0), ' ') + row[c];
            text += '\n';
        }
        text += '\n';
    }
    return text;
}

Json figure_of(const Json& comparison) {
    Json values = Json::array();
    for (const Json& row : comparison["sparsity"]) {
        Json value{{"order", row["order"]}, {"searched", row["searched_percent"]}};
        if (!row["random"].is_null()) value.update(row["random"]);
        if (!row["paper"].is_null())
            for (const char* key : {"mean", "largest", "searched"})
                values.push_back({{"order", row["order"]}, {"paper", row["paper"][key]}});
        values.push_back(value);
    }
    const auto y = [](const char* field) {
        return Json{{"field", field}, {"type", "quantitative"}, {"title", "zeros in percent"}};
    };
    const auto layer = [&](const Json& mark, const char* from, const char* to, const char* name) {
        Json encoding{{"y", y(from)}, {"color", {{"datum", name}}}};
        if (to != nullptr) encoding["y2"] = {{"field", to}};
        return Json{{"transform", {{{"filter", fmt::format("isValid(datum.{})", from)}}}},
                    {"mark", mark},
                    {"encoding", encoding}};
    };
    return {{"$schema", "https://vega.github.io/schema/vega-lite/v5.json"},
            {"width", 640},
            {"height", 320},
            {"config", {{"legend", {{"labelLimit", 300}}}}},
            {"data", {{"values", values}}},
            {"encoding", {{"x", {{"field", "order"}, {"type", "ordinal"}, {"title", "order N"}}}}},
            {"layer",
             {layer("rule", "least", "largest", "random, least to largest"),
              layer({{"type", "bar"}, {"size", 12}}, "lower_quartile", "upper_quartile", "random, quartiles"),
              layer({{"type", "tick"}, {"size", 18}}, "mean", nullptr, "random, mean"),
              layer({{"type", "line"}, {"point", true}}, "searched", nullptr, "searched table"),
              layer({{"type", "point"}, {"shape", "diamond"}, {"size", 90}}, "paper", nullptr,
                    "paper: mean, largest, searched")}}};
}

std::string page_of(const Json& comparison) {
    std::string sheets;
    for (const Sheet& sheet : sheets_of(comparison)) sheets += html_of(sheet);
    return fmt::format(fmt::runtime(kPage), fmt::arg("seed", comparison["seed"].get<std::uint64_t>()),
                       fmt::arg("sheets", sheets), fmt::arg("figure", figure_of(comparison).dump()));
}

}  // namespace zonal::paper
