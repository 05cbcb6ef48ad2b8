#pragma once

#include "io/scanner.hpp"
#include "io/sink.hpp"
#include "nda/proof.hpp"

namespace nda::io {

/// The text of a proof; calls TextWriter::finish() last.
void write_proof(const Proof& proof, TextWriter& out);

/// Consumes the whole source; throws InputError "line n: ...".
Proof read_proof(Scanner& scanner);

}  // namespace nda::io
