#pragma once

#include <cstddef>
#include <string>

namespace hamjet::cli {

/// Puts /dev/null in the place of a standard stream that is closed: the next file that is opened
/// would take its number, and what is printed would go there. Printing to standard output fails
/// then.
void open_standard_streams();

/// All bytes of standard input, of which one more than `most_bytes` is read at most. Throws
/// Error(input_output).
std::string read_standard_input(std::size_t most_bytes);

/// Text to standard output, all of it at once. A reader that went away (`| head`) is no error; a
/// full disk is, and a stream that is closed: throws Error(input_output).
void print(const std::string& text);

/// Prints "hamjet: message" on standard error: each line of it as a line, but a warning or a note
/// broken as print_note does. There is nobody to tell if that fails.
void print_error(const std::string& message) noexcept;

/// Prints "hamjet: text" on standard error, broken as tables are, for explanations that are no
/// errors.
void print_note(const std::string& text);

}  // namespace hamjet::cli
