#include "noted_jet.hpp"

#include <fmt/format.h>

#include "../app/refusal.hpp"
#include "../formats/number_table.hpp"
#include "../store/text_file.hpp"
#include "../text/scene_message.hpp"
#include "process/standard_streams.hpp"

namespace hamjet::cli {
namespace {

void print_notes(const io::StoredJet& stored) {
  for (const std::string& note : stored.notes) print_error("note: " + note);
}

}  // namespace

io::StoredJet read_noted_jet(const std::string& path, const std::optional<std::string>& label,
                             const io::JetDescription& foreign) {
  io::StoredJet stored = io::read_jet_file(path, label, foreign);
  print_notes(stored);
  return stored;
}

std::vector<io::StoredJet> read_noted_jets(const std::string& path,
                                           const std::optional<std::string>& label,
                                           const io::WantedTimes& wanted) {
  std::vector<io::StoredJet> jets = io::read_jets_at_times(path, label, wanted);
  print_notes(jets.front());
  return jets;
}

io::WantedTimes wanted_times(const std::string& option) {
  if (option == "all") return {{}, true};
  io::WantedTimes wanted;
  std::vector<std::string_view> fields;
  io::split_line(option, fields);
  for (const std::string_view field : fields) {
    const auto number = io::finite_number(field);
    if (!number) {
      refuse(fmt::format("--time: must be seconds between commas, or all, got {}",
                         io::in_quotes(option)));
    }
    wanted.seconds.push_back(*number);
  }
  return wanted;
}

}  // namespace hamjet::cli
