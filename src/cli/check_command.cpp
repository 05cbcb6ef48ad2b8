#include <iomanip>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "cli/print.hpp"
#include "core/clock.hpp"
#include "nda/check.hpp"
#include "nda/io.hpp"

namespace nda::cli {
namespace {

struct CheckArguments {
  std::string problem;
  std::string solution;
  std::string proof;
};

const char* yes_no(bool value) {
  return value ? "yes" : "no";
}

// Of what only a solution has.
const char* verdict(const Solution& solution, bool right) {
  return solution.solutions.empty() ? "no solution" : yes_no(right);
}

const char* bound_verdict(const Solution& solution, const CheckReport& report) {
  if (!report.bound_by_branching) return yes_no(report.bound_right);
  return solution.status == Status::kInfeasible
             ? "infeasible by branching: not checkable"
             : "by branching: not checkable without a whole proof";
}

int check_files(const CheckArguments& arguments) {
  const Problem problem = read_problem(arguments.problem);
  const Solution solution = read_solution(arguments.solution);
  const std::optional<Proof> proof =
      arguments.proof.empty() ? std::nullopt : std::optional(read_proof(arguments.proof));
  const core::Stopwatch checking;
  const CheckReport report = proof ? check(problem, solution, *proof) : check(problem, solution);
  const double seconds = checking.seconds();
  std::cout << std::setprecision(std::numeric_limits<double>::max_digits10)
            << "feasible            " << verdict(solution, report.feasible) << '\n'
            << "cost right          " << verdict(solution, report.cost_right) << '\n'
            << "bound right         " << bound_verdict(solution, report) << '\n'
            << (solution.marginals
                    ? std::string("marginals right     ") + yes_no(report.marginals_right) + "\n"
                    : "")
            << "cost                " << report.cost << '\n'
            << "certificate bound   " << report.certificate_bound << '\n';
  if (proof) std::cout << "proof's bound       " << report.proof_bound << '\n';
  print("time                %.6f s checking, without reading\n", seconds);
  for (const std::string& fault : report.faults) std::cout << "fault: " << fault << '\n';
  std::cout << (report.passed() ? "passed\n" : "FAILED\n");
  return report.passed() ? kAnswer : kNoAnswer;
}

}  // namespace

Action declare_check(CLI::App& parser) {
  const auto arguments = std::make_shared<CheckArguments>();
  parser.add_option("file", arguments->problem, "problem, '-' for standard input")->required();
  parser.add_option("solution", arguments->solution, "solution (JSON) to be checked")->required();
  parser.add_option("--proof", arguments->proof, "the proof that solve --proof wrote")
      ->check(file_name());
  parser.footer(
      "Recomputes everything with code of its own: is the solution feasible, is its cost right, "
      "do\n"
      "the multipliers prove the bound?  What branching adds to the bound takes a proof.\n"
      "Exit code 0 when nothing is wrong, 1 otherwise.\n"
      "\n"
      "Example:\n"
      "  nda solve window.nda --output window.json --proof window.proof.gz\n"
      "  nda check window.nda window.json --proof window.proof.gz");
  return [arguments] { return check_files(*arguments); };
}

}  // namespace nda::cli
