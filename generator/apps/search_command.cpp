#include "apps/search_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <memory>
#include <optional>

#include "apps/front_file.hpp"
#include "apps/table_output.hpp"
#include "io/output_file.hpp"
#include "io/user_error.hpp"
#include "kernels/order_kernels.hpp"
#include "kernels/registry.hpp"
#include "lobes/lobe_table.hpp"
#include "program/numbers.hpp"
#include "program/program.hpp"
#include "program/shown.hpp"
#include "search/front.hpp"
#include "search/off_grid_search.hpp"
#include "search/orbit_search.hpp"
#include "search/progress_text.hpp"
#include "search/score.hpp"
#include "search/search.hpp"

namespace zonal {
namespace {

constexpr double kSecondsBetweenSaves = 5;

/// Set by Ctrl-C or a request to terminate: the search ends after its generation and the best is kept.
std::atomic<bool> stop_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may set it");

/// Catches Ctrl-C and SIGTERM while it lives.
class InterruptGuard {
  public:
    InterruptGuard() : interrupt_(std::signal(SIGINT, stop)), terminate_(std::signal(SIGTERM, stop)) {}
    ~InterruptGuard() {
        std::signal(SIGINT, interrupt_);
        std::signal(SIGTERM, terminate_);
    }
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

  private:
    static void stop(int) { stop_requested = true; }

    void (*interrupt_)(int);
    void (*terminate_)(int);
};

/// As the person typed them; zero means "by the method".
struct SearchOptions {
    int order = 0;
    int band = 0;
    std::uint64_t seed = 1;
    int generations = 0;
    double seconds = 0;
    std::string out;
    std::string role;
    std::string resume;
    std::string archive;
    bool is_plain = false;
    bool stays_on_grid = false;
    bool is_aligned = false;
    bool walks = false;
    int islands = 4;
    std::vector<int> zero_bands;
    std::vector<int> rings;
    int population = 0;
    int stall = 0;
    int elite = 2;
    int moves = 0;
    int mirrors = 0;
    double crossover = 0.8;
    double mutation = 0;
    search::Objective objective;

