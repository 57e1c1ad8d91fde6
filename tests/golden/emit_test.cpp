// The generator as people run it: same bytes every time, and clear errors.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "bounds/published.hpp"
#include "support/built_order.hpp"

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct Outcome {
    int status = 0;
    std::string output;  ///< standard output and error
};

Outcome run(const std::string& command) {
    const fs::path log = fs::path(testing::TempDir()) / fmt::format("zonal_log_{}", getpid());
    const int status = std::system(fmt::format("{} >'{}' 2>&1", command, log.string()).c_str());
    std::ifstream stream(log);
    std::stringstream text;
    text << stream.rdbuf();
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text.str()};
}

Outcome zonal_gen(const std::string& arguments) { return run(fmt::format("'{}' {}", ZONAL_GEN, arguments)); }

std::string read(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// A fresh folder for one test.
fs::path fresh_folder(const std::string& name) {
    const fs::path folder = fs::path(testing::TempDir()) / fmt::format("zonal_{}_{}", name, getpid());
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
}

/// Every file under a folder, and its bytes.
std::map<std::string, std::string> tree(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = read(entry.path());
    return files;
}

TEST(Emit, twice_gives_the_same_bytes_and_those_that_are_committed) {
    const fs::path first = fresh_folder("first"), second = fresh_folder("second");
    ASSERT_EQ(zonal_gen(fmt::format("emit --order 4 --language cpp --out '{}'", first.string())).status, 0);
    ASSERT_EQ(zonal_gen(fmt::format("emit --order 4 --language cpp --out '{}'", second.string())).status, 0);
    EXPECT_EQ(tree(first), tree(second));
    EXPECT_GE(tree(first).size(), 20u);
    for (const auto& [file, text] : tree(first))
        EXPECT_EQ(text, read(fs::path(ZONAL_SOURCE_DIR) / "generated/cpp" / file)) << file;
}

TEST(Emit, several_orders_and_languages_at_once_give_the_bytes_of_one_by_one) {
    const fs::path together = fresh_folder("together"), apart = fresh_folder("apart");
    ASSERT_EQ(zonal_gen(fmt::format("emit --orders 3,5 --languages cpp,glsl,wgsl:4,spirv:3 --out '{}'",
                                    together.string()))
                  .status,
              0);
    for (const auto& [order, language] : std::vector<std::pair<int, std::string>>{
             {3, "cpp"}, {5, "cpp"}, {3, "glsl"}, {5, "glsl"}, {4, "wgsl"}, {3, "spirv"}})
        ASSERT_EQ(zonal_gen(fmt::format("emit --order {0} --language {1} --out '{2}/{1}'", order, language,
                                        apart.string()))
                      .status,
                  0);
    EXPECT_GT(tree(apart).size(), 20u);
    EXPECT_EQ(tree(together), tree(apart));
}

TEST(Emit, orders_that_cannot_be_read_are_quoted_with_the_option) {
    for (const char* orders : {"6-3", "1-4", "3-21", "four", "3,,4", "3,", ",3", "3-", "''"}) {
        const Outcome result = zonal_gen(fmt::format("emit --orders {} --languages cpp", orders));
        EXPECT_NE(result.status, 0) << orders;
        EXPECT_THAT(result.output, AllOf(HasSubstr("--orders"), HasSubstr("3-6"))) << orders;
    }
    const Outcome own = zonal_gen("emit --orders 3 --languages cpp:3+x");
    EXPECT_EQ(own.status, 1);
    EXPECT_THAT(own.output, AllOf(HasSubstr("--languages cpp: found 'x'"), HasSubstr("from 2 to 20")));
}

TEST(Emit, languages_that_cannot_be_emitted_are_named_before_anything_is_written) {
    const fs::path folder = fresh_folder("languages");
    const auto complaint_about = [&](const char* arguments) {
        const Outcome result = zonal_gen(fmt::format("emit {} --out '{}'", arguments, folder.string()));
        EXPECT_EQ(result.status, 1) << arguments;
        return result.output;
    };
    EXPECT_THAT(complaint_about("--orders 3 --languages cpp,cobol"),
                AllOf(HasSubstr("--languages: found 'cobol'"), HasSubstr("glsl")));
    EXPECT_THAT(complaint_about("--languages cobol"), HasSubstr("--languages: found 'cobol', wanted one of"));
    EXPECT_THAT(complaint_about("--orders 3 --languages cpp,"), HasSubstr("--languages: found ''"));
    EXPECT_THAT(complaint_about("--orders 3 --languages ''"), HasSubstr("--languages: found ''"));
    EXPECT_THAT(complaint_about("--orders 3 --languages cpp,glsl,cpp"), HasSubstr("found 'cpp' twice"));
    EXPECT_THAT(complaint_about("--languages cpp:3,glsl"), HasSubstr("--languages glsl: found no orders"));
    EXPECT_THAT(complaint_about("--language cpp"), HasSubstr("wanted --order N"));
    EXPECT_TRUE(fs::is_empty(folder));
}

std::vector<std::string> names_of(const std::map<std::string, std::string>& files) {
    std::vector<std::string> names;
    for (const auto& [name, text] : files) names.push_back(name);
    return names;
}

TEST(Emit, kernels_that_are_named_come_with_what_they_call_and_nothing_else) {
    const fs::path folder = fresh_folder("only");
    ASSERT_EQ(
        zonal_gen(
            fmt::format("emit --order 4 --languages cpp,glsl,spirv,wgsl --kernels blocks,rotate --out '{}'",
                        folder.string()))
            .status,
        0);
    EXPECT_THAT(names_of(tree(folder)),
                testing::ElementsAre("cpp/zonal/kernel_support.hpp", "cpp/zonal/order04/blocks.hpp",
                                     "cpp/zonal/order04/rotate.hpp", "cpp/zonal/order04/rotate_channels.hpp",
                                     "cpp/zonal/order04/rotate_tensor.hpp", "glsl/order04/blocks.glsl",
                                     "glsl/order04/rotate.glsl", "spirv/order04/blocks.spvasm",
                                     "spirv/order04/rotate.spvasm", "wgsl/order04/blocks.wgsl",
                                     "wgsl/order04/rotate.wgsl"));
    for (const auto& [name, text] : tree(folder / "glsl"))
        EXPECT_EQ(text, read(fs::path(ZONAL_SOURCE_DIR) / "generated/glsl" / name)) << name;
}

TEST(Emit, a_kernel_that_is_not_there_is_named_before_anything_is_written) {
    const fs::path folder = fresh_folder("no_kernel");
    const auto complaint_about = [&](const char* arguments) {
        const Outcome result = zonal_gen(fmt::format("emit {} --out '{}'", arguments, folder.string()));
        EXPECT_EQ(result.status, 1) << arguments;
        return result.output;
    };
    EXPECT_THAT(complaint_about("--order 4 --language cpp --kernels rotate,spin"),
                AllOf(HasSubstr("--kernels: found 'spin'"), HasSubstr("rotate, rotate_channels, "),
                      Not(HasSubstr("kernel_support"))));
    EXPECT_THAT(complaint_about("--orders 3,4 --languages glsl,cpp --kernels spin"),
                AllOf(HasSubstr("found 'spin'"), HasSubstr("rotate_tailored")));
    EXPECT_THAT(complaint_about("--order 4 --language js --kernels blocks"),
                AllOf(HasSubstr("has in js: rotate, rotate_accurate\n")));
    EXPECT_THAT(complaint_about("--order 4 --language cpp --kernels rotate,"), HasSubstr("found ''"));
    EXPECT_THAT(complaint_about("--order 4 --language cpp --kernels kernel_support"),
                HasSubstr("found 'kernel_support'"));
    EXPECT_TRUE(fs::is_empty(folder));
}

/// The comment that a file begins with.
std::vector<std::string> banner_of(const std::string& text) {
    const std::string sign = text.substr(0, text.find(' ') + 1);
    std::istringstream lines(text);
    std::vector<std::string> banner;
    for (std::string line; std::getline(lines, line) && line.starts_with(sign);) banner.push_back(line);
    return banner;
}

TEST(Emit, a_banner_names_the_command_of_its_file_and_takes_15_lines_at_most) {
    const fs::path generated = fs::path(ZONAL_SOURCE_DIR) / "generated";
    int kernels = 0;
    for (const char* language : {"cpp", "glsl"})
        for (const auto& [name, text] : tree(generated / language)) {
            const fs::path file = name;
            if (file.parent_path().filename().string().find("order") == std::string::npos) continue;
            const std::vector<std::string> banner = banner_of(text);
            ++kernels;
            EXPECT_LE(banner.size(), 15u) << name;
            ASSERT_GE(banner.size(), 4u) << name;
            EXPECT_THAT(banner[1], testing::EndsWith(fmt::format("--language {} --kernels {}", language,
                                                                 file.stem().string())))
                << name;
            const bool needs_tables = text.find("sha256:") != std::string::npos;
            EXPECT_EQ(needs_tables, text.find("generator/tables/") != std::string::npos) << name;
        }
    EXPECT_GT(kernels, 200);
}

TEST(Emit, the_command_of_a_banner_makes_the_file_again) {
    const fs::path generated = fs::path(ZONAL_SOURCE_DIR) / "generated";
    for (const std::string file :
         {"cpp/zonal/order03/stable_rotate_zhf.hpp", "glsl/order04/rotate_tailored.glsl",
          "spirv/order03/per_band_lobes.spvasm", "cpp/zonal/order05.hpp"}) {
        const fs::path folder = fresh_folder("command");
        const std::string text = read(generated / file);
        const std::size_t at = text.find("zonal-gen emit ");
        ASSERT_NE(at, std::string::npos) << file;
        const std::string arguments = text.substr(at + 10, text.find('\n', at) - at - 10);
        ASSERT_EQ(run(fmt::format("cd '{}' && '{}' {}", folder.string(), ZONAL_GEN, arguments)).status, 0);
        EXPECT_EQ(read(folder / "generated" / file), text) << file;
    }
}

TEST(Emit, a_table_touches_the_files_made_of_it_and_no_others) {
    const fs::path folder = fresh_folder("touched");
    std::string table = read(fs::path(ZONAL_SOURCE_DIR) / "generator/tables/shared/order03.json");
    const std::string key = "\"command\": \"";
    table.insert(table.find(key) + key.size(), "nice ");  // another file, the same lobes
    std::ofstream(folder / "other.json") << table;
    const auto emit = [&](const char* options) {
        return run(fmt::format("cd '{}' && '{}' emit --order 3 --language cpp {}", folder.string(), ZONAL_GEN,
                               options))
            .status;
    };
    ASSERT_EQ(emit("--out usual"), 0);
    ASSERT_EQ(emit("--table other.json --out other"), 0);
    const auto usual = tree(folder / "usual"), other = tree(folder / "other");
    ASSERT_EQ(names_of(usual), names_of(other));
    std::vector<std::string> touched;
    for (const auto& [name, text] : usual)
        if (text != other.at(name)) touched.push_back(name);
    EXPECT_THAT(touched, testing::ElementsAre("zonal/order03.hpp", "zonal/order03/expand.hpp",
                                              "zonal/order03/factorize.hpp", "zonal/order03/lobes.hpp",
                                              "zonal/order03/resample.hpp", "zonal/order03/rotate_zhf.hpp"));
}

TEST(Emit, headers_of_order_4_are_short) {
    const auto lines = [](const char* file) {
        const std::string text = read(fs::path(ZONAL_SOURCE_DIR) / "generated" / file);
        return std::ranges::count(text, '\n');
    };
    EXPECT_LT(lines("glsl/order04/rotate.glsl"), 400);
    EXPECT_LT(lines("cpp/zonal/order04/rotate.hpp"), 300);
    EXPECT_LT(lines("cpp/zonal/order04.hpp"), 60);
}

TEST(Emit, lines_have_at_most_100_columns_and_no_place_or_time) {
    const fs::path folder = fresh_folder("columns");
    for (const int order : {2, 3, 4, 6, 10, 12}) {
        ASSERT_EQ(zonal_gen(fmt::format("emit --order {} --language cpp --out '{}'", order, folder.string()))
                      .status,
                  0);
    }
    for (const auto& [name, text] : tree(folder)) {
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);)
            EXPECT_LE(line.size(), 100u) << name << ": " << line;
        EXPECT_THAT(text, Not(HasSubstr(folder.string())));
    }
}

