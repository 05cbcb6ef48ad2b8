#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/io_support.hpp"
#include "nda/io.hpp"

namespace nda::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Two solutions, one infinite bound, and doubles that need all their digits.
Solution example() {
  Solution solution;
  solution.sizes = {2, 1, 3};
  solution.num_arcs = 7;
  solution.num_components = 2;
  solution.status = Status::kTimeLimit;
  solution.proven = false;
  solution.cost = -0.1 - 0.2;
  solution.lower_bound = -1.0 / 3;
  solution.solutions = {{1, -0.1 - 0.2, false, {{1, 1, 2}, {2, 0, 3}}}, {2, 1e-300, true, {}}};
  solution.multipliers = {{0.1, -2}, {1e300}, {0, 5e-324, 3}};
  solution.components = {{4, 3, Status::kOptimal, true, -1, -1, "enumeration"},
                         {3, 2, Status::kNodeLimit, false, 2, -kInfinity, "branch and bound"}};
  solution.stats.read_seconds = 0.25;
  solution.stats.solve_seconds = 1.5;
  solution.stats.peak_memory_bytes = 12345678901;
  solution.stats.dual_evaluations = 60;
  solution.stats.recoveries = 6;
  solution.stats.nodes = 8;
  solution.stats.arcs_after_shift = 5;
  solution.stats.arcs_after_fixing = 4;
  solution.stats.arcs_left = 3;
  solution.stats.tried_components = 2;
  solution.stats.settled_components = 1;
  solution.stats.reductions = {1, 9, 2, 3, 4, 5, 6, 7, 8, 10, 0};
  solution.stats.forgotten_reductions = {1, 19, 12, 13, 14, 15, 16, 17, 18, 20, 11};
  solution.stats.exchange = {30, 21, 22, 23};
  solution.stats.branching = {24, 25, 26, 27};
  solution.stats.searches = {34, 35, 36, 37};
  solution.stats.certificate_bound = -0.5;
  solution.stats.bound_by_branching = true;
  solution.reason = "a \"quoted\" reason\n\xc3\xa9";
  return solution;
}

TEST(SolutionJson, HasOneLinePerFieldAndElement) {
  EXPECT_EQ(solution_to_json(example()),
            R"json({
  "format": "nda-solution",
  "version": 1,
  "instance": {"dimensions":3,"sizes":[2,1,3],"arcs":7,"components":2},
  "status": "time_limit",
  "proven": false,
  "reason": "a \"quoted\" reason\né",
  "cost": -0.30000000000000004,
  "lower_bound": -0.3333333333333333,
  "gap": 0.03333333333333327,
  "relative_gap": 0.11111111111111088,
  "solutions": [
    {"rank":1,"cost":-0.30000000000000004,"proven":false,"arcs":[[1,1,2],[2,0,3]]},
    {"rank":2,"cost":1e-300,"proven":true,"arcs":[]}
  ],
  "multipliers": [
    [0.1,-2.0],
    [1e+300],
    [0.0,5e-324,3.0]
  ],
  "cuts": [],
  "components": [
    {"arcs":4,"indices":3,"status":"optimal","proven":true,"cost":-1.0,"lower_bound":-1.0,"method":"enumeration"},
    {"arcs":3,"indices":2,"status":"node_limit","proven":false,"cost":2.0,"lower_bound":"-inf","method":"branch and bound"}
  ],
  "stats": {"read_seconds":0.25,"solve_seconds":1.5,"peak_memory_bytes":12345678901,"dual_evaluations":60,"recoveries":6,"nodes":8,"arcs_after_shift":5,"arcs_after_fixing":4,"arcs_left":3,"tried_components":2,"settled_components":1,"reductions":{"components":1,"arcs":9,"outweighing":2,"excluded":3,"redundant":4,"single":5,"unprofitable":6,"dominated":7,"sides":8,"side_arcs":10,"left":0},"forgotten_reductions":{"components":1,"arcs":19,"outweighing":12,"excluded":13,"redundant":14,"single":15,"unprofitable":16,"dominated":17,"sides":18,"side_arcs":20,"left":11},"exchange":{"arcs":30,"kept":21,"excluded":22,"rounds":23},"branching":{"dropped":24,"taken":25,"splits":26,"parts":27},"searches":{"dropped":34,"taken":35,"splits":36,"parts":37},"certificate_bound":-0.5,"bound_by_branching":true}
}
)json");
}

