// zonal-gen: searches lobe directions and writes the kernels that rotate by them.
#include "apps/emit_command.hpp"
#include "apps/paper_command.hpp"
#include "apps/search_command.hpp"
#include "apps/stats_command.hpp"
#include "program/program.hpp"

int main(int argc, char** argv) {
    CLI::App app{"Generates kernels that rotate real spherical-harmonic vectors."};
    zonal::add_search_command(app);
    zonal::add_emit_command(app);
    zonal::add_stats_command(app);
    zonal::add_paper_command(app);
    zonal::program::require_subcommand(app);
    return zonal::program::run(app, argc, argv);
}