TEST(Emit, every_shader_of_order_3_is_as_committed) {
    for (const std::string language : {"glsl", "spirv"}) {
        const fs::path folder = fresh_folder(language),
                       committed = fs::path(ZONAL_SOURCE_DIR) / "generated" / language;
        ASSERT_EQ(zonal_gen(fmt::format("emit --order 3 --language {} --out '{}'", language, folder.string()))
                      .status,
                  0);
        EXPECT_GE(tree(folder).size(), 15u);
        for (const auto& [file, text] : tree(folder)) EXPECT_EQ(text, read(committed / file)) << file;
    }
}

TEST(Emit, glsl_has_nothing_that_a_dialect_lacks) {
    const std::string text = read(fs::path(ZONAL_SOURCE_DIR) / "generated/glsl/order04/rotate.glsl");
    EXPECT_THAT(
        text,
        AllOf(HasSubstr(
                  "void zonal_order4_rotate(highp float R[9], highp float f[16], out highp float o[16]) {"),
              HasSubstr(
                  "void zonal_order4_rotate(highp float R[9], highp vec3 f[16], out highp vec3 o[16]) {")));
    EXPECT_THAT(text, AllOf(Not(HasSubstr("#version")), Not(HasSubstr("fma(")), Not(HasSubstr("precise "))));
}

