#include "program/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "program/shown.hpp"

namespace zonal::program {
namespace {

/// Nothing can be written to what stands in for standard output: the program will say so at its end.
void replace_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) == -1 && errno == EBADF)
            open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);  // takes the lowest free number
}

int complain(const std::string& text) {
    std::fputs(("error: " + shown(text) + '\n').c_str(), stderr);
    return 1;
}

int complain_of_output(int error) {
    return complain(fmt::format(
        "standard output: cannot write: {}; send it where there is room (files that were written stay)",
        std::generic_category().message(error)));
}

}  // namespace

int run(CLI::App& app, int argc, char** argv, const std::function<void()>& work) {
    replace_closed_streams();
    std::string problem;
    int error = 0;
    try {
        app.parse(argc, argv);
        work();
    } catch (const CLI::Success& help) {
        std::ostringstream text;
        app.exit(help, text, text);
        std::fputs(text.str().c_str(), stdout);
    } catch (const CLI::ParseError& wrong) {
        problem = fmt::format("{}; run with --help for the options", wrong.what());
    } catch (const std::system_error& failure) {  // fmt's, where output does not arrive
        problem = failure.what();
        error = failure.code().value();
    } catch (const std::exception& failure) {
        problem = failure.what();
    }
    const bool has_failed = std::ferror(stdout) != 0;
    errno = error;
    if (std::fflush(stdout) != 0 || has_failed) return complain_of_output(errno != 0 ? errno : EIO);
    return problem.empty() ? 0 : complain(problem);
}

void require_subcommand(CLI::App& app) {
    app.allow_extras();  // words ahead of a subcommand, none of its own
    app.parse_complete_callback([&app] {
        const std::vector<std::string> unknown = app.remaining();
        if (unknown.empty() && !app.get_subcommands().empty()) return;
        std::string known;
        for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
            known += (known.empty() ? "" : ", ") + command->get_name();
        const std::string found = unknown.empty() ? "none" : fmt::format("'{}'", unknown.front());
        throw CLI::ValidationError("subcommand", fmt::format("found {}, wanted one of: {}", found, known));
    });
}

CLI::Validator not_empty() {
    const auto check = [](const std::string& text) {
        return text.empty() ? std::string("found '', wanted a name") : std::string();
    };
    return {check, ""};
}

}  // namespace zonal::program
