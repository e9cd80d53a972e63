#include "convert_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <system_error>

#include "../app/rounding_note.hpp"
#include "../formats/output_formats.hpp"
#include "hamjet/error.hpp"
#include "hamjet/formats/jet_file.hpp"
#include "output_file.hpp"
#include "process/standard_streams.hpp"

namespace hamjet::cli {

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
  const io::StoredJet stored = io::read_jet_file(options.from, options.run);
  if (const auto note = rounding_note(stored, format)) print_error("note: " + *note);
  file.write(io::jet_file_content(stored, format));
  return 0;
}

}  // namespace hamjet::cli
