#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
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

// CLI11 would take -1 for the largest unsigned number.
template <typename T>
CLI::Option* add_option(CLI::App* parser, const char* flag, T& value, const char* help) {
  CLI::Option* option = parser->add_option(flag, value, help);
  if (std::is_unsigned_v<T>) option->check(at_least(0));
  return option;
}

template <typename T>
void add(CLI::App* parser, const char* flag, T& value, const char* help) {
  add_option(parser, flag, value, help)->capture_default_str();
}

Family finish(CLI::App* parser, std::uint64_t& seed, std::function<Instance()> generate) {
  const auto output = std::make_shared<std::string>("-");
  add(parser, "--seed", seed, "the same seed gives the same file");
  parser
      ->add_option("-o,--output", *output, "file to write, .nda or .nda.gz; '-' is standard output")
      ->capture_default_str();
  return {parser, output, std::move(generate)};
}

Family declare_poore_sparse(CLI::App& parent) {
  const auto options = std::make_shared<PooreSparseOptions>();
  CLI::App* parser = add_family(parent,
                                "poore-5.1",
                                "random arcs, costs in [-100, -1]",
                                "nda generate poore-5.1 --arcs 20000 --seed 7 -o random.nda.gz");
  add(parser, "--dimensions", options->dimensions, "N");
  add(parser, "--min-size", options->min_size, "least M_k");
  add(parser, "--max-size", options->max_size, "largest M_k");
  add(parser, "--arcs", options->arcs, "number of arcs");
  return finish(parser, options->seed, [options] { return generate_poore_sparse(*options); });
}

Family declare_poore_dense(CLI::App& parent) {
  const auto options = std::make_shared<PooreDenseOptions>();
  CLI::App* parser = add_family(parent,
                                "poore-5.3",
                                "a share of all tuples, costs in [1, 100]",
                                "nda generate poore-5.3 --min-size 5 --max-size 9 -o random.nda");
  add(parser, "--dimensions", options->dimensions, "N");
  add(parser, "--min-size", options->min_size, "least M_k");
  add(parser, "--max-size", options->max_size, "largest M_k");
  add(parser, "--share", options->share, "share of the tuples that are arcs");
  return finish(parser, options->seed, [options] { return generate_poore_dense(*options); });
}

Family declare_map3(CLI::App& parent) {
  const auto options = std::make_shared<Map3Options>();
  CLI::App* parser = add_family(parent,
                                "map3",
                                "dense, integer costs, everything must be covered",
                                "nda generate map3 --size 20 --max-cost 1000 -o cube.nda.gz");
  add(parser, "--dimensions", options->dimensions, "N");
  add(parser, "--size", options->size, "M_k of every dimension");
  add(parser, "--min-cost", options->min_cost, "least cost");
  add(parser, "--max-cost", options->max_cost, "largest cost");
  return finish(parser, options->seed, [options] { return generate_map3(*options); });
}

Family declare_planted(CLI::App& parent) {
  const auto options = std::make_shared<PlantedOptions>();
  CLI::App* parser =
      add_family(parent,
                 "planted",
                 "optimum known at any size, no gap",
                 "nda generate planted --size 10000 --arcs 1000000 -o planted.nda.gz");
  add(parser, "--dimensions", options->dimensions, "N");
  add(parser, "--size", options->size, "M_k of every dimension");
  add(parser, "--arcs", options->arcs, "arcs besides the planted ones");
  add(parser, "--miss-rate", options->miss_rate, "share of dummies in an arc");
  add(parser, "--spread", options->spread, "how far apart the indices of an arc lie; 0 = anywhere");
  add(parser, "--max-multiplier", options->max_multiplier, "size of the multipliers");
  add(parser, "--max-slack", options->max_slack, "largest reduced cost");
  static const std::map<std::string, PlantedSingletons> kKinds = {
      {"free", PlantedSingletons::kFree},
      {"priced", PlantedSingletons::kPriced},
      {"forbidden", PlantedSingletons::kForbidden}};
  parser->add_option("--singletons", options->singletons, "free, priced or forbidden")
      ->transform(CLI::CheckedTransformer(kKinds))
      ->default_str("free");
  return finish(parser, options->seed, [options] { return generate_planted(*options); });
}

