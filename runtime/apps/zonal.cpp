// zonal: what the libraries do, from the command line; a file a subcommand.
#include "program/program.hpp"
#include "rotate_map.hpp"

int main(int argc, char** argv) {
    CLI::App app("Rotates real spherical-harmonic vectors.", "zonal");
    zonal::add_rotate_map_command(app);
    zonal::program::require_subcommand(app);
    return zonal::program::run(app, argc, argv);
}
