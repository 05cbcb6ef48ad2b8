#include "cli/print.hpp"

#include <cstdarg>
#include <cstdio>
#include <iostream>
#include <string>

namespace nda::cli {

void print(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  std::va_list again;
  va_copy(again, arguments);
  std::string text(static_cast<std::size_t>(std::vsnprintf(nullptr, 0, format, arguments)), '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  va_end(arguments);
  std::cout << text;
}

}  // namespace nda::cli
