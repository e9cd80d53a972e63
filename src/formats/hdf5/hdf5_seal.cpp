#include "hdf5_seal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <system_error>

#include "../../store/sealed_summary.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {
namespace {

constexpr std::size_t block_size = 512;  ///< the least that HDF5 allows
constexpr std::string_view beginning = "hamjet jets, HDF5 from byte 512 on\n";
constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";

std::string block_of(const FileRecord& record) {
  std::string block =
      fmt::format("{}bytes {}\ncrc32 {:08x}\n", beginning, record.bytes, record.crc32);
  block.resize(block_size - 1, ' ');
  return block + "\n";
}

/// The size that a block gives, if it has the form that the writer gives it.
std::optional<std::uintmax_t> size_in(std::string_view block) {
  FileRecord record;
  const std::string_view text = block.substr(std::min(block.size(), beginning.size() + 6));
  const auto size = std::from_chars(text.data(), text.data() + text.size(), record.bytes);
  constexpr std::string_view between = "\ncrc32 ";
  const char* const sum = size.ptr + between.size();
  if (size.ec != std::errc() || sum >= text.data() + text.size()) return std::nullopt;
  const auto read = std::from_chars(sum, text.data() + text.size(), record.crc32, 16);
  if (read.ec != std::errc() || block != block_of(record)) return std::nullopt;
  return record.bytes;
}

}  // namespace

std::string seal_hdf5(std::string_view image) {
  return block_of(record_of({}, image)).append(image);
}

void refuse_changed_hdf5(const std::string& name) {
  throw Error(ErrorKind::input_output,
              fmt::format("{}: was cut or changed after it was written: its checksum is wrong; run "
                          "the scene again",
                          name));
}

UnsealedHdf5 unseal_hdf5(const std::string& name, std::string_view bytes) {
  const auto fail = [&](const std::string& what) {
    throw Error(ErrorKind::input_output, fmt::format("{}: {}", name, what));
  };
  if (bytes.starts_with(signature)) return {bytes};
  if (!bytes.starts_with(beginning.substr(0, bytes.size())) || bytes.empty()) {
    fail("is not an HDF5 file of jets: it begins neither as hamjet's nor as any HDF5 file");
  }
  if (bytes.size() <= block_size) {
    fail(fmt::format("was cut: it ends after {} bytes; run the scene again", bytes.size()));
  }
  const std::string_view image = bytes.substr(block_size);
  const std::string_view block = bytes.substr(0, block_size);
  if (block == block_of(record_of({}, image))) return {image};
  const auto size = size_in(block);
  if (!size || image.size() <= *size) refuse_changed_hdf5(name);
  return {image, true};
}

}  // namespace hamjet::io
