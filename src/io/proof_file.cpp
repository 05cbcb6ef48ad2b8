#include "io/proof_file.hpp"

#include <bit>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "io/readers.hpp"

// Words and numbers, free of lines: the writer breaks them where they grow long.
//
//     p nda-proof N M1..MN A GRID PARTS
//     part INDICES STEPS  then for each index: dimension index
//     bound POINT | fix THRESHOLD POINT | search THRESHOLD POINT
//     cliques THRESHOLD POINT | together P P | apart P P
//     cover P USES arc... | split GROUPS (SIZE position...)...
//     POINT = CHANGES (position value)...  CUTS (multiplier divisor SIZE (position weight)...)...
//     end DIGEST
//
// Positions, dimensions and arcs count from 1.  The digest is of what the numbers mean, not of the
// text: a file that was damaged or changed anywhere is refused, however it was laid out.

namespace nda::io {
namespace {

constexpr std::pair<ProofRule, std::string_view> kRules[] = {{ProofRule::kBound, "bound"},
                                                             {ProofRule::kFix, "fix"},
                                                             {ProofRule::kSearch, "search"},
                                                             {ProofRule::kCliques, "cliques"},
                                                             {ProofRule::kTogether, "together"},
                                                             {ProofRule::kApart, "apart"},
                                                             {ProofRule::kCover, "cover"},
                                                             {ProofRule::kSplit, "split"}};
constexpr int kNumbersPerLine = 40;

bool has_threshold(ProofRule rule) {
  return rule == ProofRule::kFix || rule == ProofRule::kSearch || rule == ProofRule::kCliques;
}

bool is_of_a_pair(ProofRule rule) {
  return rule == ProofRule::kTogether || rule == ProofRule::kApart;
}

bool is_branching(ProofRule rule) {
  return is_of_a_pair(rule) || rule == ProofRule::kCover || rule == ProofRule::kSplit;
}

// FNV-1a (Fowler, Noll & Vo) of a proof; of its 64 bits the upper 60, which every reader of whole
// numbers takes.
class Digest {
 public:
  explicit Digest(const Proof& proof) {
    add_all(proof.sizes);
    add(proof.num_arcs);
    add(proof.grid);
    add(proof.parts.size());
    for (const ProofPart& part : proof.parts) add(part);
  }

  std::uint64_t value() const { return hash_ >> 4; }

 private:
  void add(std::uint64_t value) {
    constexpr std::uint64_t kPrime = 0x100000001b3;
    for (int byte = 0; byte < 8; ++byte, value >>= 8) hash_ = (hash_ ^ (value & 0xff)) * kPrime;
  }

  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }

  template <typename Numbers>
  void add_all(const Numbers& numbers) {
    add(std::uint64_t{numbers.size()});
    for (const auto number : numbers) add(std::uint64_t{number});
  }

  void add(const ProofPart& part) {
    add(std::uint64_t{part.indices.size()});
    for (const ProofIndex& index : part.indices) {
      add(static_cast<std::uint64_t>(index.dimension));
      add(std::uint64_t{index.index});
    }
    add(std::uint64_t{part.steps.size()});
    for (const ProofStep& step : part.steps) add(step);
  }

  void add(const ProofStep& step) {
    add(static_cast<std::uint64_t>(step.rule));
    if (is_branching(step.rule)) return add_branching(step);
    if (has_threshold(step.rule)) add(step.threshold);
    add(std::uint64_t{step.point.changes.size()});
    for (const ProofMultiplier& change : step.point.changes) {
      add(std::uint64_t{change.position});
      add(change.value);
    }
    add(std::uint64_t{step.point.cuts.size()});
    for (const ProofCut& cut : step.point.cuts) {
      add(cut.multiplier);
      add(std::uint64_t{cut.divisor});
      add_all(cut.positions);
      add_all(cut.weights);
    }
  }

  void add_branching(const ProofStep& step) {
    if (step.rule == ProofRule::kSplit) {
      add(std::uint64_t{step.groups.size()});
      for (const std::vector<std::uint32_t>& group : step.groups) add_all(group);
      return;
    }
    add(std::uint64_t{step.first});
    if (is_of_a_pair(step.rule)) {
      add(std::uint64_t{step.second});
    } else {
      add_all(step.uses);
    }
  }

  std::uint64_t hash_ = 0xcbf29ce484222325;
};

class ProofWriter {
 public:
  explicit ProofWriter(TextWriter& out) : out_(out) {}

