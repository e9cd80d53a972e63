#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "hamjet/error.hpp"

// What the fuzz targets share. A target reads whatever bytes it is given; its property is that they
// are either read, or refused as the reader's documentation says, and nothing else.

/// The entry point of a target, one for each program, called by libFuzzer (tools/fuzz) or by
/// replay.cpp.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace hamjet::fuzz {

/// Ends the program: prints what is wrong and aborts, so that the input is kept.
[[noreturn]] void report(std::string_view what);

inline void require(bool holds, std::string_view what) {
  if (!holds) report(what);
}

/// The ways in which a reader may refuse an input.
struct Refusal {
  std::vector<ErrorKind> kinds;
  /// The message begins with one of these: it names the file, or the option.
  std::vector<std::string_view> beginnings;
  std::size_t most_errors = 1;  ///< number of errors that may be printed together, one on each line
};

/// Whether the input is read. If not, requires an Error of one of these kinds whose message is one
/// line for each error, of valid UTF-8 without control characters, of at most 1000 bytes. Any other
/// exception, that of exhausted memory among them, is reported.
bool is_read(const std::function<void()>& read, const Refusal& refusal);

void require_finite(const std::vector<double>& numbers, std::string_view what);
void require_ascending(const std::vector<std::size_t>& indices, std::size_t count,
                       std::string_view what);

}  // namespace hamjet::fuzz
