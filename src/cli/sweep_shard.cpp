#include "sweep_shard.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "../sweep/sweep_study.hpp"
#include "../text/scene_message.hpp"
#include "../text/whole_number.hpp"
#include "hamjet/error.hpp"

namespace hamjet::cli {

std::vector<std::size_t> Shard::items(std::size_t count) const {
  std::vector<std::size_t> result;
  for (std::size_t i = part - 1; i < count; i += parts) result.push_back(i);
  return result;
}

Shard parse_shard(const std::string& text) {
  const std::size_t slash = std::min(text.find('/'), text.size());
  const auto part = io::whole_number<std::size_t>(text.substr(0, slash));
  const auto parts =
      slash < text.size() ? io::whole_number<std::size_t>(text.substr(slash + 1)) : std::nullopt;
  if (!part || !parts || *part < 1 || *part > *parts || *parts > io::most_sweep_items) {
    throw Error(ErrorKind::usage,
                fmt::format("--shard {}: must be k/n, the part k of n from 1/n to n/n",
                            io::printable(text)));
  }
  return {*part, *parts};
}

std::optional<Shard> slurm_shard(const std::function<const char*(const char*)>& environment) {
  const char* id_text = environment("SLURM_ARRAY_TASK_ID");
  if (id_text == nullptr) return std::nullopt;
  const auto variable = [&](const char* name, std::optional<std::size_t> otherwise) {
    const char* text = environment(name);
    return text == nullptr ? otherwise : io::whole_number<std::size_t>(text);
  };
  const auto id = io::whole_number<std::size_t>(id_text);
  const auto count = variable("SLURM_ARRAY_TASK_COUNT", std::nullopt);
  const auto least = variable("SLURM_ARRAY_TASK_MIN", 1);
  const auto most = variable("SLURM_ARRAY_TASK_MAX", std::nullopt);
  const auto step = variable("SLURM_ARRAY_TASK_STEP", 1);
  const bool is_known = id && count && least && step && *step > 0 && *id >= *least;
  const bool is_even = is_known && (*id - *least) % *step == 0 && (*id - *least) / *step < *count &&
                       (!most || *most == *least + (*count - 1) * *step);
  if (!is_even) {
    throw Error(ErrorKind::usage,
                fmt::format("SLURM_ARRAY_TASK_ID: is {}, but which part of how many that is cannot "
                            "be told from SLURM_ARRAY_TASK_COUNT, _MIN, _MAX and _STEP; --shard "
                            "k/n says it",
                            io::in_quotes(id_text)));
  }
  return Shard{(*id - *least) / *step + 1, *count};
}

}  // namespace hamjet::cli
