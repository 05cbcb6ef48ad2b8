#pragma once

namespace nda::cli {

/// printf() to std::cout: results have one way out, and main() sees when it fails.
[[gnu::format(printf, 1, 2)]] void print(const char* format, ...);

}  // namespace nda::cli
