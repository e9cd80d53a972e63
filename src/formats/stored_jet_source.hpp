#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "hamjet/formats/stored_jet.hpp"
#include "stored_coefficients.hpp"

namespace hamjet::io {

/// The place of the coefficients of a stored jet, and the function that reads them.
struct CoefficientSource {
  std::filesystem::path file;  ///< empty for the run's jet.csv
  std::function<FlowJet<Extended>(const CoefficientFile&, std::string_view text)> read;
  std::string time_folder =
      {};  ///< folder of the run's jet at a time before the duration; otherwise empty
};

/// read_stored_jet of stored_jet.hpp, with coefficients from another file or format.
StoredJet read_stored_jet(const std::filesystem::path& directory,
                          const std::optional<std::string>& label, const FileReader& read,
                          const CoefficientSource& source);

}  // namespace hamjet::io
