// Replaces hdf5_jets_*.cpp in a build without HDF5.

#include "hamjet/error.hpp"
#include "hdf5_jets.hpp"

namespace hamjet::io {
namespace {

[[noreturn]] void refuse() {
  throw Error(ErrorKind::usage,
              "this build has no HDF5: install libhdf5-dev and configure with -DHAMJET_HDF5=ON");
}

}  // namespace

bool hdf5_available() noexcept { return false; }

std::string jets_hdf5(const PropagationResult&) { refuse(); }

std::string jets_hdf5(const StoredJet&) { refuse(); }

StoredJet read_jets_hdf5(const std::string&, std::string_view, const std::optional<std::string>&) {
  refuse();
}

}  // namespace hamjet::io