TEST(Emit, a_precise_module_differs_by_its_decorations_alone) {
    const fs::path folder = fresh_folder("precise");
    ASSERT_EQ(zonal_gen(fmt::format("emit --order 4 --language spirv --kernels rotate --twins --out '{}'",
                                    folder.string()))
                  .status,
              0);
    const auto without_decorations = [&](const char* file, int& decorations) {
        std::istringstream lines(read(folder / file));
        std::string rest;
        for (std::string line; std::getline(lines, line);) {
            const bool is_decoration = line.find("NoContraction") != std::string::npos;
            decorations += is_decoration;
            if (!is_decoration && !line.starts_with(';')) rest += line + "\n";
        }
        return rest;
    };
    int plain = 0, precise = 0;
    EXPECT_EQ(without_decorations("order04/rotate.spvasm", plain),
              without_decorations("order04/rotate_precise.spvasm", precise));
    EXPECT_LT(plain, 10);
    EXPECT_GT(precise, 118);  // instructions of rotate
}

TEST(Emit, optimized_modules_are_valid_and_the_same_every_time) {
    const fs::path first = fresh_folder("optimized"), second = fresh_folder("optimized_again");
    for (const fs::path& folder : {first, second})
        ASSERT_EQ(zonal_gen(fmt::format("emit --order 3 --language spirv --optimize --binary --out '{}'",
                                        folder.string()))
                      .status,
                  0);
    const std::string text = read(first / "order03/rotate.spvasm");
    EXPECT_EQ(text, read(second / "order03/rotate.spvasm"));
    const std::string committed = read(fs::path(ZONAL_SOURCE_DIR) / "generated/spirv/order03/rotate.spvasm");
    EXPECT_LT(std::ranges::count(text, '\n'), std::ranges::count(committed, '\n'));
    EXPECT_THAT(text, AllOf(testing::StartsWith("; Generated by zonal-gen."), HasSubstr("--optimize")));
    const std::string binary = read(first / "order03/rotate.spv");
    ASSERT_GE(binary.size(), 20u);
    EXPECT_EQ(binary.substr(0, 4), "\x03\x02\x23\x07");  // the magic number of SPIR-V, little-endian
}

