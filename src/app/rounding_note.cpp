#include "rounding_note.hpp"

#include <fmt/format.h>

#include "../formats/output_formats.hpp"

namespace hamjet::cli {

std::optional<std::string> rounding_note(const io::StoredJet& stored,
                                         const io::OutputFormat& format) {
  if (format.digits == 0 || stored.precision != Precision::extended) return std::nullopt;
  return fmt::format("the {} holds {} digits: the coefficients of extended precision are rounded",
                     format.help, format.digits);
}

}  // namespace hamjet::cli
