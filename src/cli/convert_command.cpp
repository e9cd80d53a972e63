#include "convert_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <system_error>
#include <type_traits>
#include <variant>

#include "../app/jet_conversion.hpp"
#include "../app/refusal.hpp"
#include "../app/rounding_note.hpp"
#include "../formats/foreign_jet.hpp"
#include "../formats/number_table.hpp"
#include "../formats/output_formats.hpp"
#include "../store/text_file.hpp"
#include "../text/scene_message.hpp"
#include "../text/terminal_text.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/jet_file.hpp"
#include "noted_jet.hpp"
#include "output_file.hpp"
#include "process/standard_streams.hpp"
#include "scene_options.hpp"

namespace hamjet::cli {
namespace {

std::vector<double> numbers_of(const std::string& option, const std::string& text) {
  std::vector<std::string_view> fields;
  io::split_line(text, fields);
  std::vector<double> numbers;
  for (const std::string_view field : fields) {
    const auto number = io::finite_number(field);
    if (!number) {
      refuse(fmt::format("{}: must be finite numbers between commas, got {}", option,
                         io::in_quotes(field)));
    }
    numbers.push_back(*number);
  }
  return numbers;
}

/// An option for each thing that a file from elsewhere does not say.
void add_description_options(CLI::App& command, io::JetDescription& foreign) {
  constexpr const char* group = "A jet from elsewhere, a file .dace without summary.json";
  for (const io::DescriptionMember& member : io::description_members()) {
    const std::string option = member.option();
    const auto add = [&]<class Value>(std::optional<Value> io::JetDescription::*value) {
      std::optional<Value>& target = foreign.*value;
      CLI::Option* added = nullptr;
      if constexpr (std::is_same_v<Value, std::vector<double>>) {
        added = command.add_option_function<std::string>(
            option,
            [&target, option](const std::string& text) { target = numbers_of(option, text); });
        added->type_name("NUMBERS");
      } else if constexpr (std::is_same_v<Value, std::vector<std::string>>) {
        added =
            command.add_option_function<std::string>(option, [&target](const std::string& text) {
              std::vector<std::string_view> names;
              io::split_line(text, names);
              target.emplace(names.begin(), names.end());
            });
        added->type_name("NAMES");
      } else {
        added = command.add_option(option, target);
        added->type_name(std::is_same_v<Value, double> ? "NUMBER" : "NAME");
      }
      added->description(std::string(member.help))->group(group);
    };
    std::visit(add, member.value);
  }
}

io::StoredJet read_jet(const ConvertOptions& options) {
  if (!options.time) {
    // Flow boxes that results have are wanted as they are; without any they are made of the jet.
    if (options.coordinates == std::string(name_of(JetCoordinates::flow_box))) {
      if (auto polynomials = io::read_stored_polynomials(options.from, options.run)) {
        if (polynomials->flow_box) return std::move(*polynomials);
      }
    }
    return read_noted_jet(options.from, options.run, options.foreign);
  }
  const io::WantedTimes wanted = wanted_times(*options.time);
  if (wanted.seconds.size() != 1) {
    refuse(
        fmt::format("--time: must be one time in seconds, got {}", io::in_quotes(*options.time)));
  }
  if (io::is_any_given(options.foreign)) refuse("--time: a jet from elsewhere has one time");
  return read_noted_jets(options.from, options.run, wanted).front();
}

CoordinatesAtEnds coordinates_of(const ConvertOptions& options, const io::StoredJet& stored) {
  const auto named = [](const std::string& name) {
    const auto& names = jet_coordinates_names;
    return static_cast<JetCoordinates>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  CoordinatesAtEnds wanted = stored.coordinates;
  if (options.coordinates) wanted = named(*options.coordinates);
  if (options.end_coordinates) wanted.end = named(*options.end_coordinates);
  return wanted;
}

/// The jet in the coordinates that are asked for, if any are.
std::optional<ConvertedJet> in_coordinates(const ConvertOptions& options,
                                           const io::StoredJet& stored) {
  if (!options.coordinates && !options.end_coordinates) {
    if (options.scene) refuse("--scene: is for --coordinates flow-box");
    return std::nullopt;
  }
  std::optional<Scene> scene;
  if (options.scene) {
    RunOptions scene_options;
    scene_options.scene_file = options.scene;
    scene = read_scene(scene_options, io::SceneUnits::told);  // as the jet is
  }
  return converted_jet(stored, coordinates_of(options, stored),
                       io::printable(options.from, std::string::npos), scene ? &*scene : nullptr);
}

/// What the conversion lost, by degree.
std::string losses_text(const ConvertedJet& converted) {
  if (converted.symplecticity.empty()) return "in flow-box coordinates, as they are stored\n";
  std::vector<std::vector<std::string>> rows = {{"degree", "there and back", "symplecticity"}};
  for (std::size_t d = 1; d <= converted.symplecticity.size(); ++d) {
    const bool is_known = d < converted.there_and_back.size();
    rows.push_back({std::to_string(d),
                    is_known ? fmt::format("{:.2g}", converted.there_and_back[d]) : "no way back",
                    fmt::format("{:.2g}", converted.symplecticity.at(d - 1).scaled)});
  }
  return fmt::format(
      "from {} to {} coordinates; relative to the largest coefficient of each degree, and of the "
      "brackets\n{}",
      name_of(converted.from), name_of(converted.stored.coordinates), io::aligned_table(rows));
}

}  // namespace

CLI::App* add_convert_command(CLI::App& app, ConvertOptions& options) {
  CLI::App* command =
      app.add_subcommand("convert", "write a stored jet as " + io::jet_file_endings(true) +
                                        "\nExample: hamjet convert out/scene scene.h5");
  command
      ->add_option("from", options.from,
                   "results of hamjet run, or a file .h5, or .dace or .csv beside its summary.json")
      ->required()
      ->type_name("FILE");
  command->add_option("to", options.to, "file to write; its ending is the format")
      ->required()
      ->type_name("FILE");
  command->add_option("--run", options.run, "label of the run (default: the first with a result)")
      ->type_name("LABEL");
  command
      ->add_option("--time", options.time,
                   "the jet at this one of the scene's jet.times_s (default: the end)")
      ->type_name("SECONDS");
  const std::vector<std::string> names(jet_coordinates_names.begin(), jet_coordinates_names.end());
  command
      ->add_option("--coordinates", options.coordinates,
                   "coordinates of the polynomials at both ends, in a file .h5; what was lost is "
                   "printed (default: those of the jet)")
      ->check(CLI::IsMember(names));
  command
      ->add_option("--end-coordinates", options.end_coordinates,
                   "coordinates at the end, where they differ from those at the start")
      ->check(CLI::IsMember(names));
  command
      ->add_option("--scene", options.scene,
                   "the jet's scene, whose gravity field --coordinates flow-box needs to make "
                   "flow boxes of a jet that has none")
      ->type_name("FILE");
  add_description_options(*command, options.foreign);
  return command;
}

int convert(const ConvertOptions& options) {
  if (options.from.empty() || options.run == "") {
    throw Error(ErrorKind::usage,
                fmt::format("{}: empty, must name {}", options.from.empty() ? "from" : "--run",
                            options.from.empty() ? "a stored jet" : "a run"));
  }
  const std::filesystem::path to = options.to;
  const io::OutputFormat& format = io::jet_format(to);
  std::error_code none;
  if (std::filesystem::equivalent(options.from, to, none)) {
    throw Error(ErrorKind::usage, "from and to: are the same file");
  }
  OutputFile file(to);
  const io::StoredJet stored = read_jet(options);
  const std::optional<ConvertedJet> converted = in_coordinates(options, stored);
  const io::StoredJet& written = converted ? converted->stored : stored;
  if (const auto note = rounding_note(written, format)) print_error("note: " + *note);
  file.add(io::jet_file_content(written, format));
  file.put_in_place();
  if (converted) print(losses_text(*converted));
  return 0;
}

}  // namespace hamjet::cli
