#include "output_file.hpp"

#include "../app/replaceable_file.hpp"
#include "../store/file_system.hpp"
#include "process/interruption.hpp"

namespace hamjet::cli {

OutputFile::OutputFile(const std::filesystem::path& file) : file_(file) {
  require_replaceable(file);
}

void OutputFile::write(const std::string& content) const {
  const RemovedAtSuddenEnd leftovers({io::temporary_beside(file_)});
  const UninterruptedWriting results;
  io::write_whole_file(file_, content);
}

}  // namespace hamjet::cli