Family declare_gadgets(CLI::App& parent) {
  const auto options = std::make_shared<GadgetsOptions>();
  CLI::App* parser = add_family(parent,
                                "gadgets",
                                "optimum known, with an integrality gap",
                                "nda generate gadgets --gadgets 1000 -o gadgets.nda");
  add(parser, "--dimensions", options->dimensions, "N");
  add(parser, "--gadgets", options->gadgets, "number of components");
  add(parser, "--size", options->size, "M_k of a gadget");
  add(parser, "--arcs-per-gadget", options->arcs_per_gadget, "draws of arcs in a gadget");
  add(parser, "--max-cost", options->max_cost, "costs are in -max-cost..-1");
  return finish(parser, options->seed, [options] { return generate_gadgets(*options); });
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

  template <typename T>
  void add(CLI::App* parser, const char* flag, T TrackingOptions::*field, const char* help) {
    const CLI::Option* option = add_option(parser, flag, given.*field, help);
    overrides.push_back([this, option, field](TrackingOptions& options) {
      if (option->count() > 0) options.*field = given.*field;
    });
  }
};

void add_scenario_options(CLI::App* parser, TrackingArguments& arguments) {
  arguments.add(parser, "--scans", &TrackingOptions::scans, "N");
  arguments.add(parser, "--targets", &TrackingOptions::targets, "number of targets");
  arguments.add(parser, "--side", &TrackingOptions::side, "side of the square");
  arguments.add(parser, "--clutter", &TrackingOptions::clutter, "false alarms per scan, expected");
  arguments.add(parser,
                "--detection-probability",
                &TrackingOptions::detection_probability,
                "of a target in a scan");
  arguments.add(parser, "--noise", &TrackingOptions::noise, "sigma of a coordinate");
  arguments.add(parser, "--max-speed", &TrackingOptions::max_speed, "per scan");
  arguments.add(parser, "--process-noise", &TrackingOptions::process_noise, "q of the filter");
  arguments.add(parser, "--gate-probability", &TrackingOptions::gate_probability, "of a gate");
  arguments.add(parser, "--max-misses", &TrackingOptions::max_misses, "in a row");
  arguments.add(
      parser, "--cap", &TrackingOptions::cap, "hypotheses per starting detection; 0 = all");
  arguments.add(
      parser, "--group-size", &TrackingOptions::group_size, "targets per group; 0 = none");
  arguments.add(parser, "--group-spread", &TrackingOptions::group_spread, "sigma within a group");
  arguments.add(parser, "--velocity-spread", &TrackingOptions::velocity_spread, "sigma in a group");
}

Family declare_tracking(CLI::App& parent,
                        const char* name,
                        const char* summary,
                        const char* preset,
                        const char* example) {
  const auto arguments = std::make_shared<TrackingArguments>();
  arguments->preset = preset;
  CLI::App* parser = add_family(parent, name, summary, example);
  add(parser,
      "--preset",
      arguments->preset,
      "small, medium, large, largesparse, huge, hard6, hard7, hard8, largegroup, six-scan; "
      "what is given besides overrides it");
  add_scenario_options(parser, *arguments);
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
  parser.require_subcommand(1);
  parser.footer(
      "docs/families.md defines the families.  The same options give the same file everywhere.\n"
      "\n"
      "Example: 20 targets in 5 scans\n"
      "  nda generate tracking --scans 5 --targets 20 --seed 3 -o window.nda");
  const std::vector<Family> families = {
      declare_poore_sparse(parser),
      declare_poore_dense(parser),
      declare_tracking(parser,
                       "tracking",
                       "targets, noise, misses and clutter",
                       "small",
                       "nda generate tracking --preset medium --seed 2 -o medium.nda.gz"),
      declare_tracking(parser,
                       "groups",
                       "the same with targets in tight groups",
                       "hard6",
                       "nda generate groups --preset hard8 --seed 1 -o hard8.nda.gz"),
      declare_tracking(parser,
                       "six-scan",
                       "one hard problem of six scans",
                       "six-scan",
                       "nda generate six-scan --seed 1 -o six.nda.gz"),
      declare_map3(parser),
      declare_planted(parser),
      declare_gadgets(parser),
  };
  return [families] {
    for (const Family& family : families) {
      if (family.parser->parsed()) return write(family);
    }
    throw InputError("no family given");
  };
}

}  // namespace nda::cli
