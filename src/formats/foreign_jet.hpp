#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hamjet/formats/jet_file.hpp"
#include "output_formats.hpp"

namespace hamjet::io {

/// One member of the description that is given for a jet from another program, as an option of the
/// command and an argument in Python.
struct DescriptionMember {
  std::string_view key;
  std::string_view help;
  std::variant<std::optional<std::string> JetDescription::*,
               std::optional<double> JetDescription::*,
               std::optional<std::vector<double>> JetDescription::*,
               std::optional<std::vector<std::string>> JetDescription::*>
      value;
  bool is_needed = true;

  /// The option of the command: two dashes, then the key with dashes for underscores.
  std::string option() const;
};

/// All members, in the order of messages and help.
const std::vector<DescriptionMember>& description_members();

/// Whether any member is given.
bool is_any_given(const JetDescription& given);

/// The jet in a file whose format holds polynomials alone, in double precision. `name` is the
/// file's name for messages; `scene` becomes the name of the jet. Throws Error(usage) for a
/// description that is incomplete or impossible, and Error(input_output) for a text that is damaged
/// or does not fit the description.
StoredJet foreign_jet(const std::string& name, const std::string& scene, std::string_view text,
                      const OutputFormat& format, const JetDescription& given);

}  // namespace hamjet::io
