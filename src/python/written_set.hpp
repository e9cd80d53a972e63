#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>

#include "hamjet/detail/report/study_report.hpp"
#include "hamjet/store/output_directory.hpp"
#include "interruptible.hpp"

namespace hamjet::python {

/// Writes a study's files as the command does: the whole set or nothing. Throws
/// Error(input_output).
inline void write_set(const io::StudyReport& report, const std::filesystem::path& directory) {
  interruptibly(pybind11::none(), [files = report.files, directory](const ProgressCallback&) {
    io::OutputDirectory output(directory);
    for (const io::ReportFile& file : files) output.write(file.path, file.content);
    return output.commit();
  });
}

}  // namespace hamjet::python
