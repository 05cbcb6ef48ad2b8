#include <array>
#include <string>
#include <utility>

#include "io/proof_file.hpp"
#include "io/readers.hpp"
#include "io/sink.hpp"
#include "io/source.hpp"
#include "io/writers.hpp"
#include "nda/io.hpp"

namespace nda {
namespace {

constexpr std::array kFormats = {FileFormat::kAuto,
                                 FileFormat::kNda,
                                 FileFormat::kDense,
                                 FileFormat::kCsv,
                                 FileFormat::kLp,
                                 FileFormat::kMps};

// Runs an action and puts the name of the file before the message of its InputError.
template <typename Action>
auto with_name(const std::string& name, Action action) {
  try {
    return action();
  } catch (const InputError& error) {
    throw InputError(name + ": " + error.what());
  }
}

std::string output_name(const std::string& path) {
  return path == "-" ? "standard output" : path;
}

bool has_suffix(const std::string& path, std::string_view suffix) {
  return path.size() > suffix.size() &&
         path.compare(path.size() - suffix.size(), suffix.size(), suffix) == 0;
}

Problem read_from(std::unique_ptr<io::Source> source, const ReadOptions& options) {
  const auto plain = io::decompressed(std::move(source));
  io::Scanner scanner(*plain);
  switch (options.format) {
    case FileFormat::kAuto:
    case FileFormat::kNda:
      return io::read_nda(scanner, options);
    case FileFormat::kDense:
      return io::read_dense(scanner, options);
    case FileFormat::kCsv:
      return io::read_csv(scanner, options);
    case FileFormat::kLp:
    case FileFormat::kMps:
      break;
  }
  throw InputError(std::string("format ") + to_string(options.format) + " can only be written");
}

void write_comments(const std::vector<std::string>& comments, io::TextWriter& out) {
  for (const std::string& comment : comments) {
    if (comment.find('\n') != std::string::npos) throw InputError("comment with a line break");
    out << "c " << comment << '\n';
  }
}

void write_to(io::Sink& sink,
              const Problem& problem,
              FileFormat format,
              const std::vector<std::string>& comments) {
  if (problem.num_dimensions() == 0) throw InputError("the problem was moved from: 0 dimensions");
  io::TextWriter out(sink);
  switch (format) {
    case FileFormat::kAuto:
    case FileFormat::kNda:
      write_comments(comments, out);
      return io::write_nda(problem, out);
    case FileFormat::kCsv:
      return io::write_csv(problem, out);
    case FileFormat::kLp:
      return io::write_lp(problem, out);
    case FileFormat::kMps:
      return io::write_mps(problem, out);
    case FileFormat::kDense:
      break;
  }
  throw InputError(std::string("format ") + to_string(format) + " can only be read");
}

void write_to(io::Sink& sink, const Proof& proof) {
  io::TextWriter out(sink);
  io::write_proof(proof, out);
  sink.commit();
}

// A file's sink, compressing when its name says so.
std::unique_ptr<io::Sink> open_sink(const std::string& path) {
  std::unique_ptr<io::Sink> sink = io::file_sink(path);
  return has_suffix(path, ".gz") ? io::gzip_sink(std::move(sink)) : std::move(sink);
}

std::string read_all(io::Source& source) {
  std::string text;
  std::array<char, std::size_t{1} << 16> block;
  for (std::size_t count = 0; (count = source.read(block.data(), block.size())) > 0;) {
    text.append(block.data(), count);
  }
  return text;
}

}  // namespace

const char* to_string(FileFormat format) {
  switch (format) {
    case FileFormat::kAuto:
      return "auto";
    case FileFormat::kNda:
      return "nda";
    case FileFormat::kDense:
      return "dense";
    case FileFormat::kCsv:
      return "csv";
    case FileFormat::kLp:
      return "lp";
    case FileFormat::kMps:
      return "mps";
  }
  return "unknown";
}

FileFormat file_format(const std::string& name) {
  for (const FileFormat format : kFormats) {
    if (name == to_string(format)) return format;
  }
  throw InputError("unknown format '" + name + "', expected auto, nda, dense, csv, lp or mps");
}

FileFormat format_of(const std::string& path) {
  if (path == "-") return FileFormat::kNda;
  const std::string plain = has_suffix(path, ".gz") ? path.substr(0, path.size() - 3) : path;
  constexpr std::array<std::pair<std::string_view, FileFormat>, 6> kSuffixes = {{
      {".nda", FileFormat::kNda},
      {".csv", FileFormat::kCsv},
      {".dense", FileFormat::kDense},
      {".txt", FileFormat::kDense},
      {".lp", FileFormat::kLp},
      {".mps", FileFormat::kMps},
  }};
  for (const auto& [suffix, format] : kSuffixes) {
    if (has_suffix(plain, suffix)) return format;
  }
  throw InputError("cannot tell the format of '" + path +
                   "' by its name, known are .nda, .csv, .dense, .txt, .lp and .mps");
}

Problem read_problem(const std::string& path, const ReadOptions& options) {
  const std::string name = io::input_name(path);
  std::unique_ptr<io::Source> source = with_name(name, [&] { return io::file_source(path); });
  ReadOptions resolved = options;
  if (options.format == FileFormat::kAuto) resolved.format = format_of(path);
  return with_name(name, [&] { return read_from(std::move(source), resolved); });
}

Problem read_problem(std::istream& input, const ReadOptions& options) {
  return read_from(io::stream_source(input), options);
}

Problem parse_problem(std::string_view bytes, const ReadOptions& options) {
  return read_from(io::memory_source(bytes), options);
}

void write_problem(const Problem& problem, const std::string& path, const WriteOptions& options) {
  const FileFormat format = options.format == FileFormat::kAuto ? format_of(path) : options.format;
  with_name(output_name(path), [&] {
    const auto sink = open_sink(path);
    write_to(*sink, problem, format, options.comments);
    sink->commit();
  });
}

void write_problem(const Problem& problem, std::ostream& output, const WriteOptions& options) {
  const auto sink = io::stream_sink(output);
  write_to(*sink, problem, options.format, options.comments);
  sink->commit();
}

namespace {

template <typename MakeText>
void write_text(const std::string& path, MakeText make_text) {
  with_name(output_name(path), [&] {
    const std::string text = make_text();
    const auto sink = open_sink(path);
    sink->write(text);
    sink->commit();
  });
}

}  // namespace

void write_solution(const Solution& solution, const std::string& path) {
  write_text(path, [&] { return solution_to_json(solution); });
}

void write_warm_start(const WarmStart& warm_start, const std::string& path) {
  write_text(path, [&] { return warm_start_to_json(warm_start); });
}

WarmStart read_warm_start(const std::string& path) {
  return with_name(io::input_name(path), [&] {
    return warm_start_from_json(read_all(*io::decompressed(io::file_source(path))));
  });
}

Solution read_solution(const std::string& path) {
  return with_name(io::input_name(path), [&] {
    return solution_from_json(read_all(*io::decompressed(io::file_source(path))));
  });
}

void write_proof(const Proof& proof, const std::string& path) {
  with_name(output_name(path), [&] { write_to(*open_sink(path), proof); });
}

void write_proof(const Proof& proof, std::ostream& output) {
  write_to(*io::stream_sink(output), proof);
}

Proof read_proof(const std::string& path) {
  return with_name(io::input_name(path), [&] {
    const auto plain = io::decompressed(io::file_source(path));
    io::Scanner scanner(*plain);
    return io::read_proof(scanner);
  });
}

Proof parse_proof(std::string_view text) {
  const auto source = io::memory_source(text);
  io::Scanner scanner(*source);
  return io::read_proof(scanner);
}

}  // namespace nda
