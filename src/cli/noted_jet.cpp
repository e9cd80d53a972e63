#include "noted_jet.hpp"

#include "process/standard_streams.hpp"

namespace hamjet::cli {

io::StoredJet read_noted_jet(const std::string& path, const std::optional<std::string>& label,
                             const io::JetDescription& foreign) {
  io::StoredJet stored = io::read_jet_file(path, label, foreign);
  for (const std::string& note : stored.notes) print_error("note: " + note);
  return stored;
}

}  // namespace hamjet::cli
