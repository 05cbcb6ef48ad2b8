#include <charconv>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "generate/option_tables.hpp"
#include "nda/generate.hpp"
#include "nda/io.hpp"

namespace nda::cli {
namespace {

// One family: its parser and what makes the instance when it was chosen.
struct Family {
  CLI::App* parser;
  std::shared_ptr<std::string> output;
  std::function<Instance()> generate;
};

CLI::App* add_family(CLI::App& parent, const char* name, const char* summary, const char* example) {
  CLI::App* parser = parent.add_subcommand(name, summary);
  parser->footer(std::string("Example:\n  ") + example);
  return parser;
}

// CLI11 takes -1, and whatever is too large, for the largest unsigned number.
template <typename T>
CLI::Validator whole_number() {
  return CLI::Validator(
      [](const std::string& text) {
        T value{};
        const char* end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, value);
        if (error == std::errc() && stop == end) return std::string();
        using Limits = std::numeric_limits<T>;
        return "'" + text + "' given, it must be a whole number from " +
               std::to_string(Limits::lowest()) + " to " + std::to_string(Limits::max());
      },
      "");
}

template <typename T>
CLI::Option* add_option(CLI::App* parser, const std::string& flag, T& value, std::string help) {
  CLI::Option* option = parser->add_option(flag, value, std::move(help));
  if constexpr (std::is_integral_v<T>) option->check(whole_number<T>());
  return option;
}

// The option of a row of generate::OptionTable, without its default.
template <typename Row, typename Options>
CLI::Option* add_row(CLI::App* parser, const Row& row, Options& options) {
  return add_option(parser,
                    generate::flag_of(row.name),
                    options.*row.field,
                    std::string(row.help) + "; in [" + generate::shortest(row.least, true) + ", " +
                        generate::shortest(row.most, true) + "]");
}

Family finish(CLI::App* parser, std::uint64_t& seed, std::function<Instance()> generate) {
  const auto output = std::make_shared<std::string>("-");
  add_option(parser, "--seed", seed, "the same seed gives the same file")->capture_default_str();
  parser
      ->add_option("-o,--output", *output, "file to write, .nda or .nda.gz; '-' is standard output")
      ->capture_default_str();
  return {parser, output, std::move(generate)};
}

void add_singletons(CLI::App* parser, PlantedSingletons& singletons) {
  static const std::map<std::string, PlantedSingletons> kKinds = {
      {"free", PlantedSingletons::kFree},
      {"priced", PlantedSingletons::kPriced},
      {"forbidden", PlantedSingletons::kForbidden}};
  parser
      ->add_option_function<std::string>(
          "--singletons",
          [&singletons](const std::string& kind) {
            const auto found = kKinds.find(kind);
            if (found == kKinds.end()) {
              throw CLI::ValidationError(
                  "--singletons", "'" + kind + "' given, it must be free, priced or forbidden");
            }
            singletons = found->second;
          },
          "free, priced or forbidden")
      ->default_str("free");
}

template <typename Options>
Family declare_family(CLI::App* parser, Instance (*generate)(const Options&)) {
  const auto options = std::make_shared<Options>();
  generate::for_each_row(generate::OptionTable<Options>::kRows, [&](const auto& row) {
    add_row(parser, row, *options)->capture_default_str();
  });
  if constexpr (std::is_same_v<Options, PlantedOptions>) {
    add_singletons(parser, options->singletons);
  }
  return finish(parser, options->seed, [options, generate] { return generate(*options); });
}

// Options of the tracking families: those given override the preset's.
struct TrackingArguments {
  std::string preset;
  TrackingOptions given;
  std::vector<std::function<void(TrackingOptions&)>> overrides;

  TrackingOptions resolve() const {
    TrackingOptions options = tracking_preset(preset);
    for (const auto& override_one : overrides) override_one(options);
    options.seed = given.seed;
    return options;
  }

