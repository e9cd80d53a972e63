#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "../output_formats.hpp"
#include "hamjet/formats/stored_jet.hpp"
#include "hamjet/studies/propagation.hpp"

// `jets.h5`: the jets of all runs of a scene in one HDF5 file, which h5py, MATLAB and Julia read.
// The attribute `description` describes the content. The first 512 bytes, which HDF5 leaves to the
// user, hold the size and the CRC-32 of the rest, so that a file that was cut or changed is refused
// before its content is used. A file that has grown because another program added groups or
// attributes is still read if the checksum of the run, over all that is read, is right; a note says
// so.
//
//   /               attributes: format, format_version, hamjet_version, description, scene, title,
//                   model, precision, frame, units, length_unit_km, time_unit_s, order,
//                   duration_canonical, variables, components, state, nominal_initial, runs; of a
//                   scene with [ephemeris] also reference_frame, center_name, epoch, time_system;
//                   of a jet that does not start at the epoch, start_canonical; of forces that
//                   depend on the time, autonomous: no
//   /<label>        one group a run, with its label; attributes: method, nominal_final,
//                   content_crc32; of a run that failed the attribute error, and nothing else
//     coefficients  (component, term) float64
//     coefficients_decimal  (component, term) strings of 36 digits; in extended precision alone,
//                   where `coefficients` are rounded
//     exponents     (term, variable) uint8, graded: see SeriesSpace
//     nominal_time  (time), nominal_state (time, state), nominal_energy_error (time); float64
//     generating_functions/<kind>  coefficients (term), exponents (term, variable); attributes:
//                   variables, condition
//
// In a build without HDF5 (HAMJET_HDF5 off) the functions throw Error(usage) that say how to build
// it. Debian's HDF5 library is not thread-safe: calls from several threads wait for each other, and
// a program that uses HDF5 itself must keep its own calls apart from them.

namespace hamjet::io {

/// Whether this build has HDF5.
bool hdf5_available() noexcept;

/// The bytes of `jets.h5`; equal results give equal bytes. Throws Error(input_output).
std::string jets_hdf5(const PropagationResult& result);

/// The bytes of a `jets.h5` that holds one jet, without nominal trajectory and generating
/// functions.
std::string jets_hdf5(const StoredJet& stored);

/// Reads the run with this label or, without a label, the first run that has a result. A file that
/// another program has written, without the 512 bytes, is also read if it has all parts of a jet in
/// the layout above, contiguous and not compressed. In such a file only HDF5 can detect damage, and
/// some damage makes HDF5 crash. `name` is the file's, for messages. Throws Error(input_output),
/// with one line that names the file and the dataset or attribute, for content that is damaged or
/// missing, or has another shape, type or format version; Error(usage) if no run has this label.
StoredJet read_jets_hdf5(const std::string& name, std::string_view bytes,
                         const std::optional<std::string>& label = {});

/// Defined here because builds with and without HDF5 share no source file.
inline constexpr OutputFormat hdf5_format = {.name = "hdf5",
                                             .help = "HDF5",
                                             .file = "jets.h5",
                                             .ending = ".h5",
                                             .library = "HDF5",
                                             .is_built = hdf5_available,
                                             .of_results = jets_hdf5,
                                             .of_jet = jets_hdf5,
                                             .read = read_jets_hdf5};

}  // namespace hamjet::io