TEST(Emit, options_of_spirv_are_refused_elsewhere) {
    const Outcome result = zonal_gen("emit --order 3 --language glsl --optimize");
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.output, AllOf(HasSubstr("--optimize"), HasSubstr("glsl"), HasSubstr("wanted spirv")));
    const Outcome twins = zonal_gen("emit --order 3 --language glsl --twins");
    EXPECT_EQ(twins.status, 1);
    EXPECT_THAT(twins.output, AllOf(HasSubstr("--twins: found without spirv"), HasSubstr("wanted spirv")));
}

TEST(Emit, wgsl_has_a_function_for_channels_too) {
    const fs::path folder = fresh_folder("wgsl");
    ASSERT_EQ(zonal_gen(fmt::format("emit --order 4 --language wgsl --out '{}'", folder.string())).status, 0);
    const std::string text = read(folder / "order04/rotate.wgsl");
    EXPECT_THAT(text,
                HasSubstr("fn zonal_order4_rotate(R: array<f32, 9>, f: array<f32, 16>) -> array<f32, 16> {"));
    EXPECT_THAT(text, HasSubstr("fn zonal_order4_rotate_rgb(R: array<f32, 9>, f: array<vec3<f32>, 16>)"));
    EXPECT_THAT(text, Not(HasSubstr("fma(")));
}

