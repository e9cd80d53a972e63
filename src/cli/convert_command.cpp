#include "convert_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <system_error>
#include <type_traits>
#include <variant>

#include "../app/refusal.hpp"
#include "../app/rounding_note.hpp"
#include "../formats/foreign_jet.hpp"
#include "../formats/number_table.hpp"
#include "../formats/output_formats.hpp"
#include "../store/text_file.hpp"
#include "../text/scene_message.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/jet_file.hpp"
#include "noted_jet.hpp"
#include "output_file.hpp"
#include "process/standard_streams.hpp"

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
  if (!options.time) return read_noted_jet(options.from, options.run, options.foreign);
  const io::WantedTimes wanted = wanted_times(*options.time);
  if (wanted.seconds.size() != 1) {
    refuse(
        fmt::format("--time: must be one time in seconds, got {}", io::in_quotes(*options.time)));
  }
  if (io::is_any_given(options.foreign)) refuse("--time: a jet from elsewhere has one time");
  return read_noted_jets(options.from, options.run, wanted).front();
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
  const OutputFile file(to);
  const io::StoredJet stored = read_jet(options);
  if (const auto note = rounding_note(stored, format)) print_error("note: " + *note);
  file.write(io::jet_file_content(stored, format));
  return 0;
}

}  // namespace hamjet::cli
