#include <memory>
#include <string>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "nda/io.hpp"

namespace nda::cli {
namespace {

struct ConvertArguments {
  std::string input;
  std::string output;
  std::string from = "auto";
  std::string to = "auto";
};

int convert(const ConvertArguments& arguments) {
  ReadOptions read_options;
  read_options.format = file_format(arguments.from);
  WriteOptions write_options;
  write_options.format = file_format(arguments.to);
  if (write_options.format == FileFormat::kAuto) {
    write_options.format = format_of(arguments.output);
  }
  require_other_file(arguments.output, arguments.input);
  write_problem(read_problem(arguments.input, read_options), arguments.output, write_options);
  return kAnswer;
}

}  // namespace

Action declare_convert(CLI::App& parser) {
  const auto arguments = std::make_shared<ConvertArguments>();
  parser.add_option("input", arguments->input, "file to read, '-' for standard input")->required();
  parser.add_option("output", arguments->output, "file to write, '-' for standard output")
      ->required();
  parser.add_option("--from", arguments->from, "format of the input: nda, dense, csv")
      ->capture_default_str();
  parser.add_option("--to", arguments->to, "format of the output: nda, csv, lp, mps")
      ->capture_default_str();
  parser.footer(
      "Formats follow from the names (.nda, .csv, .dense, .txt, .lp, .mps; '-' is nda) unless "
      "given.\n"
      "Gzip is recognised when reading and used when the name of the output ends in .gz.\n"
      "\n"
      "Example: solve with another program, here CBC\n"
      "  nda convert window.nda.gz window.lp\n"
      "  cbc window.lp solve printingOptions all solution stdout");
  return [arguments] { return convert(*arguments); };
}

}  // namespace nda::cli
