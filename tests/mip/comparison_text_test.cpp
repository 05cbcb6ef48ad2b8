#include "mip/comparison_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace nda::mip {
namespace {

MethodResult result(const std::string& method,
                    const std::string& status,
                    double cost,
                    double bound,
                    double seconds) {
  MethodResult r;
  r.method = method;
  r.status = status;
  r.proven = status == "optimal";
  r.cost = cost;
  r.bound = bound;
  r.seconds = seconds;
  return r;
}

FileComparison sample() {
  FileComparison comparison;
  comparison.file = "a.nda";
  comparison.sizes = {2, 2, 3};
  comparison.num_arcs = 4;
  comparison.largest_cost = 5;
  comparison.results = {result("default", "optimal", -8, -8.000000001, 0.25),
                        result("greedy", "heuristic", -7, -kInfinity, 0.0001),
                        result("brute-force", "skipped", kInfinity, -kInfinity, 0),
                        result("cbc", "time_limit", -8, -10, 20)};
  comparison.results[2].note = "too large";
  comparison.results[3].kind = MethodKind::kExternal;
  return comparison;
}

TEST(ComparisonText, TableIsAlignedAndMarksTheBest) {
  EXPECT_EQ(comparison_table(sample()),
            R"(a.nda: 3 dimensions, 7 indices, 4 arcs
method            cost    excess %  lower bound      gap %  seconds  status      proven
default      -8.000000 *    0.0000    -8.000000 *   0.0000   0.2500  optimal     yes
greedy       -7.000000     12.5000            -          -   0.0001  heuristic   -
brute-force          -           -            -          -        -  skipped     -       too large
cbc          -8.000000 *    0.0000   -10.000000    25.0000  20.0000  time_limit  -
)");
}

TEST(ComparisonText, SummaryCountsWhatEachMethodDid) {
  FileComparison second = sample();
  second.results[0] = result("default", "time_limit", -8, -9, 1);
  second.results[1].cost = -8;
  second.results[3] = result("cbc", "failed", kInfinity, -kInfinity, 5);
  EXPECT_EQ(summary_table({sample(), second}),
            R"(2 files
method       files  solved  best  proven  mean excess %  worst %  geo-mean s  total s
default          2       2     2       1         0.0000   0.0000      0.5000   1.2500
greedy           2       2     1       0         6.2500  12.5000      0.0001   0.0002
brute-force      0       0     0       0              -        -           -        -
cbc              2       1     1       0         0.0000   0.0000     10.0000  25.0000
)");
}

TEST(ComparisonText, CsvHasAllDigitsAndQuotesWhatItMust) {
  FileComparison comparison = sample();
  comparison.file = "a,\"b\".nda";
  comparison.results.resize(3);
  comparison.results[1].cost = 0.1;
  EXPECT_EQ(csv_header() + csv_rows(comparison, 20),
            "file,dimensions,indices,arcs,method,kind,status,proven,cost,lower_bound,relative_gap,"
            "seconds,time_limit,note\n"
            "\"a,\"\"b\"\".nda\",3,7,4,default,nda,optimal,yes,-8,-8.0000000010000001,"
            "1.2500001034254637e-10,0.25,20,\n"
            "\"a,\"\"b\"\".nda\",3,7,4,greedy,nda,heuristic,no,0.10000000000000001,,,0.0001,20,\n"
            "\"a,\"\"b\"\".nda\",3,7,4,brute-force,nda,skipped,no,,,,0,20,too large\n");
}

TEST(ComparisonText, TinyCostsAreWrittenWithExponents) {
  FileComparison comparison = sample();
  comparison.largest_cost = 1e-9;
  comparison.results = {result("default", "optimal", -1.25e-9, -1.25e-9, 0)};
  EXPECT_THAT(comparison_table(comparison), ::testing::HasSubstr("-1.250000000e-09 *"));
}

TEST(ComparisonText, HugeCostsHaveNoDecimals) {
  FileComparison comparison = sample();
  comparison.results = {result("default", "optimal", 123456789012.0, 123456789012.0, 0)};
  EXPECT_THAT(comparison_table(comparison), ::testing::HasSubstr(" 123456789012 *"));
}

}  // namespace
}  // namespace nda::mip
