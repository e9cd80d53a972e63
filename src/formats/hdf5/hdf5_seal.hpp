#pragma once

#include <string>
#include <string_view>

// The first 512 bytes of `jets.h5`: the user block of HDF5, which the library skips. They hold the
// size and the CRC-32 of the rest, because HDF5 itself trusts most of the content of a damaged
// file.

namespace hamjet::io {

/// The sealed file: the block, followed by the image that HDF5 has made.
std::string seal_hdf5(std::string_view image);

/// The image that HDF5 can read.
struct UnsealedHdf5 {
  std::string_view image;
  /// Whether the file has grown since it was sealed, because HDF5 lets other programs add to it.
  /// All that is read must then be checked against a checksum of its own.
  bool has_grown = false;
};

/// Checks the block and returns the image behind it, which must have the block's size or be longer.
/// A file without a block that begins as HDF5 files do is returned whole. Otherwise throws
/// Error(input_output) with the file's name.
UnsealedHdf5 unseal_hdf5(const std::string& name, std::string_view bytes);

/// Throws that the file is not as it was written.
[[noreturn]] void refuse_changed_hdf5(const std::string& name);

}  // namespace hamjet::io
