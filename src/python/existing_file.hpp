#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "hamjet/error.hpp"

namespace hamjet::python {

/// A file that was to be written is there already, and was not to be replaced.
class ExistingFile : public Error {
 public:
  ExistingFile(std::filesystem::path file, const std::string& message)
      : Error(ErrorKind::input_output, message), file_(std::move(file)) {}
  const std::filesystem::path& file() const noexcept { return file_; }

 private:
  std::filesystem::path file_;
};

}  // namespace hamjet::python