TEST(SolutionJson, RestoresEveryField) {
  const Solution expected = example();
  const Solution actual = solution_from_json(solution_to_json(expected));
  EXPECT_EQ(actual.sizes, expected.sizes);
  EXPECT_EQ(actual.num_arcs, expected.num_arcs);
  EXPECT_EQ(actual.num_components, expected.num_components);
  EXPECT_EQ(actual.status, expected.status);
  EXPECT_EQ(actual.cost, expected.cost);
  EXPECT_EQ(actual.lower_bound, expected.lower_bound);
  EXPECT_EQ(actual.multipliers, expected.multipliers);
  EXPECT_EQ(actual.reason, expected.reason);
  ASSERT_EQ(actual.solutions.size(), 2u);
  EXPECT_EQ(actual.solutions[0].arcs, expected.solutions[0].arcs);
  EXPECT_EQ(actual.solutions[1].cost, 1e-300);
  EXPECT_EQ(actual.components[1].method, "branch and bound");
  EXPECT_EQ(actual.components[1].lower_bound, -kInfinity);
  EXPECT_EQ(actual.stats.peak_memory_bytes, 12345678901u);
  // What is left is compared through the text, which holds all fields.
  EXPECT_EQ(solution_to_json(actual), solution_to_json(expected));
}

// As files of before do.
TEST(SolutionJson, MayLackWhatReductionsAndFixingDid) {
  std::string text = solution_to_json(example());
  const std::size_t begin = text.find("\"arcs_left\"");
  text.erase(begin, text.find("\"certificate_bound\"") - begin);
  const Stats stats = solution_from_json(text).stats;
  EXPECT_EQ(stats.arcs_after_fixing, 4u);
  EXPECT_EQ(stats.certificate_bound, -0.5);
  EXPECT_EQ(stats.reductions.arcs, 0u);
}

TEST(SolutionJson, RestoresEveryStatusAndInfinity) {
  for (int status = 0; status <= static_cast<int>(Status::kPrecisionLost); ++status) {
    Solution solution;
    solution.status = static_cast<Status>(status);
    const Solution actual = solution_from_json(solution_to_json(solution));
    EXPECT_EQ(actual.status, solution.status);
    EXPECT_EQ(actual.cost, kInfinity);
    EXPECT_EQ(actual.lower_bound, -kInfinity);
  }
}

TEST(SolutionJson, IsReadFromFilesPlainAndCompressed) {
  const TemporaryFolder folder;
  for (const char* name : {"a.json", "a.json.gz"}) {
    write_solution(example(), folder / name);
    EXPECT_EQ(solution_to_json(read_solution(folder / name)), solution_to_json(example()));
  }
  write_file(folder / "b.json", "{}");
  EXPECT_EQ(message_of([&] { read_solution(folder / "b.json"); }),
            (folder / "b.json") + ": field 'format' is missing");
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  EXPECT_NE(place, std::string::npos) << from;
  return text.replace(place, from.size(), to);
}

