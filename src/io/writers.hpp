#pragma once

#include "io/sink.hpp"
#include "nda/problem.hpp"

namespace nda::io {

// One writer per format; each calls TextWriter::finish() last.  O(A N) time and, for LP and MPS,
// 4 bytes per arc.

/// Header, bounds other than 1..1, singletons whose cost is not 0, arcs in lexicographic order.
void write_nda(const Problem& problem, TextWriter& out);

/// The same rows under `i1,...,iN,cost`, with a singleton of cost 0 wherever the largest index of a
/// dimension would else not occur.  Throws InputError where an index has bounds other than 1..1.
void write_csv(const Problem& problem, TextWriter& out);

/// minimise sum c x,  c_k_i: sum of x over arcs and singleton of (k, i) = 1,  x binary; where an
/// index has bounds lo..hi of its own: lo <= sum <= hi (two rows, c_k_i and d_k_i), and the
/// singleton's x is an integer from 0 to hi.
void write_lp(const Problem& problem, TextWriter& out);

/// The same model as free MPS, with ranges instead of second rows.
void write_mps(const Problem& problem, TextWriter& out);

}  // namespace nda::io
