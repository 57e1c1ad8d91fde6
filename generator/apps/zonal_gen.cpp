// zonal-gen: searches lobe directions and writes the kernels that rotate by them.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "apps/emit_command.hpp"
#include "apps/paper_command.hpp"
#include "apps/search_command.hpp"
#include "apps/stats_command.hpp"

int main(int argc, char** argv) {
    CLI::App app{"Generates kernels that rotate real spherical-harmonic vectors."};
    app.require_subcommand(1);
    zonal::add_search_command(app);
    zonal::add_emit_command(app);
    zonal::add_stats_command(app);
    zonal::add_paper_command(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 1;
    }
    return 0;
}
