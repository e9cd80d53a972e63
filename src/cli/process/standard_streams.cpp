#include "standard_streams.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <exception>
#include <system_error>

#include "../../text/scene_message.hpp"
#include "../../text/terminal_text.hpp"
#include "hamjet/error.hpp"

namespace hamjet::cli {

void open_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) != -1 || errno != EBADF) continue;
    // The system gives the lowest free descriptor, which is this one. Writing results to it must
    // fail, as it would without it.
    ::open("/dev/null", descriptor == STDOUT_FILENO ? O_RDONLY : O_RDWR);
  }
}

std::string read_standard_input(std::size_t most_bytes) {
  std::string text;
  std::array<char, 65536> buffer;
  while (text.size() <= most_bytes) {
    const std::size_t wanted = std::min(buffer.size(), most_bytes + 1 - text.size());
    const ssize_t count = ::read(STDIN_FILENO, buffer.data(), wanted);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      throw Error(ErrorKind::input_output, fmt::format("standard input cannot be read: {}",
                                                       std::generic_category().message(errno)));
    }
    if (count == 0) break;
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  return text;
}

void print(const std::string& text) {
  const bool is_written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (is_written && std::fflush(stdout) == 0) return;
  if (errno == EPIPE) return;
  throw Error(
      ErrorKind::input_output,
      fmt::format("standard output cannot be written: {}",
                  errno == EBADF ? "it is closed" : std::generic_category().message(errno)));
}

namespace {

constexpr std::string_view head = "hamjet: ";

/// Whether a line is no error and so may be broken: a script looks for errors, a person reads the
/// rest.
bool is_to_be_fitted(std::string_view line) {
  return line.starts_with(io::warning_head) || line.starts_with(io::note_head);
}

void print_error_line(std::string_view line) noexcept {
  std::fwrite(head.data(), 1, head.size(), stderr);
  try {
    const std::string shown = io::printable(line, std::string::npos);
    std::fwrite(shown.data(), 1, shown.size(), stderr);
  } catch (const std::exception&) {
    std::fputs("out of memory", stderr);
  }
  std::fputs("\n", stderr);
}

}  // namespace

void print_error(const std::string& message) noexcept {
  // stdio is used, not fmt::print, which throws if the stream is closed or full. The errors of a
  // scene are a line each.
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
    end = message.find('\n', begin);
    const std::string_view line =
        std::string_view(message).substr(begin, std::min(end, message.size()) - begin);
    if (is_to_be_fitted(line)) {
      try {
        print_note(std::string(line));
        continue;
      } catch (const std::exception&) {
        // Without memory for the lines it is one line.
      }
    }
    print_error_line(line);
  }
}

void print_note(const std::string& text) {
  std::string lines = io::fitted(text, io::terminal_width - head.size());
  for (std::size_t end = lines.find('\n'); end != std::string::npos;
       end = lines.find('\n', end + 1)) {
    lines.insert(end + 1, head.size(), ' ');
  }
  std::fputs(fmt::format("{}{}\n", head, lines).c_str(), stderr);
}

}  // namespace hamjet::cli