  void write(const Proof& proof) {
    out_ << "p nda-proof ";
    out_ << static_cast<std::uint64_t>(proof.sizes.size());
    for (const Index size : proof.sizes) number(std::uint64_t{size});
    number(static_cast<std::uint64_t>(proof.num_arcs));
    number(proof.grid);
    number(static_cast<std::uint64_t>(proof.parts.size()));
    for (const ProofPart& part : proof.parts) write(part);
    word("end");
    number(Digest(proof).value());
    out_ << '\n';
    out_.finish();
  }

 private:
  void word(std::string_view text) {
    out_ << '\n' << text;
    numbers_ = 0;
  }

  template <typename Number>
  void number(Number value) {
    out_ << (++numbers_ % kNumbersPerLine == 0 ? '\n' : ' ') << value;
  }

  void position(std::uint32_t position) { number(std::uint64_t{position} + 1); }

  void write(const ProofPart& part) {
    word("part");
    number(static_cast<std::uint64_t>(part.indices.size()));
    number(static_cast<std::uint64_t>(part.steps.size()));
    for (const auto [dimension, index] : part.indices) {
      number(static_cast<std::uint64_t>(dimension + 1));
      number(std::uint64_t{index});
    }
    for (const ProofStep& step : part.steps) write(step);
  }

  void write(const ProofStep& step) {
    for (const auto& [rule, name] : kRules) {
      if (rule == step.rule) word(name);
    }
    if (is_branching(step.rule)) return write_branching(step);
    if (has_threshold(step.rule)) number(step.threshold);
    number(static_cast<std::uint64_t>(step.point.changes.size()));
    for (const ProofMultiplier& change : step.point.changes) {
      position(change.position);
      number(change.value);
    }
    number(static_cast<std::uint64_t>(step.point.cuts.size()));
    for (const ProofCut& cut : step.point.cuts) write(cut);
  }

  void write_branching(const ProofStep& step) {
    if (step.rule == ProofRule::kSplit) {
      number(static_cast<std::uint64_t>(step.groups.size()));
      for (const std::vector<std::uint32_t>& group : step.groups) write(group);
      return;
    }
    position(step.first);
    if (is_of_a_pair(step.rule)) return position(step.second);
    number(static_cast<std::uint64_t>(step.uses.size()));
    for (const std::uint32_t arc : step.uses) number(std::uint64_t{arc});
  }

  void write(const std::vector<std::uint32_t>& group) {
    number(static_cast<std::uint64_t>(group.size()));
    for (const std::uint32_t p : group) position(p);
  }

  void write(const ProofCut& cut) {
    number(cut.multiplier);
    number(std::uint64_t{cut.divisor});
    number(static_cast<std::uint64_t>(cut.positions.size()));
    for (std::size_t i = 0; i < cut.positions.size(); ++i) {
      position(cut.positions[i]);
      number(std::uint64_t{cut.weights[i]});
    }
  }

  TextWriter& out_;
  int numbers_ = 0;
};

class ProofReader {
 public:
  explicit ProofReader(Scanner& scanner) : scanner_(scanner) {}

  Proof read() {
    Proof proof;
    expect("p");
    expect("nda-proof");
    proof.sizes.resize(whole("the number of dimensions", kMaxDimensions));
    for (Index& size : proof.sizes) size = static_cast<Index>(whole("a size", kMostIndices));
    proof.num_arcs = whole("the number of arcs", kMostIndices);
    proof.grid = real("the grid");
    const std::uint64_t parts = count("parts", kLeastBytesPerPart);
    for (std::uint64_t p = 0; p < parts; ++p) proof.parts.push_back(read_part());
    check_digest(Digest(proof).value());
    if (scanner_.next_word()) scanner_.fail("unexpected " + scanner_.found());
    return proof;
  }

 private:
  static constexpr std::uint64_t kMostIndices = std::numeric_limits<Index>::max();
  static constexpr std::size_t kLeastBytesPerPart = 8;  // "part 0 0"
  static constexpr std::size_t kLeastBytesPerPair = 4;  // "1 1 "
  static constexpr std::size_t kLeastBytesPerCut = 6;   // "0 1 0 "
  static constexpr std::size_t kLeastBytesPerStep = 7;  // "split 0"
  static constexpr std::size_t kLeastBytesPerOne = 2;   // "1 "

  void check_digest(std::uint64_t digest) {
    expect("end");
    const std::uint64_t stated = whole("a digest", std::numeric_limits<std::uint64_t>::max());
    if (stated == digest) return;
    scanner_.fail("the proof was changed: its digest is " + std::to_string(digest) + ", not " +
                  std::to_string(stated));
  }