  template <typename Row>
  void add(CLI::App* parser, const Row& row) {
    const CLI::Option* option = add_row(parser, row, given);
    overrides.push_back([this, option, field = row.field](TrackingOptions& options) {
      if (option->count() > 0) options.*field = given.*field;
    });
  }
};

Family declare_tracking(CLI::App* parser, const char* preset) {
  const auto arguments = std::make_shared<TrackingArguments>();
  arguments->preset = preset;
  parser
      ->add_option("--preset",
                   arguments->preset,
                   "small, medium, large, largesparse, huge, hard6, hard7, hard8, largegroup, "
                   "six-scan; what is given besides overrides it")
      ->capture_default_str();
  generate::for_each_row(generate::OptionTable<TrackingOptions>::kRows,
                         [&](const auto& row) { arguments->add(parser, row); });
  return finish(parser, arguments->given.seed, [arguments] {
    return generate_tracking(arguments->resolve());
  });
}

int write(const Family& family) {
  const Instance instance = family.generate();
  WriteOptions options;
  options.comments = instance.comments;
  write_problem(instance.problem, *family.output, options);
  std::cerr << instance.problem.num_arcs() << " arcs, " << instance.problem.num_indices()
            << " indices in " << instance.problem.num_dimensions() << " dimensions\n";
  return kAnswer;
}

}  // namespace

Action declare_generate(CLI::App& parser) {
  parser.require_subcommand(0, 1);
  parser.footer(
      "docs/families.md defines the families.  The same options give the same file everywhere.\n"
      "\n"
      "Example: 20 targets in 5 scans\n"
      "  nda generate tracking --scans 5 --targets 20 --seed 3 -o window.nda");
  const auto named = [&parser](const char* name, const char* summary, const char* example) {
    return add_family(parser, name, summary, example);
  };
  const std::vector<Family> families = {
      declare_family(named("poore-5.1",
                           "random arcs, costs in [-100, -1]",
                           "nda generate poore-5.1 --arcs 20000 --seed 7 -o random.nda.gz"),
                     generate_poore_sparse),
      declare_family(named("poore-5.3",
                           "a share of all tuples, costs in [1, 100]",
                           "nda generate poore-5.3 --min-size 5 --max-size 9 -o random.nda"),
                     generate_poore_dense),
      declare_tracking(named("tracking",
                             "targets, noise, misses and clutter",
                             "nda generate tracking --preset medium --seed 2 -o medium.nda.gz"),
                       "small"),
      declare_tracking(named("groups",
                             "the same with targets in tight groups",
                             "nda generate groups --preset hard8 --seed 1 -o hard8.nda.gz"),
                       "hard6"),
      declare_tracking(named("six-scan",
                             "one hard problem of six scans",
                             "nda generate six-scan --seed 1 -o six.nda.gz"),
                       "six-scan"),
      declare_family(named("map3",
                           "dense, integer costs, everything must be covered",
                           "nda generate map3 --size 20 --max-cost 1000 -o cube.nda.gz"),
                     generate_map3),
      declare_family(named("planted",
                           "optimum known at any size, no gap",
                           "nda generate planted --size 10000 --arcs 1000000 -o planted.nda.gz"),
                     generate_planted),
      declare_family(named("gadgets",
                           "optimum known, with an integrality gap",
                           "nda generate gadgets --gadgets 1000 -o gadgets.nda"),
                     generate_gadgets),
      declare_family(named("bounded",
                           "many-to-one: random arcs, random bounds on uses",
                           "nda generate bounded --size 20 --arcs 300 -o bounded.nda"),
                     generate_bounded),
      declare_family(named("merged",
                           "many-to-one: merged measurements and split targets",
                           "nda generate merged --targets 30 --side 250 -o merged.nda"),
                     generate_merged),
  };
  return [families] {
    for (const Family& family : families) {
      if (family.parser->parsed()) return write(family);
    }
    throw InputError("no family given (nda generate --help lists the families)");
  };
}

}  // namespace nda::cli
