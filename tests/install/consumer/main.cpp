#include "nda/nda.hpp"

int main() {
  nda::ProblemBuilder builder({2, 2, 2});
  builder.add_arc({1, 1, 1}, -5.0);
  const nda::Problem problem = std::move(builder).build();
  const nda::Solution solution = nda::solve(problem);
  return solution.proven && solution.cost == -5.0 ? 0 : 1;
}
