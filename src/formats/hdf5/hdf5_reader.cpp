#include "hdf5_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "../../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "hdf5_jets_format.hpp"

namespace hamjet::io::hdf5 {
namespace {

/// The largest number of values of an attribute; names and states are short.
constexpr hsize_t most_values = 4096;

/// The number of values of a dataspace; one without axes has one value.
hsize_t size_of(hid_t space) {
  const hssize_t points = H5Sget_simple_extent_npoints(space);
  return points < 0 ? 0 : static_cast<hsize_t>(points);
}

std::string up_to_nul(const char* text, std::size_t width) {
  const std::string_view whole(text, width);
  std::string result(whole.substr(0, whole.find('\0')));
  result.resize(result.find_last_not_of(' ') + 1);
  return result;
}

bool is_double(hid_t type) {
  return H5Tequal(type, H5T_IEEE_F64LE) > 0 || H5Tequal(type, H5T_IEEE_F64BE) > 0;
}

}  // namespace

Reader::Reader(std::string file, std::string_view bytes)
    : file_name_(std::move(file)), file_size_(bytes.size()) {
  std::string reason;
  file_ = open_in_memory(bytes, reason);
  if (!file_.is_valid()) {
    throw Error(ErrorKind::input_output,
                fmt::format("{}: HDF5 cannot open it: {}; it was cut, changed, or left open by the "
                            "program that wrote it",
                            file_name_, printable(reason)));
  }
  group_ = Handle(H5Gopen2(file_, "/", H5P_DEFAULT), H5Gclose);
  if (!group_.is_valid()) fail("", "the top group cannot be read: " + printable(last_error()));
}

Reader::Reader(const Reader& parent, Handle group, const std::string& name)
    : file_name_(parent.file_name_),
      path_(parent.path_ + name + "/"),
      file_size_(parent.file_size_),
      group_(std::move(group)) {}

void Reader::fail(std::string_view name, const std::string& what) const {
  std::string place = path_ + std::string(name);
  if (place.ends_with('/')) place.pop_back();
  if (place.empty()) place = "/";
  throw Error(ErrorKind::input_output,
              fmt::format("{}: {}: {}", file_name_, printable(place), what));
}

void Reader::require_link(const std::string& name) const {
  H5L_info_t link;
  if (H5Lget_info(group_, name.c_str(), &link, H5P_DEFAULT) < 0) fail(name, "is missing");
  if (link.type != H5L_TYPE_HARD) fail(name, "is a link, must be here itself");
}

Reader Reader::group(const std::string& name) const {
  require_link(name);
  Handle opened(H5Gopen2(group_, name.c_str(), H5P_DEFAULT), H5Gclose);
  if (!opened.is_valid()) fail(name, "must be a group");
  return {*this, std::move(opened), name};
}

bool Reader::has_attribute(const char* name) const { return H5Aexists(group_, name) > 0; }

Handle Reader::attribute(const char* name) const {
  if (!has_attribute(name)) fail(name, "the attribute is missing");
  Handle opened(H5Aopen(group_, name, H5P_DEFAULT), H5Aclose);
  if (!opened.is_valid()) fail(name, "the attribute cannot be read: " + printable(last_error()));
  return opened;
}

std::vector<std::string> Reader::texts(const char* name) const {
  const Handle opened = attribute(name);
  const Handle type(H5Aget_type(opened), H5Tclose);
  const Handle space(H5Aget_space(opened), H5Sclose);
  if (H5Tget_class(type) != H5T_STRING) fail(name, "the attribute must be text");
  const hsize_t count = size_of(space);
  if (count > most_values) fail(name, fmt::format("the attribute has {} values", count));
  std::vector<std::string> values;
  const auto require_read = [&](herr_t status) {
    if (status < 0) fail(name, "the attribute cannot be read: " + printable(last_error()));
  };
  if (H5Tis_variable_str(type) > 0) {
    std::vector<char*> pointers(count, nullptr);
    require_read(H5Aread(opened, type, pointers.data()));
    for (const char* text : pointers) values.emplace_back(text == nullptr ? "" : text);
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, pointers.data());
  } else {
    const std::size_t width = H5Tget_size(type);
    if (width == 0 || width > file_size_ || count > file_size_ / width) {
      fail(name, "the attribute is larger than the file");
    }
    std::vector<char> bytes(count * width);
    require_read(H5Aread(opened, type, bytes.data()));
    for (hsize_t i = 0; i < count; ++i) {
      values.push_back(up_to_nul(bytes.data() + i * width, width));
    }
  }
  for (const std::string& value : values) {
    if (printable(value, std::string::npos) != value) {
      fail(name, fmt::format("the attribute must be printable text, got {}", in_quotes(value)));
    }
  }
  return values;
}

std::string Reader::text(const char* name) const {
  std::vector<std::string> values = texts(name);
  if (values.size() != 1) {
    fail(name, fmt::format("the attribute must be one text, has {}", values.size()));
  }
  return std::move(values[0]);
}

