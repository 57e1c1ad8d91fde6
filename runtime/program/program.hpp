#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace zonal::program {

/// The body of every `main`: reads the arguments, does the work (of the subcommand, whose callback it is, and
/// then `work`), and sees that everything printed has arrived. Returns the exit status: 0, or 1 after one
/// line on standard error that begins with "error: ". What exceptions say may quote files and arguments: it
/// is shown harmlessly. Standard streams that are closed are replaced, so that no file opened later is taken
/// for one of them.
int run(
    CLI::App& app, int argc, char** argv, const std::function<void()>& work = [] {});

/// Has `app` take one subcommand, and complain of another word, or of none, before one runs: with those that
/// there are. After all of them are added.
void require_subcommand(CLI::App& app);

/// A check of an option: a text of nothing names no file.
CLI::Validator not_empty();

}  // namespace zonal::program