TEST(Emit, an_order_out_of_range_is_named) {
    for (const int order : {-1, 0, 21}) {
        const Outcome result =
            zonal_gen(fmt::format("emit --order {} --language cpp --out '{}'", order, testing::TempDir()));
        EXPECT_EQ(result.status, 1);
        EXPECT_THAT(result.output, AllOf(HasSubstr("--order"), HasSubstr(std::to_string(order)),
                                         HasSubstr("wanted a whole number from 2 to 20")));
    }
}

TEST(Emit, an_order_without_lobes_has_none_of_their_kernels_and_says_so) {
    const fs::path folder = fresh_folder("no_lobes");
    ASSERT_EQ(zonal_gen(fmt::format("emit --order 2 --language cpp --out '{}'", folder.string())).status, 0);
    EXPECT_THAT(
        read(folder / "zonal/order02.hpp"),
        AllOf(HasSubstr("order02/rotate.hpp"), Not(HasSubstr("rotate_zhf")), HasSubstr("kHasLobes = 0")));
    EXPECT_THAT(read(folder / "zonal/order02/rotate.hpp"), Not(HasSubstr("table")));
    EXPECT_FALSE(fs::exists(folder / "zonal/order02/rotate_zhf.hpp"));
}

TEST(Emit, a_missing_folder_of_tables_is_an_error) {
    const fs::path folder = fresh_folder("no_tables");
    for (const char* command :
         {"emit --language cpp --out x --order 6", "stats --order 6", "paper --sets 1"}) {
        const Outcome result = run(
            fmt::format("cd '{}' && ZONAL_TABLES_DIR=/nowhere '{}' {}", folder.string(), ZONAL_GEN, command));
        EXPECT_EQ(result.status, 1) << command;
        EXPECT_THAT(result.output, HasSubstr("/nowhere: found no such folder")) << command;
    }
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Emit, banner_of_a_chosen_table_holds_the_command_that_makes_it_again) {
    const fs::path folder = fresh_folder("chosen");
    const fs::path table = fs::path(ZONAL_SOURCE_DIR) / "generator/tables/shared/order03.json";
    fs::create_directories(folder / "my tables");
    fs::copy_file(table, folder / "my tables/it's.json");
    const auto emit = [&](const std::string& options) {
        return run(fmt::format("cd '{}' && '{}' emit --order 3 --language cpp {}", folder.string(), ZONAL_GEN,
                               options));
    };
    ASSERT_EQ(emit("--table \"my tables/it's.json\" --out generated/cpp").status, 0);
    const fs::path header = folder / "generated/cpp/zonal/order03/factorize.hpp";
    const std::string text = read(header), key = "// command : zonal-gen ";
    const std::string command = text.substr(text.find(key) + key.size());
    EXPECT_THAT(read(folder / "generated/cpp/zonal/order03/rotate.hpp"), Not(HasSubstr("--table")));
    fs::remove_all(folder / "generated");
    EXPECT_EQ(run(fmt::format("cd '{}' && '{}' {}", folder.string(), ZONAL_GEN,
                              command.substr(0, command.find('\n'))))
                  .status,
              0);
    EXPECT_EQ(read(header), text);
}