  ProofPart read_part() {
    expect("part");
    ProofPart part;
    part.indices.resize(count("indices", kLeastBytesPerPair));
    const std::uint64_t steps = count("steps", kLeastBytesPerStep);
    for (ProofIndex& index : part.indices) {
      index.dimension = static_cast<int>(whole("a dimension", kMaxDimensions)) - 1;
      index.index = static_cast<Index>(whole("an index", kMostIndices));
    }
    for (std::uint64_t s = 0; s < steps; ++s) part.steps.push_back(read_step());
    return part;
  }

  ProofStep read_step() {
    ProofStep step;
    step.rule = read_rule();
    if (is_branching(step.rule)) {
      read_branching(step);
      return step;
    }
    if (has_threshold(step.rule)) step.threshold = real("a threshold");
    step.point.changes.resize(count("multipliers", kLeastBytesPerPair));
    for (ProofMultiplier& change : step.point.changes) {
      change.position = position();
      change.value = real("a multiplier");
    }
    step.point.cuts.resize(count("cuts", kLeastBytesPerCut));
    for (ProofCut& cut : step.point.cuts) read(cut);
    return step;
  }

  void read_branching(ProofStep& step) {
    if (step.rule == ProofRule::kSplit) {
      step.groups.resize(count("groups", kLeastBytesPerOne));
      for (std::vector<std::uint32_t>& group : step.groups) {
        group.resize(count("positions", kLeastBytesPerOne));
        for (std::uint32_t& p : group) p = position();
      }
      return;
    }
    step.first = position();
    if (is_of_a_pair(step.rule)) {
      step.second = position();
      return;
    }
    step.uses.resize(count("uses", kLeastBytesPerOne));
    for (std::uint32_t& arc : step.uses)
      arc = static_cast<std::uint32_t>(whole("an arc, or 0", kMostIndices));
  }

  void read(ProofCut& cut) {
    constexpr std::uint64_t kByte = std::numeric_limits<std::uint8_t>::max();
    cut.multiplier = real("the multiplier of a cut");
    cut.divisor = static_cast<std::uint8_t>(whole("a divisor", kByte));
    const std::uint64_t size = count("weights", kLeastBytesPerPair);
    for (std::uint64_t i = 0; i < size; ++i) {
      cut.positions.push_back(position());
      cut.weights.push_back(static_cast<std::uint8_t>(whole("a weight", kByte)));
    }
  }

  ProofRule read_rule() {
    to_word("a step");
    for (const auto& [rule, name] : kRules) {
      if (scanner_.word() != name) continue;
      skip(name.size());
      return rule;
    }
    scanner_.fail("expected a step of a proof, found " + scanner_.found());
  }

  void to_word(const std::string& what) {
    if (!scanner_.next_word()) scanner_.fail("expected " + what + ", found the end of the file");
  }

  void skip(std::size_t length) {
    for (std::size_t i = 0; i < length; ++i) scanner_.advance();
  }

  void expect(std::string_view word) {
    const std::string quoted = in_quotes(word);
    to_word(quoted);
    if (scanner_.word() != word)
      scanner_.fail("expected " + quoted + ", found " + scanner_.found());
    skip(word.size());
  }

  std::uint64_t whole(const std::string& what, std::uint64_t largest) {
    to_word(what);
    return read_whole(scanner_, what, largest);
  }

  // A number of things of at least so many bytes each.
  std::uint64_t count(const char* what, std::size_t least_bytes) {
    const std::uint64_t number = whole(std::string("the number of ") + what, kMostIndices);
    check_backed(scanner_, number, least_bytes, what);
    return number;
  }

  std::uint32_t position() {
    const std::uint64_t position = whole("a position", kMostIndices);
    if (position == 0) scanner_.fail("position 0 does not exist, the first is 1");
    return static_cast<std::uint32_t>(position - 1);
  }

  double real(const std::string& what) {
    to_word(what);
    double value = 0;
    if (!scanner_.read_double(value))
      scanner_.fail("expected " + what + ", found " + scanner_.found());
    return value;
  }

  Scanner& scanner_;
};

}  // namespace

void write_proof(const Proof& proof, TextWriter& out) {
  ProofWriter(out).write(proof);
}

Proof read_proof(Scanner& scanner) {
  return ProofReader(scanner).read();
}

}  // namespace nda::io
