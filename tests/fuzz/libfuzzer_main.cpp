#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fuzz/fuzz_targets.hpp"

// libFuzzer's entry point for the target whose number is NDA_FUZZ_TARGET.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  nda::fuzz::targets()[NDA_FUZZ_TARGET].run({reinterpret_cast<const char*>(data), size});
  return 0;
}