/// Of a kernel with quotients and roots, and of one without: what the file of a language says first of
/// errors.
TEST(Emit, each_language_publishes_the_bounds_of_its_own_arithmetic) {
    const auto bounds = zonal::published_bounds(zonal::built_order(4));
    const auto text_of = [](const char* path) {
        return read(fs::path(ZONAL_SOURCE_DIR) / "generated" / path);
    };
    const zonal::Bound &fewest = bounds.at("rotate_fewest"), &accurate = bounds.at("rotate_accurate");
    ASSERT_NE(fewest.shader, fewest.float_apart);
    EXPECT_THAT(
        text_of("cpp/zonal/order04/rotate_fewest.hpp"),
        AllOf(HasSubstr(fmt::format("bound   : {} (float), {} (double), with fused", fewest.float_text,
                                    fewest.double_text)),
              HasSubstr(fmt::format("{}, {} without them", fewest.float_apart, fewest.double_apart))));
    for (const char* path : {"glsl/order04/rotate_fewest.glsl", "hlsl/order04/rotate_fewest.hlsl",
                             "wgsl/order04/rotate_fewest.wgsl", "spirv/order04/rotate_fewest.spvasm"})
        EXPECT_THAT(text_of(path), AllOf(HasSubstr(fmt::format("bound   : {} in float", fewest.float_apart)),
                                         HasSubstr(fmt::format("{} where they are off", fewest.shader))))
            << path;
    EXPECT_THAT(text_of("glsl/order04/rotate_accurate.glsl"),
                HasSubstr(fmt::format("bound   : {} in float, fused or not, for", accurate.shader)));
    EXPECT_THAT(text_of("js/order04/rotate_accurate.mjs"),
                HasSubstr(fmt::format("bound   : {} in double", accurate.double_apart)));
}

TEST(Emit, what_is_left_out_is_said_and_written_when_named) {
    const fs::path folder = fresh_folder("long");
    const Outcome all = zonal_gen(fmt::format("emit --order 12 --language cpp --out '{}'", folder.string()));
    EXPECT_EQ(all.status, 0);
    EXPECT_THAT(all.output,
                HasSubstr("order12: left out, since compilers take long for them: stable_rotate_zhf;"));
    const fs::path place = folder / "zonal/order12";
    EXPECT_TRUE(fs::exists(place / "rotate_zhf.hpp"));
    EXPECT_FALSE(fs::exists(place / "stable_rotate_zhf.hpp"));
    EXPECT_THAT(read(folder / "zonal/order12.hpp"), Not(HasSubstr("stable_rotate_zhf")));
    EXPECT_THAT(
        zonal_gen(fmt::format("emit --order 12 --language cpp --kernels spin --out '{}'", folder.string()))
            .output,
        HasSubstr("stable_rotate_zhf"));
    EXPECT_EQ(zonal_gen(fmt::format("emit --order 12 --language cpp --kernels stable_rotate_zhf --out '{}'",
                                    folder.string()))
                  .status,
              0);
    EXPECT_TRUE(fs::exists(place / "stable_rotate_zhf.hpp"));
}

