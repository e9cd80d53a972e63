#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>
#include <utility>

#include "../../formats/relative_frame_text.hpp"
#include "../../store/columns.hpp"
#include "hamjet/studies/transfer.hpp"
#include "transfer_view.hpp"

namespace hamjet::io {

/// Adds the changes of velocity of the answer that is shown of a transfer, m/s: by axis at both
/// ends, and their sum. `point_of` finds the transfer of a row; a transfer without an answer leaves
/// the columns empty.
template <class Row>
void add_answer_columns(Columns<Row>& columns, RelativeFrame frame,
                        const std::function<const TransferPoint&(const Row&)>& point_of) {
  const auto answer_of = [point_of](const Row& row) { return shown_answer(point_of(row)); };
  const auto has_answer = [answer_of](const Row& row) { return answer_of(row) != nullptr; };
  using Change = Eigen::Vector3d TransferAnswer::*;
  const auto add_change = [&](const char* end, Change change) {
    Eigen::Index i = 0;
    for (const std::string_view axis : axis_columns(frame)) {
      columns.add_if(has_answer, fmt::format("{}_change_{}_m_s", end, axis),
                     [=](const Row& row) { return (answer_of(row)->*change)[i]; });
      ++i;
    }
  };
  add_change("start", &TransferAnswer::start_change_m_s);
  add_change("end", &TransferAnswer::end_change_m_s);
  columns.add_if(has_answer, "total_change_m_s",
                 [=](const Row& row) { return answer_of(row)->total_change_m_s(); });
}

}  // namespace hamjet::io