TEST(SolutionJson, NamesTheFaultyField) {
  struct Fault {
    const char* from;
    const char* to;
    const char* message;
  };
  const Fault kFaults[] = {
      {"nda-solution", "nda-problem", "format: expected 'nda-solution', found 'nda-problem'"},
      {"\"version\": 1", "\"version\": 2", "version: version 2 is not supported, only 1"},
      {"\"version\": 1",
       "\"version\": \"1\"",
       "version: expected a whole number up to 9223372036854775807, found '\"1\"'"},
      {"\"dimensions\":3",
       "\"dimensions\":4",
       "instance.dimensions: differs from the number of sizes, 3"},
      {"[2,1,3]",
       "[2,-1,3]",
       "instance.sizes[1]: expected a whole number up to 4294967295, found '-1'"},
      {"[2,1,3]",
       "[2,1.0,3]",
       "instance.sizes[1]: expected a whole number up to 4294967295, found '1.0'"},
      {"[2,1,3]",
       "[2,1,4294967296]",
       "instance.sizes[2]: expected a whole number up to 4294967295, found '4294967296'"},
      {"[2,1,3]", "{}", "instance.sizes: expected an array, found object"},
      {"\"time_limit\"", "\"done\"", "status: unknown status 'done'"},
      {"\"proven\": false", "\"proven\": 0", "proven: expected true or false, found '0'"},
      {"\"cost\": -0.30000000000000004",
       "\"cost\": null",
       "cost: expected a number, \"inf\" or \"-inf\", found 'null'"},
      {"\"gap\": 0",
       "\"gap\": \"nan\", \"x\": 0",
       "gap: expected a number, \"inf\" or \"-inf\", found '\"nan\"'"},
      {"\"gap\"", "\"gap \"", "field 'gap' is missing"},
      {"[2,0,3]",
       "[2,\"x\",3]",
       "solutions[0].arcs[1][1]: expected a whole number up to 4294967295, found '\"x\"'"},
      {"[2,0,3]", "[2,3]", "solutions[0].arcs[1]: has 2 indices, expected 3"},
      {"{\"rank\":2",
       "[{\"rank\":2}],{\"rank\":2",
       "solutions[1]: expected an object, found array"},
      {"[1e+300]", "1e+300", "multipliers[1]: expected an array, found '1e+300'"},
      {"5e-324", "true", "multipliers[2][1]: expected a number, \"inf\" or \"-inf\", found 'true'"},
      {"\"cuts\": []", "\"cuts\": [1]", "cuts: cuts are not supported"},
      {"\"method\":\"enum", "\"way\":\"enum", "components[0]: field 'method' is missing"},
      {"\"nodes\":8",
       "\"nodes\":[]",
       "stats.nodes: expected a whole number up to 9223372036854775807, found array"},
  };
  for (const Fault& fault : kFaults) {
    const std::string text = replaced(solution_to_json(example()), fault.from, fault.to);
    EXPECT_EQ(message_of([&] { solution_from_json(text); }), fault.message);
  }
}

TEST(SolutionJson, NamesGapsThatDoNotFollowFromCostAndBound) {
  Solution solution;
  solution.cost = 30;
  solution.lower_bound = 29.7;
  const std::string text = solution_to_json(solution);
  const auto error = [](const std::string& changed) {
    return message_of([&] { solution_from_json(changed); });
  };
  const auto with_gaps = [&](const std::string& gap, const std::string& relative) {
    std::string changed = text;
    const std::size_t begin = changed.find("\"gap\"");
    const std::size_t end = changed.find("\"solutions\"");
    return changed.replace(
        begin, end - begin, "\"gap\": " + gap + ", \"relative_gap\": " + relative + ", ");
  };
  EXPECT_NO_THROW(solution_from_json(with_gaps("0.3", "0.01")));
  for (const char* wrong : {"0.31", "0", "\"inf\""}) {
    EXPECT_EQ(error(with_gaps(wrong, "0.01")), "gap: does not follow from cost and lower_bound");
    EXPECT_EQ(error(with_gaps("0.3", wrong)),
              "relative_gap: does not follow from cost and lower_bound");
  }
  solution.cost = kInfinity;
  EXPECT_EQ(error(replaced(solution_to_json(solution), "\"gap\": \"inf\"", "\"gap\": 7")),
            "gap: does not follow from cost and lower_bound");
}

