#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <string>

#include "cli/commands.hpp"
#include "nda/check.hpp"
#include "nda/io.hpp"

namespace nda::cli {
namespace {

struct CheckArguments {
  std::string problem;
  std::string solution;
};

const char* yes_no(bool value) {
  return value ? "yes" : "no";
}

int check_files(const CheckArguments& arguments) {
  const Problem problem = read_problem(arguments.problem);
  const CheckReport report = check(problem, read_solution(arguments.solution));
  std::cout << std::setprecision(std::numeric_limits<double>::max_digits10)
            << "feasible            " << yes_no(report.feasible) << '\n'
            << "cost right          " << yes_no(report.cost_right) << '\n'
            << "bound right         " << yes_no(report.bound_right) << '\n'
            << "cost                " << report.cost << '\n'
            << "certificate bound   " << report.certificate_bound << '\n';
  if (report.bound_by_branching) {
    std::cout << "The bound exceeds its certificate: it rests on branching.\n";
  }
  for (const std::string& fault : report.faults) std::cout << "fault: " << fault << '\n';
  std::cout << (report.passed() ? "passed\n" : "FAILED\n");
  return report.passed() ? kAnswer : kNoAnswer;
}

}  // namespace

Action declare_check(CLI::App& parser) {
  const auto arguments = std::make_shared<CheckArguments>();
  parser.add_option("file", arguments->problem, "problem, '-' for standard input")->required();
  parser.add_option("solution", arguments->solution, "solution (JSON) to be checked")->required();
  parser.footer(
      "Recomputes everything with code of its own: is the solution feasible, is its cost right, "
      "do\n"
      "the multipliers prove the bound?  Exit code 0 when all is right, 1 otherwise.\n"
      "\n"
      "Example:\n"
      "  nda solve window.nda --output window.json\n"
      "  nda check window.nda window.json");
  return [arguments] { return check_files(*arguments); };
}

}  // namespace nda::cli
