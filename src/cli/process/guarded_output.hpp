#pragma once

#include <filesystem>
#include <optional>

#include "../../store/held_signals.hpp"
#include "hamjet/store/output_directory.hpp"
#include "interruption.hpp"

namespace hamjet::cli {

/// A directory for results of which a sudden end leaves nothing that was made for it.
class GuardedOutput {
 public:
  /// Throws what io::OutputDirectory throws.
  explicit GuardedOutput(const std::filesystem::path& directory) {
    const io::HeldSignals held;
    directory_.emplace(directory);
    leftovers_.watch(directory_->leftovers());
  }

  io::OutputDirectory& directory() { return *directory_; }

 private:
  RemovedAtSuddenEnd leftovers_;  ///< outlives the directory, which removes the same at its end
  std::optional<io::OutputDirectory> directory_;
};

}  // namespace hamjet::cli
