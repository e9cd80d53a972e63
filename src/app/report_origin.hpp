#pragma once

#include <string>

#include "hamjet/detail/report/report_origin.hpp"

namespace hamjet::cli {

/// Command line, date and processor of a report that is made now.
io::ReportOrigin report_origin(const std::string& command);

}  // namespace hamjet::cli
