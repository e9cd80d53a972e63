#pragma once

#include <string>
#include <string_view>

// The first 512 bytes of `jets.h5`: the user block of HDF5, which the library skips. They hold the
// size and the CRC-32 of what follows, because HDF5 itself believes most of what a damaged file
// says.

namespace hamjet::io {

/// The file: the block, then the image that HDF5 has made.
std::string seal_hdf5(std::string_view image);

/// The image that HDF5 can read.
struct UnsealedHdf5 {
  std::string_view image;
  /// Whether the file has grown since it was sealed, as HDF5 lets other programs add to it: what is
  /// read must then be checked against its own checksum.
  bool has_grown = false;
};

/// What follows the block, which must fit it or be longer, or all of a file that has none and
/// begins as HDF5 files do. Throws Error(input_output) with the file's name otherwise.
UnsealedHdf5 unseal_hdf5(const std::string& name, std::string_view bytes);

/// Throws that the file is not what was written.
[[noreturn]] void refuse_changed_hdf5(const std::string& name);

}  // namespace hamjet::io
