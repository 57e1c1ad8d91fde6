#include "apps/paper_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <memory>

#include "io/output_file.hpp"
#include "lobes/order_tables.hpp"
#include "lobes/tables_folder.hpp"
#include "paper/comparison.hpp"
#include "paper/sheets.hpp"
#include "program/numbers.hpp"
#include "program/program.hpp"

namespace zonal {
namespace {

struct PaperOptions {
    bool as_json = false;
    std::string html;
    int sets = 1000;
    std::uint64_t seed = 1;
};

void run(const PaperOptions& options) {
    if (!options.html.empty()) check_is_writable("--html", options.html);
    check_tables_are_there(tables_folder());
    const bool is_watched = isatty(STDERR_FILENO) != 0;
    const auto show = [&](const std::string& step) {
        if (is_watched) fmt::print(stderr, "\r\033[K{}", step);
    };
    const paper::Json comparison = paper::compare(tables_folder(), options.sets, options.seed, show);
    show("");
    if (!options.html.empty()) write_file_atomically(options.html, paper::page_of(comparison));
    if (options.as_json)
        fmt::print("{}\n", comparison.dump(2));
    else
        fmt::print("{}", paper::text_of(paper::sheets_of(comparison)));
}

}  // namespace

void add_paper_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "paper", "this project's numbers beside the paper's Tables I and II, Figure 3 and eq. 8");
    const auto options = std::make_shared<PaperOptions>();
    command->add_flag("--json", options->as_json, "print JSON");
    command->add_option("--html", options->html, "page to write as well")->check(program::not_empty());
    program::add_number(*command, "--sets", options->sets, program::from_to(1, 1000000),
                        "random lobe sets of an order; fewer above order 10")
        ->capture_default_str();
    program::add_number(*command, "--seed", options->seed, {},
                        "of the random sets and of the starts of eq. 8")
        ->capture_default_str();
    command->callback([options] { run(*options); });
}

}  // namespace zonal
