#include "hdf5_handles.hpp"

namespace hamjet::io::hdf5 {
namespace {

/// The number of bytes by which the image in memory grows.
constexpr std::size_t increment = 65536;

Handle in_memory() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access, increment, false);
  return access;
}

// HDF5 needs a name. It does not create a file, but refuses an image if a file of this name exists;
// no file can have the name chosen here.
constexpr const char* name = "/dev/null/jets.h5";

}  // namespace

Handle create_in_memory() {
  const Handle access = in_memory();
  // The file has the oldest format, which is the default: images of newer formats that HDF5 1.10
  // gives have a wrong checksum.
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false);
  return {H5Fcreate(name, H5F_ACC_TRUNC, creation, access), H5Fclose};
}

Handle open_in_memory(std::string_view bytes, std::string& reason) {
  const Handle access = in_memory();
  // HDF5 copies the bytes. The parameter is not const because of an option that is not used.
  H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size());
  Handle file(H5Fopen(name, H5F_ACC_RDONLY, access), H5Fclose);
  if (!file.is_valid()) reason = last_error();
  return file;
}

}  // namespace hamjet::io::hdf5