TEST(Emit, a_table_that_no_kernel_is_made_of_is_an_error) {
    const fs::path folder = fresh_folder("idle_table");
    for (const char* what : {"--language js", "--language cpp --kernels rotate,blocks"}) {
        const Outcome result = zonal_gen(
            fmt::format("emit --order 3 {} --table '{}/generator/tables/shared/order03.json' --out '{}'",
                        what, ZONAL_SOURCE_DIR, folder.string()));
        EXPECT_EQ(result.status, 1) << what;
        EXPECT_THAT(result.output, AllOf(HasSubstr("--table"), HasSubstr("order03.json"))) << what;
    }
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST(Emit, a_table_that_cannot_serve_gets_advice_that_helps) {
    const fs::path folder = fs::path(ZONAL_SOURCE_DIR) / "generator/tables";
    const auto complaint_about = [&](int order, const fs::path& table) {
        const Outcome result = zonal_gen(fmt::format("emit --order {} --language cpp --table '{}' --out '{}'",
                                                     order, table.string(), fresh_folder("advice").string()));
        EXPECT_EQ(result.status, 1);
        return result.output;
    };
    EXPECT_THAT(
        complaint_about(4, folder),
        AllOf(HasSubstr("it is a folder"), HasSubstr("name another table"), Not(HasSubstr("restore"))));
    EXPECT_THAT(complaint_about(4, folder / "band/band04.json"),
                AllOf(HasSubstr("band: found 4, wanted a table of order 4"), Not(HasSubstr("restore"))));
    EXPECT_THAT(complaint_about(4, folder / "shared/order05.json"),
                AllOf(HasSubstr("order: found 5, wanted 4"), Not(HasSubstr("restore"))));
    EXPECT_THAT(complaint_about(2, folder / "shared/order03.json"), HasSubstr("drop --table"));
}

TEST(Emit, an_unknown_subcommand_is_named_with_the_known_ones) {
    for (const char* arguments : {"frob", "frob emit --order 3 --language cpp", ""}) {
        const Outcome result = zonal_gen(arguments);
        EXPECT_EQ(result.status, 1) << arguments;
        EXPECT_THAT(result.output, AllOf(HasSubstr(*arguments == 0 ? "found none" : "found 'frob'"),
                                         HasSubstr("search, emit, stats, paper")))
            << arguments;
    }
}

TEST(Emit, an_unknown_language_is_named_with_the_known_ones) {
    const Outcome result = zonal_gen("emit --order 4 --language cobol");
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.output, AllOf(HasSubstr("cobol"), HasSubstr("cpp")));
}

TEST(Emit, a_missing_table_is_named_with_the_next_step) {
    const Outcome result = zonal_gen("emit --order 4 --language cpp --table /nowhere/lobes.json");
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.output, AllOf(HasSubstr("/nowhere/lobes.json"), HasSubstr("zonal-gen search")));
}

TEST(Emit, a_folder_that_cannot_be_written_is_named_and_gets_no_half_file) {
    const fs::path folder = fresh_folder("blocked");
    std::ofstream(folder / "zonal") << "a file where a folder is wanted";
    const Outcome result =
        zonal_gen(fmt::format("emit --order 4 --language cpp --out '{}'", folder.string()));
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.output, AllOf(HasSubstr(folder.string()), HasSubstr("cannot write")));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

/// A copy of the committed kernels that a test may spoil.
fs::path copy_of_generated(const std::string& name) {
    const fs::path folder = fresh_folder(name);
    fs::copy(fs::path(ZONAL_SOURCE_DIR) / "generated", folder, fs::copy_options::recursive);
    return folder;
}

/// A generator that writes what is committed, and at once: what tests of the script alone need.
fs::path writer_of_the_committed() {
    const fs::path writer = fresh_folder("writer") / "zonal-gen";
    std::ofstream(writer) << fmt::format(
        "#!/usr/bin/env bash\n"
        "# emit --languages LANGUAGES --out FOLDER\n"
        "mkdir -p \"$5\" && /bin/cp -r '{}/generated/.' \"$5\"\n",
        ZONAL_SOURCE_DIR);
    fs::permissions(writer, fs::perms::owner_all);
    return writer;
}

/// `programs`: a folder whose programs stand in for those of the system.
Outcome check_generated(const fs::path& generator, const fs::path& folder, const std::string& option = "",
                        const fs::path& programs = {}) {
    return run(fmt::format("PATH='{}':\"$PATH\" bash '{}/cmake/check_generated.sh' {} '{}' '{}'",
                           programs.empty() ? "/usr/bin" : programs.string(), ZONAL_SOURCE_DIR, option,
                           generator.string(), folder.string()));
}

