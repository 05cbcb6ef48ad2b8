#include <cstdio>

#include "nda/nda.hpp"

int main() {
  nda::ProblemBuilder builder({2, 2, 1});  // three scans with 2, 2 and 1 detections
  builder.add_arc({1, 1, 1}, -5.0);        // a possible track; the lower, the likelier
  builder.add_arc({1, 2, 1}, -6.0);
  builder.add_arc({2, 2, 0}, -4.0);  // 0: the third scan missed it
  const nda::Problem problem = std::move(builder).build();
  const nda::Solution best = nda::solve(problem);
  std::printf("%s: cost %g, bound %g\n", to_string(best.status), best.cost, best.lower_bound);
  return nda::check(problem, best).passed() ? 0 : 1;
}
