#include "../studies/stability/stability.hpp"
#include "tables/table_description.hpp"

// The table `[case]`, which `hamjet stability` reads and other commands only check.

namespace hamjet::io {
namespace {

const ValueForm decimals =
    form::words("array of numbers as texts of decimal digits", form::array(form::text()));

const TableDescription& condition_table() {
  static const TableDescription table = {
      {{"kind", form::text(), absent::refused(), "kind of the generating function"},
       {"value", form::positive(), absent::refused(), "the condition number of its linear part"}}};
  return table;
}

const TableDescription& growth_table() {
  static const GrowthExpectation preset;
  const auto not_compared = absent::other("not compared");
  static const TableDescription table = {
      {{"checkpoints", form::integer(3, 20), absent::value(preset.checkpoints),
        "times, in powers of two"},
       {"times", form::array(form::number()), absent::other("`checkpoints`"), "times of `states`"},
       {"states", decimals, not_compared, "the nominal at `times`"},
       {"samples", form::integer(1, 64), absent::value(preset.samples), "starts an ulp apart"},
       {"error_exponent", form::number(), not_compared, "exponent of the error's growth in time"},
       {"energy_exponent", form::number(), not_compared,
        "exponent of the growth of the energy's error"},
       {"coefficient_exponents", form::array(form::number()), not_compared,
        "exponents of the growth of the coefficients of each degree"},
       {"exponent_tolerance", form::positive(), absent::value(preset.exponent_tolerance),
        "largest difference"}}};
  return table;
}

const TableDescription& twin_table() {
  static const TableDescription table = {
      {{"set", form::words("array of `key=value`", form::array(form::text())), absent::refused(),
        "changes that give the same scene in another way, as with `--set`"}}};
  return table;
}

}  // namespace

const TableDescription& case_table() {
  const std::vector<std::string_view> measured = {"right", "marked"};
  const auto not_compared = absent::other("not compared");
  static const TableDescription table = {
      {{"group", form::text(), absent::refused(), "heading under which it is listed"},
       {"why", form::text(), absent::refused(), "what it is about"},
       {"outcome", form::choice({"right", "refused", "marked"}), absent::refused(),
        "what is right"},
       {"source", form::text(), absent::refused(), "where the reference comes from", measured},
       {"state", decimals, not_compared, "the final nominal", measured},
       {"matrix", decimals, not_compared,
        "first derivatives of the final by the initial state, by rows", measured},
       {"tolerance",
        form::words("number from 0", form::between(0, std::numeric_limits<double>::max())),
        absent::value(0), "tolerance of the errors", measured},
       {"twin", form::table(twin_table()), not_compared, "the same scene given in another way",
        measured},
       {"condition", form::table(condition_table()), not_compared, "a condition number", measured},
       {"growth", form::table(growth_table()), not_compared, "how errors grow", measured},
       {"round_trip", form::boolean(), absent::value(false), "out and back: the start is compared",
        measured},
       {"exit_code",
        form::integer(2, 6),
        absent::refused(),
        "exit code of the refusal",
        {"refused"}},
       {"message", form::text(), absent::refused(), "a part of the error", {"refused"}},
       {"mark",
        form::choice(self_check_names()),
        absent::refused(),
        "the self-check that must fail",
        {"marked"}}}};
  return table;
}

}  // namespace hamjet::io
