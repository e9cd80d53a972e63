#include "hdf5_seal.hpp"

#include <fmt/format.h>

#include "../../store/sealed_summary.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {
namespace {

constexpr std::size_t block_size = 512;  ///< the least that HDF5 allows
constexpr std::string_view beginning = "hamjet jets, HDF5 from byte 512 on\n";
constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";

std::string block_of(std::string_view image) {
  const FileRecord record = record_of({}, image);
  std::string block =
      fmt::format("{}bytes {}\ncrc32 {:08x}\n", beginning, record.bytes, record.crc32);
  block.resize(block_size - 1, ' ');
  return block + "\n";
}

}  // namespace

std::string seal_hdf5(std::string_view image) { return block_of(image).append(image); }

std::string_view unseal_hdf5(const std::string& name, std::string_view bytes) {
  const auto fail = [&](const std::string& what) {
    throw Error(ErrorKind::input_output, fmt::format("{}: {}", name, what));
  };
  if (bytes.starts_with(signature)) return bytes;
  if (!bytes.starts_with(beginning.substr(0, bytes.size())) || bytes.empty()) {
    fail("is not an HDF5 file of jets: it begins neither as hamjet's nor as any HDF5 file");
  }
  if (bytes.size() <= block_size) {
    fail(fmt::format("was cut: it ends after {} bytes; run the scene again", bytes.size()));
  }
  const std::string_view image = bytes.substr(block_size);
  if (bytes.substr(0, block_size) != block_of(image)) {
    fail("was cut or changed after it was written: its checksum is wrong; run the scene again");
  }
  return image;
}

}  // namespace hamjet::io
