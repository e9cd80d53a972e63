#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hdf5_handles.hpp"

namespace hamjet::io::hdf5 {

/// A group of a file together with its place. Reading an object as a type that it does not have
/// throws Error(input_output) with one line that names file and place. Sizes are compared with
/// those that the caller expects, and with that of the file, before anything is allocated.
class Reader {
 public:
  /// The root group of a file. The bytes must outlive the reader.
  Reader(std::string file, std::string_view bytes);

  /// A group below this one; links that lead elsewhere are refused.
  Reader group(const std::string& name) const;

  bool has_attribute(const char* name) const;
  std::string text(const char* name) const;
  std::vector<std::string> texts(const char* name) const;
  double number(const char* name) const;
  /// Finite numbers of an attribute: `count` of them or, if `count` is 0, up to 4096.
  std::vector<double> numbers(const char* name, std::size_t count = 0) const;
  int integer(const char* name) const;

  std::vector<double> doubles(const char* name, const std::vector<hsize_t>& shape) const;
  std::vector<std::uint8_t> bytes(const char* name, const std::vector<hsize_t>& shape) const;
  /// Texts of fixed length, at most `decimal_width` bytes each.
  std::vector<std::string> decimals(const char* name, const std::vector<hsize_t>& shape) const;

  /// Throws `what` about the attribute or dataset `name`, or about the group if `name` is empty.
  [[noreturn]] void fail(std::string_view name, const std::string& what) const;

 private:
  Reader(const Reader& parent, Handle group, const std::string& name);

  void require_link(const std::string& name) const;
  Handle attribute(const char* name) const;
  Handle dataset(const char* name, const std::vector<hsize_t>& shape, std::size_t width) const;

  std::string file_name_;
  std::string path_;
  std::size_t file_size_;
  Handle file_;
  Handle group_;
};

}  // namespace hamjet::io::hdf5
