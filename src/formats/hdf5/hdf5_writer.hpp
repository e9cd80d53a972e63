#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hdf5_handles.hpp"

namespace hamjet::io::hdf5 {

/// A file that is written in memory. Objects carry no times, so that equal content gives equal
/// bytes. Throws Error(input_output) with the name of the object that cannot be written.
class Writer {
 public:
  Writer();

  /// A group below another one or, without a `parent`, at the top.
  Handle group(hid_t parent, const std::string& name) const;
  hid_t root() const { return file_; }

  // Writes attributes of a group or dataset. Texts are UTF-8 of variable length, which h5py reads
  // best.
  void attribute(hid_t object, const char* name, const std::string& text) const;
  void attribute(hid_t object, const char* name, const std::vector<std::string>& texts) const;
  void attribute(hid_t object, const char* name, double number) const;
  void attribute(hid_t object, const char* name, const std::vector<double>& numbers) const;
  void attribute(hid_t object, const char* name, int number) const;

  /// Names of the axes, as many as the dataset has: the attribute DIMENSION_LABELS of HDF5's
  /// dimension scales (HDF5 High Level Reference, H5DSset_label).
  using Axes = std::vector<std::string>;

  // Datasets in C order: the last axis varies fastest.
  Handle dataset(hid_t group, const char* name, const std::vector<hsize_t>& shape,
                 std::span<const double> numbers, const Axes& axes) const;
  Handle dataset(hid_t group, const char* name, const std::vector<hsize_t>& shape,
                 std::span<const std::uint8_t> numbers, const Axes& axes) const;
  /// Writes texts of fixed length: `decimal_width` bytes each, filled up with zero bytes.
  Handle decimals(hid_t group, const char* name, const std::vector<hsize_t>& shape,
                  const std::string& texts, const Axes& axes) const;

  /// The bytes of the file.
  std::string image() const;

 private:
  Handle dataset(hid_t group, const char* name, const std::vector<hsize_t>& shape, hid_t stored,
                 hid_t given, const void* data, const Axes& axes) const;
  void attribute(hid_t object, const char* name, hid_t stored, hid_t given, hid_t space,
                 const void* data) const;

  Handle file_;
};

}  // namespace hamjet::io::hdf5
