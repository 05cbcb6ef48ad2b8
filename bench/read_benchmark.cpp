#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "nda/io.hpp"

// Reads one problem in several forms and compares with copying the same file to memory.
//
//   read_benchmark [ARCS [DIMENSIONS [FOLDER]]]     default 10000000 5 and the folder for temporary
//   files
//
// Costs have four decimals in the forms called "short" and all their digits otherwise; arcs are in
// lexicographic order unless shuffled.  Every measurement runs in a process of its own, so that its
// peak memory is its own; the best of three counts.  Seconds are processor time (user and system),
// which a busy machine disturbs least.  Files stay in the page cache.

namespace nda {
namespace {

using Tuple = std::vector<Index>;

struct Form {
  const char* name;
  const char* file;
  bool short_costs;
  bool shuffled;
};

constexpr Form kForms[] = {
    {"nda, short costs", "short.nda", true, false},
    {"nda, 17 digits", "long.nda", false, false},
    {"nda, shuffled", "shuffled.nda", true, true},
    {"csv, short costs", "short.csv", true, false},
    {"nda.gz, short costs", "short.nda.gz", true, false},
};

// The arcs of a sparse tracking-like problem: as many indices as a tenth of the arcs, spread over
// the dimensions; an arc joins neighbours.
class ArcStream {
 public:
  ArcStream(std::uint64_t num_arcs, int num_dimensions)
      : size_(static_cast<Index>(num_arcs / 10 / static_cast<std::uint64_t>(num_dimensions) + 20)),
        num_arcs_(num_arcs),
        tuple_(static_cast<std::size_t>(num_dimensions)) {}

  Index size() const { return size_; }

  const Tuple& tuple(std::uint64_t a) {
    tuple_[0] = static_cast<Index>(1 + a * (size_ - 10) / num_arcs_);
    for (std::size_t k = 1; k < tuple_.size(); ++k) {
      tuple_[k] = tuple_[0] + static_cast<Index>(random_.below(10));
    }
    return tuple_;
  }
  double cost(bool is_short) {
    const double cost = random_.uniform(-100, 10);
    return is_short ? std::round(cost * 1e4) / 1e4 : cost;
  }

 private:
  Index size_;
  std::uint64_t num_arcs_;
  Tuple tuple_;
  core::Random random_{1};
};

Problem make_problem(std::uint64_t num_arcs, int num_dimensions, bool short_costs) {
  ArcStream stream(num_arcs, num_dimensions);
  ProblemBuilder builder(Tuple(static_cast<std::size_t>(num_dimensions), stream.size()));
  builder.reserve(num_arcs);
  for (std::uint64_t a = 0; a < num_arcs; ++a) {
    builder.add_arc(stream.tuple(a), stream.cost(short_costs));
  }
  return std::move(builder).build();
}

// Rewrites an arc file with its arc lines in random order.
void shuffle_lines(const std::string& from, const std::string& to) {
  std::vector<std::string> lines;
  std::FILE* input = std::fopen(from.c_str(), "r");
  char line[4096];
  while (std::fgets(line, sizeof line, input) != nullptr) lines.emplace_back(line);
  std::fclose(input);
  std::shuffle(lines.begin() + 1, lines.end(), core::Random(2));
  std::FILE* output = std::fopen(to.c_str(), "w");
  for (const std::string& text : lines) std::fputs(text.c_str(), output);
  std::fclose(output);
}

struct Measurement {
  double seconds = 0;
  double peak_bytes = 0;
  std::uint64_t num_arcs = 0;
};

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

// Runs an action that returns a number of arcs in a child process.
Measurement measure(const std::function<std::uint64_t()>& action) {
  Measurement result;
  int channel[2];
  if (::pipe(channel) != 0) std::abort();
  const pid_t child = ::fork();
  if (child == 0) {
    result.num_arcs = action();
    rusage usage = {};
    ::getrusage(RUSAGE_SELF, &usage);
    result.seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    result.peak_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
    const bool written = ::write(channel[1], &result, sizeof result) == sizeof result;
    ::_exit(written ? 0 : 1);
  }
  ::close(channel[1]);
  if (::read(channel[0], &result, sizeof result) != sizeof result) std::abort();
  ::close(channel[0]);
  ::waitpid(child, nullptr, 0);
  return result;
}

Measurement best_of_three(const std::function<std::uint64_t()>& action) {
  Measurement best = measure(action);
  for (int repeat = 0; repeat < 2; ++repeat) {
    const Measurement next = measure(action);
    if (next.seconds < best.seconds) best = next;
  }
  return best;
}

// What cat to memory costs: the file read in blocks of 256 KiB.
std::uint64_t copy_to_memory(const std::string& path) {
  std::vector<char> block(std::size_t{1} << 18);
  std::FILE* file = std::fopen(path.c_str(), "r");
  std::setvbuf(file, nullptr, _IONBF, 0);
  while (std::fread(block.data(), 1, block.size(), file) > 0) {
  }
  std::fclose(file);
  return 0;
}

void report(const Form& form, const std::string& path) {
  const double megabytes = static_cast<double>(std::filesystem::file_size(path)) / 1e6;
  const Measurement raw = best_of_three([&] { return copy_to_memory(path); });
  const Measurement idle = measure([] { return std::uint64_t{0}; });
  const Measurement read = best_of_three([&] { return read_problem(path).num_arcs(); });
  const auto arcs = static_cast<double>(read.num_arcs);
  std::printf("%-20s %8.1f %9.3f %9.0f %8.2f %9.0f %9.1f\n",
              form.name,
              megabytes,
              read.seconds,
              megabytes / read.seconds,
              arcs / read.seconds / 1e6,
              megabytes / raw.seconds,
              (read.peak_bytes - idle.peak_bytes) / arcs);
  std::fflush(stdout);
}

void prepare(const Form& form,
             const std::string& folder,
             std::uint64_t num_arcs,
             int num_dimensions) {
  if (form.shuffled) {
    shuffle_lines(folder + "/short.nda", folder + "/" + form.file);
  } else {
    write_problem(make_problem(num_arcs, num_dimensions, form.short_costs),
                  folder + "/" + form.file);
  }
}

int benchmark(int argc, char** argv) {
  const std::uint64_t num_arcs = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 10000000;
  const int num_dimensions = argc > 2 ? std::atoi(argv[2]) : 5;
  const std::filesystem::path parent =
      argc > 3 ? std::filesystem::path(argv[3]) : std::filesystem::temp_directory_path();
  const std::string folder = parent / ("read_benchmark-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::printf("%-20s %8s %9s %9s %8s %9s %9s\n",
              "form",
              "MB",
              "seconds",
              "MB/s",
              "Marcs/s",
              "cat MB/s",
              "bytes/arc");
  for (const Form& form : kForms) {
    // In a child, so that the memory of making the file does not count as that of reading it.
    measure([&] {
      prepare(form, folder, num_arcs, num_dimensions);
      return std::uint64_t{0};
    });
    report(form, folder + "/" + form.file);
  }
  std::filesystem::remove_all(folder);
  return 0;
}

}  // namespace
}  // namespace nda

int main(int argc, char** argv) {
  return nda::benchmark(argc, argv);
}