    TableRole default_role() const {
        if (band == 0) return TableRole::shared;
        return mirrors > 0 ? TableRole::band_mirrored : TableRole::band;
    }
    LobeUse use() const {
        const TableRole chosen = role.empty() ? default_role() : role_named(role).value();
        return band > 0 ? LobeUse::band(band, chosen) : LobeUse::order(order, chosen);
    }
    search::Problem problem() const {
        return band > 0 ? search::Problem::one_band(band) : search::Problem::shared(order);
    }
};

/// The table that `--resume` names.
std::optional<LobeTable> read_start(const SearchOptions& options) {
    if (options.resume.empty()) return std::nullopt;
    return read_lobe_table_of_any_role(options.resume, options.use());
}

search::SearchSettings settings_of(const SearchOptions& options, const search::Problem& problem,
                                   const std::optional<LobeTable>& start) {
    search::SearchSettings settings;
    settings.seed = options.seed;
    settings.generations = options.generations;
    settings.seconds = options.seconds;
    settings.islands = options.islands;
    settings.zero_bands = options.zero_bands;
    settings.rings = options.rings;
    settings.leaves_grid = !options.stays_on_grid && !options.is_plain;
    settings.objective = options.objective;
    search::Genetic& genetic = settings.genetic;
    genetic = options.is_plain ? search::Genetic::of_paper() : search::Genetic::with_local_steps(problem);
    if (options.is_aligned) genetic.starts_aligned = true;
    if (options.population > 0) genetic.population = options.population;
    if (options.stall > 0) genetic.stall_generations = options.stall;
    if (options.moves > 0) genetic.local_step.moves = options.moves;
    genetic.elite = options.elite;
    genetic.crossover_fraction = options.crossover;
    genetic.mutation_rate = options.mutation;
    if (start) {
        settings.start.emplace();
        for (const Lobe& lobe : start->lobes) settings.start->push_back(angled_lobe(lobe.theta, lobe.phi));
    }
    return settings;
}

/// Where the commands of a table leave it.
std::string path_in(const std::string& commands, const std::string& otherwise) {
    const std::string option = " --out ";
    const auto last = commands.rfind(option);
    return last == std::string::npos ? otherwise : commands.substr(last + option.size());
}

/// The commands that repeat a search: those that made its start, and its own of so many generations with
/// every option that is not the default. Paths are those of the repository, whatever was typed.
std::string canonical_command(const SearchOptions& options, const std::optional<LobeTable>& start,
                              int generations) {
    const SearchOptions standard;
    const LobeUse use = options.use();
    const std::string role = use.role == options.default_role() ? "" : " --for " + name_of(use.role);
    std::string command = fmt::format("zonal-gen search --{} {}{} --seed {} --generations {}", use.field,
                                      use.value, role, options.seed, generations);
    const auto add = [&](const char* name, const auto& value, const auto& default_value) {
        if (value != default_value) command += fmt::format(" {} {}", name, value);
    };
    const std::string table = fmt::format("generator/tables/{}", use.table_path().string());
    if (options.mirrors > 0) command += fmt::format(" --mirrors {}", options.mirrors);
    if (options.is_plain) command += " --plain";
    if (options.stays_on_grid) command += " --on-grid";
    if (options.is_aligned) command += " --aligned";
    if (options.walks) command += " --walk";
    if (start) command = start->command + " && " + command + " --resume " + path_in(start->command, table);
    const auto add_list = [&](const char* name, const std::vector<int>& values) {
        if (!values.empty()) command += fmt::format(" {} {}", name, fmt::join(values, " "));
    };
    add_list("--zero-bands", options.zero_bands);
    add_list("--rings", options.rings);
    add("--islands", options.islands, standard.islands);
    add("--population", options.population, standard.population);
    add("--stall", options.stall, standard.stall);
    add("--elite", options.elite, standard.elite);
    add("--local-moves", options.moves, standard.moves);
    add("--crossover", options.crossover, standard.crossover);
    add("--mutation", options.mutation, standard.mutation);
    add("--multiplication-weight", options.objective.multiplication_weight,
        standard.objective.multiplication_weight);
    add("--condition-weight", options.objective.condition_weight, standard.objective.condition_weight);
    add("--condition-cap", options.objective.condition_cap, standard.objective.condition_cap);
    return command + " --out " + table;
}

LobeTable table_of(const SearchOptions& options, const std::optional<LobeTable>& start,
                   const search::Solution& solution, int generations) {
    LobeTable table;
    table.use = options.use();
    table.seed = options.seed;
    table.command = canonical_command(options, start, generations);
    const search::AngledSet lobes = search::in_reading_order(solution.lobes);
    for (const search::AngledLobe& lobe : lobes)
        table.lobes.push_back({lobe.direction(), lobe.theta.text, lobe.phi.text});
    factorize(table);
    return table;
}

void check_use(const SearchOptions& options) {
    if (!options.role.empty()) {
        const char* const wanted = options.band > 0 ? "band or band_mirrored" : "shared or rotate_zhf";
        const auto role = role_named(options.role);
        const LobeUse some = options.band > 0 ? LobeUse::band(options.band) : LobeUse::order(options.order);
        if (!role || !some.may_be(*role))
            throw UserError(fmt::format("--for: found '{}', wanted {}", options.role, wanted));
        if (*role == TableRole::band_mirrored && options.mirrors == 0)
            throw UserError("--for band_mirrored: found no --mirrors, wanted how many; say --mirrors 1");
        if (*role == TableRole::band && options.mirrors > 0)
            throw UserError(
                "--for band: found --mirrors, whose lobes are for band_mirrored, wanted one of the two; drop "
                "the other");
    }
}

int emitted_instructions(const BandFactorization& band) {
    return kernels::factorization_counts(band).instructions();
}

search::SearchResult find_lobes(const SearchOptions& options, const search::Problem& problem,
                                const search::SearchSettings& settings,
                                const search::SearchObserver& observer) {
    if (options.walks)
        return search::search_off_grid(problem, settings, options.moves, stop_requested, observer);
    if (options.mirrors == 0) return search::search_lobes(problem, settings, stop_requested, observer);
    try {
        return search::search_orbits(options.band, settings, {options.mirrors, options.moves},
                                     emitted_instructions, stop_requested, observer);
    } catch (const std::invalid_argument& error) {
        throw UserError(
            fmt::format("--resume {}: found {}, wanted whole orbits of {}; take the --mirrors it was "
                        "found with, or drop --resume",
                        options.resume, error.what(), options.mirrors));
    }
}

/// By the weights of this search: what it minimises, and what breaks ties in it.
std::pair<double, int> cost_of(const LobeTable& table, const SearchOptions& options) {
    const search::Objective& objective = options.objective;
    const auto directions = directions_of(table.lobes);
    const double cost = options.mirrors == 0
                            ? search::exact_score(options.problem(), directions).cost(objective)
                            : emitted_instructions(table.bands.front()) +
                                  objective.condition_weight * std::log2(table.condition.front());
    return {cost, search::turning_cost(directions)};
}

/// After a search that found nothing, by what ended it.
std::string next_step(const SearchOptions& options, const search::Progress& progress) {
    std::string step = stop_requested ? "it was told to stop: let it run longer"
                       : options.generations > 0 && progress.generation >= options.generations
                           ? "raise --generations"
                       : options.seconds > 0 ? "raise --seconds"
                                             : "raise --stall";
    step += ", change --seed, or raise --condition-cap";
    if (options.mirrors > 0)
        step += ", or take another number of --mirrors: not every one has orbits that make up a band";
    return step + (options.is_plain ? ", or drop --plain" : "");
}

void run(const SearchOptions& options) {
    check_use(options);
    check_is_writable("--out", options.out);
    if (!options.archive.empty()) {
        check_is_writable("--archive", options.archive);
        if (is_same_file(options.archive, options.out))
            throw UserError(
                fmt::format("--archive {}: found the file of --out {}, wanted another; name two files",
                            options.archive, options.out));
    }
    const search::Problem problem = options.problem();
    const std::optional<LobeTable> start = read_start(options);
    if (!options.archive.empty()) read_front(options.archive, options.use(), problem);  // complains early
    TableOutput output(options.out, options.use(), options.objective.condition_cap,
                       [&](const LobeTable& table) { return cost_of(table, options); });
    const search::SearchSettings settings = settings_of(options, problem, start);

    const bool is_watched = isatty(STDERR_FILENO) != 0;
    double saved_at = -kSecondsBetweenSaves;
    int found_in = 0;  // the generation of the best; 0 is the start
    search::SearchObserver observer;
    observer.on_generation = [&](const search::Progress& progress) {
        if (is_watched) fmt::print(stderr, "\r\033[K{}", search::progress_text(progress));
    };
    observer.on_better = [&](const search::Solution& solution, const search::Progress& progress) {
        found_in = progress.generation;
        const bool is_worth_saving = solution.score.is_allowed(options.objective);
        if (!is_worth_saving || progress.seconds < saved_at + kSecondsBetweenSaves) return;
        saved_at = progress.seconds;
        try {
            output.offer(table_of(options, start, solution, progress.generation));
        } catch (const UserError& error) {  // the best stays in memory and is written again at the end
            fmt::print(stderr, "{}warning: {}\n", is_watched ? "\r\033[K" : "", program::shown(error.what()));
        }
    };

    const InterruptGuard guard;
    const search::SearchResult result = find_lobes(options, problem, settings, observer);
    fmt::print(stderr, "{}{}\n", is_watched ? "\r\033[K" : "", search::progress_text(result.progress));
    if (!result.best.score.is_allowed(options.objective)) {
        throw UserError(fmt::format("--{} {}: found no lobes of condition {} or less in {} generations; {}",
                                    options.use().field, options.use().value, options.objective.condition_cap,
                                    result.progress.generation, next_step(options, result.progress)));
    }
    // The start stays as it was, unless the table is for something else: then its command does not make this.
    const bool is_start = start && found_in == 0 && start->use.role == options.use().role;
    const LobeTable best = is_start ? *start : table_of(options, start, result.best, std::max(found_in, 1));
    if (!output.offer(best))
        fmt::print(stderr, "{}: kept as it was: the table there is as good as what was found, or better\n",
                   program::shown(options.out));
    if (!options.archive.empty()) {
        const std::string command = canonical_command(options, start, result.progress.generation);
        const OutputLock lock(options.archive);  // another search may have added to it meanwhile
        std::vector<FoundSet> front = read_front(options.archive, options.use(), problem);
        for (const search::Solution& solution : result.front)
            search::add_to_front(front, FoundSet{solution, command});
        write_front(options.archive, options.use(), front);
    }
    fmt::print("{}\n", program::shown_on_stdout(options.out));
}

}  // namespace

void add_search_command(CLI::App& app) {
    CLI::App* command =
        app.add_subcommand("search", "seek lobe directions for an order and save them as a table");
    const auto options = std::make_shared<SearchOptions>();
    SearchOptions& o = *options;
    CLI::Option_group* use = command->add_option_group("use", "what the lobes are for");
    program::add_number(*use, "--order", o.order,
                        program::from_to(kernels::kSmallestLobeOrder, kLargestOrder),
                        "number of bands that share the lobes");
    CLI::Option* band = program::add_number(*use, "--band", o.band, program::from_to(2, kLargestOrder - 1),
                                            "one band with lobes of its own");
    use->require_option(1);
    command
        ->add_option("--out", o.out,
                     "table to write whenever a better one is found; one that is there and better stays")
        ->check(program::not_empty())
        ->required();
    command->add_option("--for", o.role,
                        "what the table serves: shared or rotate_zhf (a kernel that needs a lower cap on the "
                        "condition), band or band_mirrored (default: shared with --order, band with --band, "
                        "band_mirrored with --mirrors)");
    program::add_number(*command, "--seed", o.seed, {}, "of all randomness")->capture_default_str();
    program::add_number(*command, "--generations", o.generations, program::at_least(1),
                        "to run; with neither these nor --seconds: until none improves for --stall");
    program::add_number(*command, "--seconds", o.seconds, program::above(0, 1e9), "after which to stop");
    CLI::Option* resume =
        command->add_option("--resume", o.resume, "table to start from")->check(CLI::ExistingFile);
    command->add_flag("--plain", o.is_plain,
                      "the paper's genetic algorithm, with no local steps, on the grid");
    command->add_flag("--on-grid", o.stays_on_grid, "no refinement off the grid of Legendre zeros");
    CLI::Option* aligned = command->add_flag(
        "--aligned", o.is_aligned,
        "start from lobes on the equator and on y = 0 in turns, as from order 12 on it always does");
    program::add_numbers(*command, "--zero-bands", o.zero_bands, program::from_to(1, 30),
                         "candidates lie at the Legendre zeros of these bands (default: of all that share "
                         "the lobes; of a band above 8 its own; of one below all up to it)");
    program::add_numbers(
        *command, "--rings", o.rings, program::from_to(1, 60),
        "candidates off the equator lie at phi = k pi / d for these d (default: by the bands)");
    command
        ->add_option("--archive", o.archive,
                     "JSON file for the sets that no other beats in nonzeros, multiplications and condition "
                     "at once; those of earlier searches stay unless beaten")
        ->check(program::not_empty());
    CLI::Option* mirrors = program::add_number(
        *command, "--mirrors", o.mirrors, program::from_to(1, search::kMostMirrors),
        "seek lobes of a band that are closed under so many mirrors through the z axis, by the instructions "
        "of their emitted product");
    mirrors->needs(band);
    aligned->excludes(command->get_option("--plain"))->excludes(mirrors);
    CLI::Option* walk = command->add_flag(
        "--walk", o.walks,
        "seek lobes near those of --resume, anywhere on the sphere: give up some zeros, find others");
    walk->needs(resume)->excludes(aligned);
    program::add_number(*command, "--islands", o.islands, program::from_to(1, 1024),
                        "populations that breed apart, or walkers")
        ->capture_default_str();
    program::add_number(*command, "--population", o.population, program::from_to(4, 1000000),
                        "of an island (default: 6, or 500 with --plain)");
    program::add_number(*command, "--stall", o.stall, program::at_least(1),
                        "generations without improvement (default: 10, or 50 with --plain)");
    program::add_number(*command, "--elite", o.elite, program::from_to(1, 4), "individuals that survive")
        ->capture_default_str();
    program::add_number(
        *command, "--local-moves", o.moves, program::at_least(1),
        "swaps tried on every child (default: 400 times the square of the lobes; 100 times with --mirrors), "
        "or moves of a walker in a generation (default: about a second of them)");
    program::add_number(*command, "--crossover", o.crossover, program::from_to(0.0, 1.0),
                        "fraction of children with two parents")
        ->capture_default_str();
    program::add_number(*command, "--mutation", o.mutation, program::above(0, 1),
                        "rate of an angle (default: one over the number of angles)");
    constexpr double kMostWeight = 1000;
    program::add_number(*command, "--multiplication-weight", o.objective.multiplication_weight,
                        program::from_to(0.0, kMostWeight), "of a multiplication beside a nonzero")
        ->capture_default_str();
    program::add_number(*command, "--condition-weight", o.objective.condition_weight,
                        program::from_to(0.0, kMostWeight),
                        "of a doubling of the worst condition beside a nonzero")
        ->capture_default_str();
    program::add_number(*command, "--condition-cap", o.objective.condition_cap,
                        program::from_to(1.0, kConditionCap), "largest condition of a band")
        ->capture_default_str();
    for (const char* name : {"--plain", "--on-grid", "--archive", "--population", "--elite", "--crossover",
                             "--mutation", "--multiplication-weight"})
        mirrors->excludes(command->get_option(name));
    for (const char* name : {"--plain", "--on-grid", "--mirrors", "--zero-bands", "--rings", "--population",
                             "--elite", "--crossover", "--mutation"})
        walk->excludes(command->get_option(name));
    command->callback([options] { run(*options); });
}

}  // namespace zonal
