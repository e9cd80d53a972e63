#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "../store/text_file.hpp"
#include "../text/printable_text.hpp"
#include "arrays.hpp"
#include "bindings.hpp"
#include "hamjet/astronomy/earth_axes.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/earth_orientation_file.hpp"

namespace hamjet::python {
namespace {

using StateRows = py::array_t<double, py::array::c_style | py::array::forcecast>;

EarthAxes axes_of_argument(const std::string& place, const std::string& name) {
  if (const auto axes = axes_named(name)) return *axes;
  throw Error(ErrorKind::usage,
              fmt::format("{}: axes that are not known, got {}, must be one of: GCRF, EME2000, "
                          "MOD, TOD, TEME, CIRF, ITRF",
                          place, io::in_quotes(name)));
}

std::vector<Instant> instants_of(const std::vector<std::string>& epochs,
                                 const std::string& time_system) {
  const auto system = time_system_named(time_system);
  if (!system) {
    throw Error(ErrorKind::usage,
                fmt::format("time_system: not known, got {}, must be one of: {}",
                            io::in_quotes(time_system), fmt::join(time_system_names(), ", ")));
  }
  std::vector<Instant> instants;
  for (std::size_t k = 0; k < epochs.size(); ++k) {
    const auto epoch = parse_epoch(epochs[k]);
    if (!epoch) {
      throw Error(ErrorKind::usage, fmt::format("epochs: row {}: no date, got {}, must be like "
                                                "\"2010-07-27T00:05:00\"",
                                                k, io::in_quotes(epochs[k])));
    }
    try {
      instants.push_back(instant_of(*epoch, *system));
    } catch (const Error& error) {
      throw Error(error.kind(), fmt::format("epochs: row {}: {}", k, error.what()));
    }
  }
  return instants;
}

std::shared_ptr<const EarthOrientation> orientation_of(
    const std::optional<std::filesystem::path>& file) {
  if (!file) return nullptr;
  return std::make_shared<const EarthOrientation>(io::read_earth_orientation(
      io::printable_path(*file), io::read_text_file(*file, io::largest_earth_orientation_bytes)));
}

}  // namespace

void bind_axes(py::module_& module) {
  module.def("change_axes", [](const StateRows& states, const std::vector<std::string>& epochs,
                               const std::string& from, const std::string& to,
                               const std::string& time_system,
                               const std::optional<std::filesystem::path>& orientation_file) {
    const EarthAxes from_axes = axes_of_argument("from_axes", from);
    const EarthAxes to_axes = axes_of_argument("to_axes", to);
    const std::vector<Instant> instants = instants_of(epochs, time_system);
    const auto orientation = orientation_of(orientation_file);
    std::vector<double> numbers(states.data(), states.data() + states.size());
    if (!instants.empty()) {
      const auto [first, last] = std::minmax_element(instants.begin(), instants.end());
      const EarthAxesConversion conversion(from_axes, to_axes, *first, *last, orientation);
      for (std::size_t k = 0; k < instants.size(); ++k) {
        Eigen::Map<Eigen::Vector3d> position(&numbers[6 * k]);
        Eigen::Map<Eigen::Vector3d> velocity(&numbers[6 * k + 3]);
        conversion.at(instants[k]).apply(position, velocity);
      }
    }
    return array_of(std::move(numbers), {states.shape(0), 6});
  });
}

}  // namespace hamjet::python