TEST(SolutionJson, NamesThePlaceOfASyntaxError) {
  const auto error = [](const std::string& text) {
    return message_of([&] { solution_from_json(text); });
  };
  EXPECT_THAT(error(""), HasSubstr("invalid JSON: parse error at line 1, column 1"));
  EXPECT_THAT(error("{\n\"format\": }"),
              HasSubstr("invalid JSON: parse error at line 2, column 11"));
  EXPECT_THAT(error("{\"cost\": 1e999}"), HasSubstr("invalid JSON: number overflow"));
  EXPECT_THAT(error("\"\xff\x01"), HasSubstr("invalid JSON: parse error at line 1, column 2"));
  EXPECT_LT(error("[\"" + std::string(1000000, 'x')).size(), 300u);
  EXPECT_EQ(error("[]"), "expected an object, found array");
  EXPECT_THAT(error(std::string(1000000, '[')), HasSubstr("invalid JSON: parse error"));
}

Solution with_marginals() {
  Solution solution = example();
  solution.marginals = {2.5,
                        1,
                        {0.75, 0.25},
                        {{{1, 1, 2}, 0.75}, {{2, 0, 3}, 1.0 / 3}},
                        {{0, 1, 2, 2, 0.75}},
                        {{0.25, 1}, {0.25}, {1, 0.25, 1e-300}},
                        {{0, 1, 0.5, {1, 0}}, {2, 3, 0, {1}}}};
  return solution;
}

TEST(SolutionJson, WritesMarginalsWithDimensionsFromOne) {
  const std::string text = solution_to_json(with_marginals());
  EXPECT_EQ(text.substr(text.find(",\n  \"marginals\"")), R"json(,
  "marginals": {
    "cost_per_nat": 2.5,
    "num_proven": 1,
    "weights": [0.75,0.25],
    "arcs": [
      {"arc":[1,1,2],"weight":0.75},
      {"arc":[2,0,3],"weight":0.3333333333333333}
    ],
    "pairs": [
      {"first":[1,1],"second":[3,2],"weight":0.75}
    ],
    "alone": [
      [0.25,1.0],
      [0.25],
      [1.0,0.25,1e-300]
    ],
    "ambiguous": [
      {"dimension":1,"index":1,"entropy":0.5,"arcs":[1,0]},
      {"dimension":3,"index":3,"entropy":0.0,"arcs":[1]}
    ]
  }
}
)json");
  const Solution restored = solution_from_json(text);
  EXPECT_EQ(solution_to_json(restored), text);
  EXPECT_EQ(restored.marginals->pairs[0].second_dimension, 2);
  EXPECT_FALSE(solution_from_json(solution_to_json(example())).marginals);
}

TEST(SolutionJson, NamesTheFaultyFieldOfMarginals) {
  const std::string text = solution_to_json(with_marginals());
  const auto message = [&](const std::string& from, const std::string& to) {
    return message_of([&] { solution_from_json(replaced(text, from, to)); });
  };
  EXPECT_EQ(message("\"first\":[1,1]", "\"first\":[0,1]"),
            "marginals.pairs[0].first[0]: dimensions count from 1");
  EXPECT_EQ(message("\"first\":[1,1]", "\"first\":[4,1]"),
            "marginals.pairs[0].first[0]: expected a whole number up to 3, found '4'");
  EXPECT_EQ(message("\"first\":[1,1]", "\"first\":[1]"),
            "marginals.pairs[0].first: expected a dimension and an index");
  EXPECT_EQ(message("\"dimension\":3", "\"dimension\":0"),
            "marginals.ambiguous[1].dimension: dimensions count from 1");
  EXPECT_EQ(message("{\"arc\":[2,0,3]", "{\"arc\":[2,0]"),
            "marginals.arcs[1].arc: has 2 indices, expected 3");
  EXPECT_EQ(message("\"cost_per_nat\"", "\"unit\""), "marginals: field 'cost_per_nat' is missing");
}

TEST(SolutionJson, ReplacesBytesThatAreNoText) {
  Solution solution;
  solution.reason = "\xff";
  EXPECT_EQ(solution_from_json(solution_to_json(solution)).reason, "\xef\xbf\xbd");
}

}  // namespace
}  // namespace nda::io