TEST(CheckGenerated, the_committed_code_is_what_the_generator_writes) {
    const Outcome result = check_generated(ZONAL_GEN, fs::path(ZONAL_SOURCE_DIR) / "generated");
    EXPECT_EQ(result.status, 0) << result.output;
}

TEST(CheckGenerated, a_file_edited_by_hand_fails_with_the_difference_and_the_accepting_command) {
    const fs::path folder = copy_of_generated("edited");
    std::ofstream(folder / "cpp/zonal/order04/rotate.hpp", std::ios::app) << "// by hand\n";
    const Outcome result = check_generated(writer_of_the_committed(), folder);
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.output, AllOf(HasSubstr("// by hand"), HasSubstr("--accept")));
}

TEST(CheckGenerated, a_missing_file_fails) {
    const fs::path folder = copy_of_generated("missing");
    fs::remove(folder / "cpp/zonal/order05.hpp");
    const Outcome result = check_generated(writer_of_the_committed(), folder);
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.output, AllOf(HasSubstr("order05.hpp"), HasSubstr("list of files differs")));
}

TEST(CheckGenerated, an_orphaned_file_fails) {
    const fs::path folder = copy_of_generated("orphaned");
    std::ofstream(folder / "cpp/zonal/order99.hpp") << "// nobody writes this\n";
    const Outcome result = check_generated(writer_of_the_committed(), folder);
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.output, AllOf(HasSubstr("order99.hpp"), HasSubstr("list of files differs")));
}

TEST(CheckGenerated, a_folder_that_is_not_there_is_named) {
    const fs::path folder = fresh_folder("nowhere") / "nogen";
    const Outcome result = check_generated(writer_of_the_committed(), folder);
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.output,
                AllOf(HasSubstr(folder.string() + ": found no such folder"), HasSubstr("--accept")));
    EXPECT_FALSE(fs::exists(folder));
}

TEST(CheckGenerated, accepting_that_fails_leaves_the_old_files) {
    const fs::path around = fresh_folder("unaccepted"), folder = around / "generated";
    fs::copy(fs::path(ZONAL_SOURCE_DIR) / "generated/glsl", folder, fs::copy_options::recursive);
    std::ofstream(folder / "mine.glsl") << "// the only copy\n";
    const auto before = tree(around);
    const auto program = [&](const char* name, const char* body) {
        const fs::path programs = fresh_folder(fmt::format("instead_of_{}", name));
        std::ofstream(programs / name) << "#!/bin/bash\n" << body << '\n';
        fs::permissions(programs / name, fs::perms::owner_all);
        return programs;
    };
    const fs::path full_disk = program("cp", "/bin/cp \"$@\"; rm -rf \"${@: -1}/cpp\"; exit 1");
    const fs::path no_place = program("mv", "case \"$1\" in */new) exit 1;; *) exec /bin/mv \"$@\";; esac");
    const fs::path failing = program("zonal-gen", "mkdir -p \"$5\"; exit 1") / "zonal-gen";
    const fs::path writer = writer_of_the_committed();
    for (const auto& [generator, programs] :
         std::vector<std::pair<fs::path, fs::path>>{{failing, {}}, {writer, full_disk}, {writer, no_place}}) {
        EXPECT_NE(check_generated(generator, folder, "--accept", programs).status, 0) << programs;
        EXPECT_TRUE(tree(around) == before) << programs;  // a difference has megabytes
    }
}

TEST(CheckGenerated, accepting_puts_the_generators_output_in_place) {
    const fs::path folder = copy_of_generated("accepted");
    fs::remove(folder / "cpp/zonal/order05.hpp");
    const fs::path generator = writer_of_the_committed();
    ASSERT_EQ(check_generated(generator, folder, "--accept").status, 0);
    EXPECT_TRUE(fs::exists(folder / "cpp/zonal/order05.hpp"));
    EXPECT_EQ(check_generated(generator, folder).status, 0);
}

}  // namespace
