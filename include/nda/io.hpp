#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "nda/problem.hpp"
#include "nda/proof.hpp"
#include "nda/solution.hpp"
#include "nda/warm_start.hpp"

// Files: problems in, problems and solutions out.  The formats are described in
// docs/file_formats.md.
//
// Every function here throws InputError, and nothing else but std::bad_alloc, for a file that is
// malformed, missing or cannot be written.  The message names the file (for the functions that take
// a path), the line and the value: "scan.nda: line 12: index 9 of dimension 2 exceeds 7".

namespace nda {

/// A file format.  All are read and written plain or gzip-compressed; LP and MPS are write-only,
/// dense is read-only.
enum class FileFormat {
  kAuto,   ///< by the file's suffix, see format_of()
  kNda,    ///< the project's own text format
  kDense,  ///< `N s` and s^N costs, last index fastest; a perfect assignment
  kCsv,    ///< header row `i1,...,iN,cost`; M_k is the largest index seen; no bounds on uses
  kLp,     ///< CPLEX LP: set partitioning with singletons as columns
  kMps,    ///< free MPS: the same model
};

/// "auto", "nda", "dense", "csv", "lp", "mps".
const char* to_string(FileFormat format);

/// The inverse of to_string; throws InputError for another name.
FileFormat file_format(const std::string& name);

/// The format of a path by its suffix: .nda, .csv, .lp, .mps, .dense or .txt (dense), each also
/// with .gz behind it; "-" is kNda.  Throws InputError for another suffix.
FileFormat format_of(const std::string& path);

/// How to read a problem.
struct ReadOptions {
  FileFormat format = FileFormat::kAuto;

  /// A file may declare this many indices (sum of M_k) and one more for each of its bytes; an index
  /// costs 8 bytes of memory, 16 in dimensions with bounds on uses.  Indices that no arc uses are
  /// thus limited, used ones are not.
  std::size_t spare_indices = std::size_t{1} << 24;
};

/// How to write a problem.
struct WriteOptions {
  FileFormat format = FileFormat::kAuto;

  /// Written first, one `c` line each, so without line breaks; kNda only, the others leave them
  /// out.
  std::vector<std::string> comments = {};
};

/// Reads a problem from a file, or from standard input when `path` is "-".  Gzip compression is
/// detected by content.  One pass, O(file size).  Memory: the problem itself, up to 16 bytes an arc
/// more while unsorted arcs are being sorted, and 1 MiB.
Problem read_problem(const std::string& path, const ReadOptions& options = {});

/// The same from a stream; kAuto means kNda.  Messages start at "line".
Problem read_problem(std::istream& input, const ReadOptions& options = {});

/// The same from memory; kAuto means kNda.  Messages start at "line".
Problem parse_problem(std::string_view bytes, const ReadOptions& options = {});

/// Writes a problem to a file, compressed when the path ends in .gz, or to standard output when
/// `path` is "-".  The file appears under its name only when it is complete; devices and pipes are
/// written directly.  Costs are written so that reading restores every bit.  Throws InputError for
/// a problem that was moved from, and where the format cannot hold its bounds on uses.
void write_problem(const Problem& problem,
                   const std::string& path,
                   const WriteOptions& options = {});

/// The same to a stream, never compressed; kAuto means kNda.
void write_problem(const Problem& problem, std::ostream& output, const WriteOptions& options = {});

/// Writes a solution as JSON ("format": "nda-solution", "version": 1); as write_problem for paths.
void write_solution(const Solution& solution, const std::string& path);

/// The same text, indented, with a newline at the end.
std::string solution_to_json(const Solution& solution);

/// Reads a solution, plain or gzip-compressed, from a file or from standard input ("-").  Every
/// field of version 1 must be present with its type, and both gaps must be those of cost and bound;
/// the message names the faulty one.  That the other values are right is for check() to say.
Solution read_solution(const std::string& path);

/// The same from text.
Solution solution_from_json(std::string_view text);

/// Writes a warm start as JSON ("format": "nda-warm-start", "version": 1); as write_problem for
/// paths. Throws InputError where a multiplier is not finite.
void write_warm_start(const WarmStart& warm_start, const std::string& path);

/// The same text: a line for every dimension and every tuple.
std::string warm_start_to_json(const WarmStart& warm_start);

/// Reads a warm start, plain or gzip-compressed, from a file or from standard input ("-").  Every
/// field must be there with its type and every multiplier be finite; the message names the faulty
/// one.  Whether it fits a problem is not judged: solve() ignores what does not.
WarmStart read_warm_start(const std::string& path);

/// The same from text.
WarmStart warm_start_from_json(std::string_view text);

/// Writes a proof, see docs/proofs.md; as write_problem for paths.
void write_proof(const Proof& proof, const std::string& path);

/// The same to a stream, never compressed.
void write_proof(const Proof& proof, std::ostream& output);

/// Reads a proof, plain or gzip-compressed, from a file or from standard input ("-").  That it
/// proves anything is for check_proof() to say.  Memory: some times the size of the text.
Proof read_proof(const std::string& path);

/// The same from text.
Proof parse_proof(std::string_view text);

}  // namespace nda
