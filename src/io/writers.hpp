#pragma once

#include "io/sink.hpp"
#include "nda/problem.hpp"

namespace nda::io {

// One writer per format; each calls TextWriter::finish() last.  O(A N) time and, for LP and MPS,
// 4 bytes per arc.

/// Header, singletons whose cost is not 0, arcs in lexicographic order.
void write_nda(const Problem& problem, TextWriter& out);

/// The same rows under `i1,...,iN,cost`, with a singleton of cost 0 wherever the largest index of a
/// dimension would else not occur.
void write_csv(const Problem& problem, TextWriter& out);

/// minimise sum c x,  c_k_i: sum of x over arcs and singleton of (k, i) = 1,  x binary.
void write_lp(const Problem& problem, TextWriter& out);

/// The same model as free MPS.
void write_mps(const Problem& problem, TextWriter& out);

}  // namespace nda::io
