#include "periodic_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <complex>

#include "../../store/json_text.hpp"
#include "../../store/result_table.hpp"
#include "../../studies/bounded/scene_gauss.hpp"
#include "../../text/quantity_text.hpp"
#include "../../text/terminal_text.hpp"
#include "../drawing/report_page.hpp"
#include "../formation/transfer_json.hpp"
#include "../own_units_text.hpp"
#include "hamjet/error.hpp"

namespace hamjet::io {
namespace {

using Json = nlohmann::ordered_json;
using Complex = std::complex<double>;

const PeriodicFamilySettings* family_of(const PeriodicStudy& study) {
  const auto& family = study.scene.periodic->family;
  return family ? &*family : nullptr;
}

double told_energy(const PeriodicStudy& study, const FamilyMember& member) {
  return member.orbit.energy * study.told_factor({OrbitQuantity::Kind::energy});
}
double told_along(const PeriodicStudy& study, const FamilyMember& member) {
  return member.along * study.told_factor(orbit_quantity(study.scene, family_of(study)->along));
}

std::string index_text(const Complex& index) {
  if (index.imag() == 0) return fmt::format("{:.8g}", index.real());
  return fmt::format("{:.6g}{:+.6g}i", index.real(), index.imag());
}

std::size_t index_count(const PeriodicStudy& study) {
  return study.family.members.empty() ? study.scene.nominal.size() / 2 - 1
                                      : study.family.members.front().orbit.monodromy.indices.size();
}

std::vector<std::vector<std::string>> member_rows(const PeriodicStudy& study) {
  const PeriodicFamilySettings* const family = family_of(study);
  std::vector<std::vector<std::string>> rows = {{"orbit"}};
  std::vector<std::string>& head = rows.front();
  if (family != nullptr) head.push_back(family->along);
  for (const char* const name : {"period", "energy"}) {
    if (family == nullptr || family->along != name) head.emplace_back(name);
  }
  for (std::size_t i = 0; i < index_count(study); ++i) {
    head.push_back(fmt::format("index {}", i + 1));
  }
  head.emplace_back("closing");
  for (std::size_t k = 0; k < study.family.members.size(); ++k) {
    const FamilyMember& member = study.family.members[k];
    std::vector<std::string>& row = rows.emplace_back(1, fmt::format("{}", k + 1));
    if (family != nullptr) row.push_back(fmt::format("{:.10g}", told_along(study, member)));
    if (family == nullptr || family->along != "period") {
      row.push_back(fmt::format("{:.10g}", told_time(study.scene, member.orbit.nodes.period)));
    }
    if (family == nullptr || family->along != "energy") {
      row.push_back(fmt::format("{:.10g}", told_energy(study, member)));
    }
    for (const Complex& index : member.orbit.monodromy.indices) row.push_back(index_text(index));
    row.push_back(fmt::format("{:.1e}", member.orbit.closing));
  }
  return rows;
}

/// A line for each place with marks.
std::vector<std::string> mark_lines(const PeriodicStudy& study) {
  std::vector<std::string> lines;
  for (std::size_t k = 1; k < study.family.members.size(); ++k) {
    const std::string& mark = study.family.members[k].mark;
    if (!mark.empty()) lines.push_back(fmt::format("between {} and {}: {}", k, k + 1, mark));
  }
  return lines;
}

Chart orbit_chart(const PeriodicStudy& study) {
  const std::vector<std::string_view> names = variable_names(study.scene.system);
  Chart chart;
  chart.name = "periodic-orbits";
  chart.title = study.paths.size() > 1 ? "Orbits of the family" : "The orbit";
  chart.reading =
      study.paths.size() > 1
          ? "The first two coordinates along a turn of some members, the first and the last of the "
            "family among them; with one degree of freedom, the coordinate and its momentum. In "
            "canonical units."
          : "The first two coordinates along a turn; with one degree of freedom, the coordinate "
            "and "
            "its momentum. In canonical units.";
  chart.x.label = std::string(names[0]);
  chart.y.label = std::string(names[1]);
  chart.is_isometric = names.size() > 2;
  for (std::size_t k = 0; k < study.paths.size(); ++k) {
    ChartCurve curve = unmarked_line(fmt::format("orbit {}", study.paths[k].member + 1), k);
    curve.points = study.paths[k].points;
    chart.curves.push_back(std::move(curve));
  }
  fit(chart);
  return chart;
}

std::string periodic_page(const PeriodicStudy& study, const ReportOrigin& origin,
                          ChartDrawer& drawer) {
  ReportPage page;
  page.title = study.scene.title + ": periodic orbits";
  page.verdict = periodic_verdict(study);
  page.first_figure = figure_html(orbit_chart(study), drawer);
  page.facts = origin_facts_html(origin) + fact_html("Scene", study.scene.name) +
               fact_html("Held", study.scene.periodic->hold) +
               fact_html("Arcs", fmt::format("{}", study.scene.periodic->arcs));
  page.sections = "<section>\n<h2>Orbits</h2>\n" +
                  table_html(
                      "Period and energy are canonical; an index is (l + 1/l)/2 of a "
                      "multiplier l.",
                      member_rows(study)) +
                  "</section>\n";
  return page_html(page, drawer);
}

std::vector<std::string> numbered(std::string_view name, std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.push_back(fmt::format("{}_{}", name, i + 1));
  return names;
}

std::vector<double> parts_of(const std::vector<Complex>& numbers, double (*part)(const Complex&)) {
  std::vector<double> parts;
  for (const Complex& number : numbers) parts.push_back(part(number));
  return parts;
}
double real_part(const Complex& number) { return number.real(); }
double imaginary_part(const Complex& number) { return number.imag(); }

}  // namespace

std::string periodic_verdict(const PeriodicStudy& study) {
  const std::vector<FamilyMember>& members = study.family.members;
  if (members.empty()) return "";
  const PeriodicFamilySettings* const family = family_of(study);
  const double time_s = study.scene.units.time_s;
  if (family == nullptr) {
    const PeriodicOrbit& orbit = members.front().orbit;
    std::string text = fmt::format(
        "A periodic orbit of period {:.12g}, which is {:.8g} s{}, and energy {:.12g} closes to "
        "{:.1e} of "
        "its size; it is {}",
        told_time(study.scene, orbit.nodes.period), orbit.nodes.period * time_s,
        days_behind(orbit.nodes.period * time_s), told_energy(study, members.front()),
        orbit.closing, orbit.monodromy.is_stable() ? "linearly stable" : "unstable");
    for (std::size_t i = 0; i < orbit.monodromy.indices.size(); ++i) {
      text += fmt::format("{} {}", i == 0 ? ", with the stability indices" : " and",
                          index_text(orbit.monodromy.indices[i]));
    }
    return text + ".";
  }
  const auto marks =
      std::ranges::count_if(members, [](const FamilyMember& one) { return !one.mark.empty(); });
  return fmt::format(
      "{} with {} from {:.10g} to {:.10g}, periods from {:.8g} to {:.8g}; {} between them.{}",
      counted(members.size(), "periodic orbit"), family->along, told_along(study, members.front()),
      told_along(study, members.back()), told_time(study.scene, members.front().orbit.nodes.period),
      told_time(study.scene, members.back().orbit.nodes.period),
      marks == 0 ? "no fold or bifurcation"
                 : counted(marks, "place") + " with folds or bifurcations",
      study.family.end.empty() ? ""
                               : " The family does not reach its end: " + study.family.end + ".");
}

std::vector<TableView> periodic_tables(const PeriodicStudy& study) {
  const PeriodicSettings& settings = *study.scene.periodic;
  ResultTable<FamilyMember> table(
      "periodic", "", {"orbits"},
      "A periodic orbit, or a family of them. Canonical numbers are in the scene's units; what is "
      "in parts of the orbit's size is so for positions and for momenta.");
  table.add_scalar("verdict", "", "the outcome in words", periodic_verdict(study));
  table.add_scalar("hold", "", "the quantity that picks the first orbit", settings.hold);
  table
      .add_scalar("along", "", "what the family runs along; nothing for one orbit",
                  settings.family ? settings.family->along : std::string())
      .may_lack = true;
  table
      .add_scalar("end", "", "why the family does not reach its end; nothing where it does",
                  study.family.end)
      .may_lack = true;
  table.add_if([&](const FamilyMember&) { return settings.family.has_value(); }, "along_value", "",
               "the value of what the family runs along, canonical",
               [&](const FamilyMember& one) { return told_along(study, one); });
  table.add(
      "period_canonical", "", "the period of one turn, canonical",
      [&](const FamilyMember& one) { return told_time(study.scene, one.orbit.nodes.period); });
  table.add("period_s", "s", "the period of one turn", [&](const FamilyMember& one) {
    return one.orbit.nodes.period * study.scene.units.time_s;
  });
  table.add("energy", "", "the Hamiltonian, canonical",
            [&](const FamilyMember& one) { return told_energy(study, one); });
  table.add("jacobi_constant", "",
            "-2 times the energy, which Jacobi's constant is in a restricted problem of bodies",
            [&](const FamilyMember& one) { return -2 * told_energy(study, one); });
  std::vector<std::string> variables;
  for (const std::string_view name : variable_names(study.scene.system)) {
    variables.push_back(fmt::format("start_{}", name));
  }
  table.add_array("start", variables, "", "the start (q, p), canonical",
                  [&](const FamilyMember& one) {
                    const Vector<double>& start = one.orbit.start();
                    return told_state(study.scene, {start.begin(), start.end()});
                  });
  table.add("closing", "",
            "by how much one flight from the start over the period fails to close, in parts of the "
            "orbit's size",
            [](const FamilyMember& one) { return one.orbit.closing; });
  table.add("mismatch", "",
            "the largest mismatch of the arcs of the search, in parts of the orbit's size",
            [](const FamilyMember& one) { return one.orbit.mismatch; });
  table.add("newton_steps", "", "the number of Newton steps of the search",
            [](const FamilyMember& one) { return one.orbit.iterations; });
  const std::size_t indices = index_count(study);
  if (indices > 0) {
    const auto add = [&](std::string_view name, std::string_view stem, std::string meaning,
                         std::vector<Complex> Monodromy::*numbers, double (*part)(const Complex&)) {
      table.add_array(std::string(name), numbered(stem, indices), "", std::move(meaning),
                      [numbers, part](const FamilyMember& one) {
                        return parts_of(one.orbit.monodromy.*numbers, part);
                      });
    };
    add("stability_indices", "stability_index",
        "(l + 1/l)/2 of the multipliers l but the pair 1; stable between -1 and 1",
        &Monodromy::indices, &real_part);
    add("stability_indices_imag", "stability_index_imag",
        "the imaginary parts of the stability indices", &Monodromy::indices, &imaginary_part);
    add("multipliers", "multiplier", "the multiplier on or outside the unit circle of each index",
        &Monodromy::multipliers, &real_part);
    add("multipliers_imag", "multiplier_imag", "the imaginary parts of these multipliers",
        &Monodromy::multipliers, &imaginary_part);
  }
  table.add("stable", "", "whether all multipliers lie on the unit circle",
            [](const FamilyMember& one) { return one.orbit.monodromy.is_stable(); });
  table.add("trivial_defect", "",
            "by how much the flow's direction and the energy's gradient fail to have the "
            "multiplier 1",
            [](const FamilyMember& one) { return one.orbit.monodromy.trivial_defect; });
  table.add("determinant_defect", "",
            "by how much the determinant of the monodromy matrix differs from 1",
            [](const FamilyMember& one) { return one.orbit.monodromy.determinant_defect; });
  table.add("symplectic_defect", "", "the largest entry of M^T J M - J of the monodromy matrix M",
            [](const FamilyMember& one) { return one.orbit.monodromy.symplectic_defect; });
  table
      .add("marks", "", "folds and bifurcations between the orbit before and this one",
           &FamilyMember::mark)
      .may_lack = true;
  return {std::move(table).view(study.family.members, {study.family.members.size()})};
}

StudyReport periodic_report(const PeriodicStudy& study, const ReportOrigin& origin) {
  StudyReport report;
  if (study.family.is_failure) {
    report.exit_code = static_cast<int>(ErrorKind::numerical);
    report.failure = "periodic.family: " + study.family.end;
  }
  const TableView table = periodic_tables(study).front();
  Json json = study_head_json(study.scene, "periodic", scene_gauss_label(study.scene));
  json.update(table_json(table));
  json["exit_code"] = report.exit_code;
  ChartDrawer drawer(origin.gnuplot);
  report.files = {{"periodic.csv", table_csv(table)},
                  {"report.html", periodic_page(study, origin, drawer)},
                  {"summary.json", json_text(json) + "\n"}};
  report.drawing_problem = drawer.problem();
  report.table = fmt::format("{}\n{}\n{}\n", study.scene.title, periodic_verdict(study),
                             own_mass_line(study.scene)) +
                 aligned_table(member_rows(study));
  for (const std::string& line : mark_lines(study)) report.table += line + "\n";
  return report;
}

}  // namespace hamjet::io
