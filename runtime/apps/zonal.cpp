// zonal: what the libraries do, from the command line; a file a subcommand.
#include <fmt/format.h>

#include <string>

#include "program/program.hpp"
#include "rotate_map.hpp"
#include "zonal/error.hpp"

namespace {

std::string subcommands_of(const CLI::App& app) {
    std::string names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names += (names.empty() ? "" : ", ") + command->get_name();
    return names;
}

/// Before a subcommand runs: the words ahead of it are none of its own.
void check_subcommand(const CLI::App& app) {
    const auto unknown = app.remaining();
    if (unknown.empty() && !app.get_subcommands().empty()) return;
    throw zonal::Error({.field = "subcommand",
                        .found = unknown.empty() ? "none" : fmt::format("'{}'", unknown.front()),
                        .wanted = fmt::format("one of: {}", subcommands_of(app)),
                        .next_step = "run zonal --help"});
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Rotates real spherical-harmonic vectors.", "zonal");
    zonal::add_rotate_map_command(app);
    app.allow_extras();  // which check_subcommand names
    app.parse_complete_callback([&] { check_subcommand(app); });
    return zonal::program::run(app, argc, argv);
}
