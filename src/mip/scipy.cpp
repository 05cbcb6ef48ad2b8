#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "io/sink.hpp"
#include "mip/external_solver.hpp"
#include "mip/process.hpp"
#include "mip/solver_text.hpp"
#include "mip/temporary_folder.hpp"

// HiGHS (Huangfu & Hall) inside SciPy 1.9 or later, called by a few lines of Python.
//
// Model file, in the machine's own byte order: 64-bit numbers of rows, columns, entries; 64-bit
// starts of the columns (one more than columns) and row numbers of the entries; then as doubles
// costs and upper bounds of the columns, lower and upper bounds of the rows.  Rows are the indices,
// dimension by dimension; all entries are 1.  The program answers with lines "status N", "bound X",
// "objective X" (where known) and "column J VALUE" for each column that is not 0.
//
// SciPy hands options it does not know to HiGHS, with a warning: that is how the number of threads
// gets there.  Its time limit begins after Python has started and read the model.

namespace nda::mip {
namespace {

constexpr const char* kMatrixFile = "model.bin";
constexpr double kProbeLimit_s = 60;

// Asking for the version spares the second that importing SciPy takes.
constexpr const char* kProbe = R"(
import importlib.metadata
version = importlib.metadata.version('scipy').split('.')
assert (int(version[0]), int(version[1])) >= (1, 9)
)";

constexpr const char* kProgram = R"(
import os, sys, warnings
os.environ['OMP_NUM_THREADS'] = os.environ['OPENBLAS_NUM_THREADS'] = '1'
import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import csc_matrix
warnings.simplefilter('ignore')
with open(sys.argv[1], 'rb') as file:
    rows, columns, entries = (int(n) for n in np.fromfile(file, np.int64, 3))
    starts = np.fromfile(file, np.int64, columns + 1)
    indices = np.fromfile(file, np.int64, entries)
    costs, most = (np.fromfile(file, np.float64, columns) for _ in range(2))
    lower, upper = (np.fromfile(file, np.float64, rows) for _ in range(2))
matrix = csc_matrix((np.ones(entries), indices, starts), shape=(rows, columns))
options = {'mip_rel_gap': 0.0, 'mip_abs_gap': 1e-9, 'threads': 1, 'parallel': 'off'}
if len(sys.argv) > 3:
    options['time_limit'] = float(sys.argv[3])
result = milp(costs, integrality=np.ones(columns), bounds=Bounds(0, most),
              constraints=LinearConstraint(matrix, lower, upper), options=options)
with open(sys.argv[2], 'w') as file:
    print('status', result.status, file=file)
    if result.mip_dual_bound is not None:
        print('bound', repr(float(result.mip_dual_bound)), file=file)
    if result.x is not None:
        print('objective', repr(float(result.fun)), file=file)
        for column in np.flatnonzero(result.x):
            print('column', column, repr(float(result.x[column])), file=file)
)";

// The matrix by columns: arcs, then singletons that are not forbidden.
struct Matrix {
  explicit Matrix(const Problem& problem) : starts{0} {
    std::vector<std::int64_t> first_row;
    for (const Index size : problem.sizes()) {
      first_row.push_back(rows);
      rows += size;
    }
    for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
      for (int k = 0; k < problem.num_dimensions(); ++k) {
        const Index i = problem.indices(k)[a];
        if (i != 0) indices.push_back(first_row[static_cast<std::size_t>(k)] + i - 1);
      }
      end_column(problem.costs()[a], 1);
    }
    for (int k = 0; k < problem.num_dimensions(); ++k) {
      for (Index i = 1; i <= problem.size(k); ++i) {
        const UseBounds bounds = problem.use_bounds(k, i);
        const double hi = bounds.hi == UseBounds::kUnlimited ? kInfinity : bounds.hi;
        lower.push_back(bounds.lo);
        upper.push_back(hi);
        if (problem.singleton_costs(k)[i] == kInfinity) continue;
        indices.push_back(first_row[static_cast<std::size_t>(k)] + i - 1);
        end_column(problem.singleton_costs(k)[i], hi);
      }
    }
  }

  void end_column(double cost, double hi) {
    costs.push_back(cost);
    most.push_back(hi);
    starts.push_back(static_cast<std::int64_t>(indices.size()));
  }

  std::int64_t rows = 0;
  std::vector<std::int64_t> starts;
  std::vector<std::int64_t> indices;
  std::vector<double> costs;
  std::vector<double> most;   // by column
  std::vector<double> lower;  // by row
  std::vector<double> upper;  // by row
};

template <typename T>
void write_bytes(io::Sink& sink, const std::vector<T>& values) {
  sink.write({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

ExternalStatus status_of(const std::string& word) {
  if (word == "0") return ExternalStatus::kOptimal;
  if (word == "1") return ExternalStatus::kTimeLimit;
  if (word == "2") return ExternalStatus::kInfeasible;
  return ExternalStatus::kFailed;
}

class Scipy : public ExternalSolver {
 public:
  Scipy(std::string python, const Surroundings& surroundings)
      : ExternalSolver(surroundings.temporary_folder), python_(std::move(python)) {}

 private:
  void write_model(const Problem& problem, const std::string& folder) const override {
    const Matrix matrix(problem);
    const auto sink = io::file_sink(folder + "/" + kMatrixFile);
    write_bytes(*sink,
                std::vector<std::int64_t>{matrix.rows,
                                          static_cast<std::int64_t>(matrix.costs.size()),
                                          static_cast<std::int64_t>(matrix.indices.size())});
    write_bytes(*sink, matrix.starts);
    write_bytes(*sink, matrix.indices);
    for (const std::vector<double>& values :
         {matrix.costs, matrix.most, matrix.lower, matrix.upper})
      write_bytes(*sink, values);
    sink->commit();
  }

  std::vector<std::string> command(double time_limit_s) const override {
    std::vector<std::string> words = {python_, "-c", kProgram, kMatrixFile, kSolutionFile};
    if (time_limit_s < kInfinity) words.push_back(std::to_string(time_limit_s));
    return words;
  }

  RawAnswer read_answer(const std::string& folder) const override {
    RawAnswer raw;
    for (const std::string& line : read_lines(folder + "/" + kSolutionFile)) {
      const std::vector<std::string> words = words_of(line);
      if (words.size() < 2) continue;
      const std::string& value = words[1];
      if (words[0] == "status") raw.status = status_of(value);
      if (words[0] == "bound") raw.bound = number_in(value).value_or(-kInfinity);
      if (words[0] == "objective") {
        raw.has_solution = true;
        raw.objective = number_in(value).value_or(kInfinity);
      }
      if (words[0] == "column" && words.size() == 3) {
        if (const auto column = count_in(value)) {
          raw.take(*column, number_in(words[2]).value_or(0.5));
        }
      }
    }
    return raw;
  }

  std::string python_;
};

bool has_scipy(const std::string& python, const Surroundings& surroundings) {
  const TemporaryFolder folder(surroundings.temporary_folder);
  const ProcessResult run =
      run_process({python, "-c", kProbe}, folder.path(), "log", kProbeLimit_s);
  return run.ending == Ending::kExited && run.exit_code == 0;
}

}  // namespace

// Debian's SciPy belongs to /usr/bin/python3, which need not be the first python3 on the path.
std::unique_ptr<ExternalSolver> find_scipy(const Surroundings& surroundings) {
  const std::string path = surroundings.search_path + ":/usr/bin";
  for (const std::string& python : find_programs("python3", path)) {
    if (has_scipy(python, surroundings)) return std::make_unique<Scipy>(python, surroundings);
  }
  return nullptr;
}

}  // namespace nda::mip
