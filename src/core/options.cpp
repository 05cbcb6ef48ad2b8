#include "nda/options.hpp"

#include "core/option_table.hpp"

namespace nda {

void validate(const Options& options) {
  for (const core::OptionRow& row : core::option_table()) {
    if (row.holds(options)) continue;
    throw InputError("option " + row.name + " is " + row.text(options) + ", it must be " +
                     row.rule);
  }
}

}  // namespace nda
