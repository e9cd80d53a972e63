#include "studies/descriptions/settings_fields.hpp"

#include <gtest/gtest.h>

#include <string>
#include <type_traits>
#include <vector>

#include "hamjet/studies/comparison.hpp"

namespace hamjet {
namespace {

void change(double& value) { value += 0.25; }
void change(std::string& value) { value += "x"; }
void change(bool& value) { value = !value; }
template <class Integer>
requires std::is_integral_v<Integer>
void change(Integer& value) { ++value; }
template <NamedEnumeration Enumeration>
void change(Enumeration& value) {
  const auto next = static_cast<std::size_t>(value) + 1;
  value = static_cast<Enumeration>(next % names_of(value).size());
}
void change(ZonalCoefficients& J) { J[ZonalCoefficients::highest] += 1e-9; }
template <class Value>
void change(std::vector<Value>& values) {
  values.push_back({});
}
template <class Value>
void change(std::optional<Value>& value) {
  value = value ? std::nullopt : std::optional<Value>(Value{});
}

/// A scene in which all candidates are few.
Scene scene_of_two() {
  Scene scene;
  scene.system.model = SystemModel::zonal_gravity;
  scene.system.J[2] = 1e-3;
  scene.canonical_radius = 1;
  scene.nominal = {1, 0, 0, 0, 1, 0.25};
  scene.duration = 3;
  scene.order = 2;
  scene.variables = {0, 1, 2, 3, 4, 5};
  scene.separation = 1e-3;
  scene.comparison.methods = {IntegrationMethod::gauss};
  scene.comparison.tolerances = {1e-3};
  scene.reference.emplace();
  scene.integrators.resize(1);
  scene.integrators[0].tolerance = 1e-9;
  scene.system.gravity_file.emplace();
  return scene;
}

struct Keys {
  std::string reference;
  std::string comparison;
};

Keys keys_of(const Scene& scene) {
  return {reference_key(scene, scene.order), comparison_key(scene)};
}

/// Changes every member of the settings in turn, which `of` takes from a scene, and hands the scene
/// on with the member's name.
template <class Of, class Check>
void for_each_change(const Of& of, const Check& check) {
  Scene counted = scene_of_two();
  std::size_t count = 0;
  for_each_field(of(counted), [&](std::string_view, auto&) { ++count; });
  for (std::size_t i = 0; i < count; ++i) {
    Scene scene = scene_of_two();
    std::size_t k = 0;
    std::string changed;
    for_each_field(of(scene), [&](std::string_view name, auto& member) {
      if (k++ != i) return;
      change(member);
      changed = name;
    });
    SCOPED_TRACE(changed);
    check(scene);
  }
}

TEST(SettingsFields, EachMemberChangesTheKeysThatItMustChange) {
  const Keys plain = keys_of(scene_of_two());
  const auto changes_both = [&](const Scene& scene) {
    EXPECT_NE(keys_of(scene).reference, plain.reference);
    EXPECT_NE(keys_of(scene).comparison, plain.comparison);
  };
  const auto changes_comparison = [&](const Scene& scene) {
    EXPECT_EQ(keys_of(scene).reference, plain.reference);
    EXPECT_NE(keys_of(scene).comparison, plain.comparison);
  };
  for_each_change(
      [](Scene & scene) -> auto& { return scene.system; }, changes_both);
  for_each_change(
      [](Scene & scene) -> auto& { return *scene.system.gravity_file; }, changes_both);
  for_each_change(
      [](Scene & scene) -> auto& { return *scene.reference; }, changes_both);
  for_each_change(
      [](Scene & scene) -> auto& { return scene.integrators[0]; }, changes_comparison);
  for_each_change(
      [](Scene & scene) -> auto& { return scene.comparison; }, changes_comparison);
  for_each_change(
      [](Scene & scene) -> auto& { return scene.units; }, changes_comparison);
}

TEST(SettingsFields, WhatElseDeterminesAReferenceIsInItsKey) {
  const Scene plain = scene_of_two();
  const auto differs = [&](const auto& modify) {
    Scene scene = plain;
    modify(scene);
    EXPECT_NE(keys_of(scene).reference, keys_of(plain).reference);
    EXPECT_NE(keys_of(scene).comparison, keys_of(plain).comparison);
  };
  differs([](Scene& scene) { scene.canonical_radius *= 2; });
  differs([](Scene& scene) { scene.nominal[5] = 0.125; });
  differs([](Scene& scene) { scene.duration = -3; });
  differs([](Scene& scene) { scene.order = 3; });
  differs([](Scene& scene) { scene.variables.pop_back(); });
}

TEST(SettingsFields, KeysNameEnumerators) {
  const Keys keys = keys_of(scene_of_two());
  EXPECT_NE(keys.reference.find("model zonal-gravity"), std::string::npos) << keys.reference;
  EXPECT_NE(keys.comparison.find("method gauss"), std::string::npos) << keys.comparison;
}

TEST(SettingsFields, ATitleChangesNoKey) {
  Scene scene = scene_of_two();
  const Keys plain = keys_of(scene);
  scene.title = "another";
  EXPECT_EQ(keys_of(scene).comparison, plain.comparison);
}

}  // namespace
}  // namespace hamjet