std::vector<double> Reader::numbers(const char* name, std::size_t count) const {
  const Handle opened = attribute(name);
  const Handle type(H5Aget_type(opened), H5Tclose);
  const Handle space(H5Aget_space(opened), H5Sclose);
  if (!is_double(type)) fail(name, "the attribute must be float64");
  const hsize_t size = size_of(space);
  if (count != 0 ? size != count : size > most_values) {
    fail(name, count != 0 ? fmt::format("the attribute must have {} numbers, has {}", count, size)
                          : fmt::format("the attribute has {} numbers", size));
  }
  std::vector<double> values(size);
  if (H5Aread(opened, H5T_NATIVE_DOUBLE, values.data()) < 0) {
    fail(name, "the attribute cannot be read: " + printable(last_error()));
  }
  for (const double value : values) {
    if (!std::isfinite(value)) fail(name, "the attribute must be finite");
  }
  return values;
}

double Reader::number(const char* name) const { return numbers(name, 1)[0]; }

int Reader::integer(const char* name) const {
  const Handle opened = attribute(name);
  const Handle type(H5Aget_type(opened), H5Tclose);
  const Handle space(H5Aget_space(opened), H5Sclose);
  if (H5Tget_class(type) != H5T_INTEGER) fail(name, "the attribute must be an integer");
  if (size_of(space) != 1) fail(name, "the attribute must be one integer");
  int value = 0;  // HDF5 converts a value out of range to the nearest int
  if (H5Aread(opened, H5T_NATIVE_INT, &value) < 0) {
    fail(name, "the attribute cannot be read: " + printable(last_error()));
  }
  return value;
}

/// The dataset, if it has the expected shape and its values, of at least `width` bytes each, are
/// stored contiguously and without filters.
Handle Reader::dataset(const char* name, const std::vector<hsize_t>& shape,
                       std::size_t width) const {
  require_link(name);
  Handle opened(H5Dopen2(group_, name, H5P_DEFAULT), H5Dclose);
  if (!opened.is_valid()) fail(name, "must be a dataset");
  const Handle space(H5Dget_space(opened), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> found(rank > 0 ? static_cast<std::size_t>(rank) : 0);
  H5Sget_simple_extent_dims(space, found.data(), nullptr);
  if (found != shape) {
    fail(name, fmt::format("must have the shape ({}), has ({})", fmt::join(shape, ", "),
                           fmt::join(found, ", ")));
  }
  const Handle creation(H5Dget_create_plist(opened), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(creation);
  if ((layout != H5D_CONTIGUOUS && layout != H5D_COMPACT) || H5Pget_external_count(creation) != 0) {
    fail(name, "must be contiguous, not in chunks, compressed or in another file");
  }
  double bytes = static_cast<double>(width);
  for (const hsize_t length : shape) bytes *= static_cast<double>(length);
  if (bytes > static_cast<double>(file_size_)) {
    fail(name, fmt::format("would be {:.3g} bytes, and the file has {}", bytes, file_size_));
  }
  return opened;
}

std::vector<double> Reader::doubles(const char* name, const std::vector<hsize_t>& shape) const {
  const Handle opened = dataset(name, shape, sizeof(double));
  const Handle type(H5Dget_type(opened), H5Tclose);
  if (!is_double(type)) fail(name, "must be float64");
  std::size_t count = 1;
  for (const hsize_t length : shape) count *= length;
  std::vector<double> values(count);
  if (H5Dread(opened, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    fail(name, "cannot be read: " + printable(last_error()));
  }
  return values;
}

std::vector<std::uint8_t> Reader::bytes(const char* name, const std::vector<hsize_t>& shape) const {
  const Handle opened = dataset(name, shape, 1);
  const Handle type(H5Dget_type(opened), H5Tclose);
  if (H5Tequal(type, H5T_STD_U8LE) <= 0) fail(name, "must be uint8");
  std::size_t count = 1;
  for (const hsize_t length : shape) count *= length;
  std::vector<std::uint8_t> values(count);
  if (H5Dread(opened, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) {
    fail(name, "cannot be read: " + printable(last_error()));
  }
  return values;
}

std::vector<std::string> Reader::decimals(const char* name,
                                          const std::vector<hsize_t>& shape) const {
  const Handle opened = dataset(name, shape, 1);
  const Handle type(H5Dget_type(opened), H5Tclose);
  const std::size_t width = H5Tget_size(type);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || width == 0 ||
      width > decimal_width) {
    fail(name, fmt::format("must be texts of a fixed length of up to {} bytes", decimal_width));
  }
  std::size_t count = 1;
  for (const hsize_t length : shape) count *= length;
  if (count > file_size_ / width) fail(name, "is larger than the file");
  std::vector<char> text(count * width);
  if (H5Dread(opened, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0) {
    fail(name, "cannot be read: " + printable(last_error()));
  }
  std::vector<std::string> values;
  values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(up_to_nul(text.data() + i * width, width));
  }
  return values;
}

}  // namespace hamjet::io::hdf5
