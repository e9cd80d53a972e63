#include <fmt/format.h>

#include <algorithm>

#include "scene_relative_motion.hpp"

namespace hamjet::io {
namespace {

constexpr int fewest_path_samples = 100;
constexpr int most_path_samples = 10000000;
/// With more deputies the pairs would take minutes.
constexpr std::size_t most_safe_deputies = 20;

const TableDescription& safe_deputy_table() {
  static const TableDescription table = {
      relative_state_keys(),
      "A further deputy, in the frame of `[deputy]` and as uncertain as that; it does not burn."};
  return table;
}

std::vector<double> read_burn_shares(const TableReader& safety) {
  const std::vector<double> shares = safety.numbers("burn_shares");
  if (shares.empty()) {
    safety.fail("burn_shares", "no share, got an empty array, must be numbers from 0 to 1");
  }
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const bool is_new = std::find(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(i),
                                  shares[i]) == shares.begin() + static_cast<std::ptrdiff_t>(i);
    if (!(shares[i] >= 0 && shares[i] <= 1) || !is_new) {
      safety.fail_element(
          "burn_shares", i,
          fmt::format("out of range, or twice, got {}, must be a number from 0 to 1 "
                      "that is there once",
                      shares[i]));
    }
  }
  return shares;
}

}  // namespace

const TableDescription& safety_table() {
  static const SafetyWatch preset;
  static const TableDescription table = {
      {{"keep_apart_m", form::positive(), absent::refused(),
        "the separation that every pair is to keep"},
       window_key(),
       {"keep_out_m", form::array(form::positive(), 3), absent::other("none"),
        "semi-axes along the chief's R, T, N of an ellipsoid about it: how large deviations may be "
        "for it to stay free"},
       {"burn_shares", form::words("array of numbers from 0 to 1", form::array(form::number())),
        absent::other("[0, 1]"),
        "how much of the burn of `[uncertainty.burn]` is done, each a case: 0 not at all, 1 with "
        "its errors"},
       {"share", form::between(0.5, 0.9999), absent::value(preset.share),
        "share of all cases whose least separation is given"},
       {"samples", form::integer(fewest_path_samples, most_path_samples),
        absent::value(preset.samples),
        "number of samples of the polynomials, for each pair and each share of the burn"},
       {"confidence", form::between(0.5, 0.999999), absent::value(preset.confidence),
        "confidence of the intervals that are given"},
       {"least_separation_m", form::positive(), absent::other("not checked"),
        "a check of every pair: the separation that `share` of all cases must keep, by the lower "
        "end of its interval; exit code 1 where one does not"},
       {"least_deviations", form::positive(), absent::other("not checked"),
        "a check of every pair that `keep_out_m` is told of: the standard deviations up to which "
        "the ellipsoid must stay free; exit code 1 where it does not"},
       {"deputy",
        form::words(fmt::format("up to {} tables", most_safe_deputies),
                    form::array(form::table(safe_deputy_table()))),
        absent::other("none"), "further spacecraft of the formation"}},
      "How near the spacecraft of each pair of a formation come to each other if a burn fails."};
  return table;
}

SafetyWatch read_safety(const TableReader& safety, const Scene& scene, const Nominal& nominal,
                        bool has_burn) {
  safety.check_keys();
  SafetyWatch watch;
  const auto window = read_window(safety, scene, false);
  watch.from = window[0];
  watch.to = window[1];
  watch.keep_apart_m = read_nearness(safety, "keep_apart_m", scene);
  if (safety.has("keep_out_m")) {
    const std::vector<double> axes = safety.positive_numbers("keep_out_m", 3);
    watch.keep_out_m = Eigen::Vector3d(axes[0], axes[1], axes[2]);
  }
  if (safety.has("burn_shares")) {
    if (!has_burn) {
      safety.fail("burn_shares",
                  "there is no burn, got shares, must have a table [uncertainty.burn]");
    }
    watch.burn_shares = read_burn_shares(safety);
  } else if (!has_burn) {
    watch.burn_shares = {1};
  }
  safety.read_if_any("share", watch.share);
  safety.read_if_any("samples", watch.samples);
  safety.read_if_any("confidence", watch.confidence);
  if (safety.has("least_separation_m")) {
    watch.least_separation_m = read_nearness(safety, "least_separation_m", scene);
  }
  if (safety.has("least_deviations")) {
    if (!watch.keep_out_m) {
      safety.fail("least_deviations",
                  "there is no ellipsoid, got a number without the key keep_out_m, must have one");
    }
    watch.least_deviations = safety.positive_number("least_deviations");
  }
  const std::vector<TableReader> deputies =
      safety.has("deputy") ? safety.tables("deputy") : std::vector<TableReader>();
  if (deputies.size() > most_safe_deputies) {
    safety.fail("deputy", fmt::format("too many, got {} tables, must be at most {}",
                                      deputies.size(), most_safe_deputies));
  }
  for (const TableReader& deputy : deputies) {
    deputy.check_keys({safe_deputy_table().names(),
                       {"frame", "derivatives"},
                       "a further deputy, which is in the frame of the table [deputy],"});
    watch.deputies.push_back(read_relative_state(deputy, nominal, scene.deputy->frame));
  }
  return watch;
}

}  // namespace hamjet::io
