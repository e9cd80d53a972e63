#include "hdf5_writer.hpp"

#include <fmt/format.h>

#include "hamjet/error.hpp"
#include "hdf5_jets_format.hpp"

namespace hamjet::io::hdf5 {
namespace {

[[noreturn]] void fail(const std::string& object) {
  throw Error(ErrorKind::input_output,
              fmt::format("jets.h5: {}: HDF5 cannot write it: {}", object, last_error()));
}

Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

Handle scalar() { return {H5Screate(H5S_SCALAR), H5Sclose}; }

Handle row(std::size_t count) {
  const hsize_t length = count;
  return {H5Screate_simple(1, &length, nullptr), H5Sclose};
}

Handle without_times(hid_t kind) {
  Handle properties(H5Pcreate(kind), H5Pclose);
  H5Pset_obj_track_times(properties, false);
  return properties;
}

}  // namespace

Writer::Writer() : file_(create_in_memory()) {
  if (!file_.is_valid()) fail("the file");
}

Handle Writer::group(hid_t parent, const std::string& name) const {
  const Handle creation = without_times(H5P_GROUP_CREATE);
  Handle made(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose);
  if (!made.is_valid()) fail(name);
  return made;
}

void Writer::attribute(hid_t object, const char* name, hid_t stored, hid_t given, hid_t space,
                       const void* data) const {
  const Handle made(H5Acreate2(object, name, stored, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!made.is_valid() || H5Awrite(made, given, data) < 0) fail(name);
}

void Writer::attribute(hid_t object, const char* name, const std::string& text) const {
  const char* pointer = text.c_str();
  const Handle type = text_type();
  attribute(object, name, type, type, scalar(), &pointer);
}

void Writer::attribute(hid_t object, const char* name,
                       const std::vector<std::string>& texts) const {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  const Handle type = text_type();
  attribute(object, name, type, type, row(texts.size()), pointers.data());
}

void Writer::attribute(hid_t object, const char* name, double number) const {
  attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, scalar(), &number);
}

void Writer::attribute(hid_t object, const char* name, const std::vector<double>& numbers) const {
  attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, row(numbers.size()), numbers.data());
}

void Writer::attribute(hid_t object, const char* name, int number) const {
  attribute(object, name, H5T_STD_I32LE, H5T_NATIVE_INT, scalar(), &number);
}

Handle Writer::dataset(hid_t group, const char* name, const std::vector<hsize_t>& shape,
                       hid_t stored, hid_t given, const void* data, const Axes& axes) const {
  const Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr),
                     H5Sclose);
  const Handle creation = without_times(H5P_DATASET_CREATE);
  Handle made(H5Dcreate2(group, name, stored, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
  if (!made.is_valid() || H5Dwrite(made, given, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) < 0) {
    fail(name);
  }
  attribute(made, "DIMENSION_LABELS", axes);
  return made;
}

Handle Writer::dataset(hid_t group, const char* name, const std::vector<hsize_t>& shape,
                       std::span<const double> numbers, const Axes& axes) const {
  return dataset(group, name, shape, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, numbers.data(), axes);
}

Handle Writer::dataset(hid_t group, const char* name, const std::vector<hsize_t>& shape,
                       std::span<const std::uint8_t> numbers, const Axes& axes) const {
  return dataset(group, name, shape, H5T_STD_U8LE, H5T_NATIVE_UINT8, numbers.data(), axes);
}

Handle Writer::decimals(hid_t group, const char* name, const std::vector<hsize_t>& shape,
                        const std::string& texts, const Axes& axes) const {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, decimal_width);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  return dataset(group, name, shape, type, type, texts.data(), axes);
}

std::string Writer::image() const {
  if (H5Fflush(file_, H5F_SCOPE_GLOBAL) < 0) fail("the file");
  const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
  if (size <= 0) fail("the file");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file_, bytes.data(), bytes.size()) != size) fail("the file");
  return bytes;
}

}  // namespace hamjet::io::hdf5
