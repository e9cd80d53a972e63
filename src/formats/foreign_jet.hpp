#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hamjet/formats/jet_file.hpp"
#include "output_formats.hpp"

namespace hamjet::io {

/// What must be told of a jet from elsewhere, as the command's option and Python's argument.
struct DescriptionMember {
  std::string_view key;
  std::string_view help;
  std::variant<std::optional<std::string> JetDescription::*,
               std::optional<double> JetDescription::*,
               std::optional<std::vector<double>> JetDescription::*>
      value;

  /// The option of the command: the key after two dashes, with dashes.
  std::string option() const;
};

/// All members, in the order of messages and help.
const std::vector<DescriptionMember>& description_members();

/// Whether anything is told.
bool is_any_given(const JetDescription& given);

/// The jet in the text of a file whose format reads polynomials alone, in double precision. `name`
/// is the file's, for messages; `scene` names the jet. Throws Error(usage) for what is not told or
/// cannot be, Error(input_output) for a text that is damaged or does not fit what is told.
StoredJet foreign_jet(const std::string& name, const std::string& scene, std::string_view text,
                      const OutputFormat& format, const JetDescription& given);

}  // namespace hamjet::io
