#include "uncertainty_arrays.hpp"

#include <algorithm>
#include <limits>

#include "uncertainty_view.hpp"

namespace hamjet::io {
namespace {

std::vector<double> numbers_of(const Matrix<double>& matrix) {
  std::vector<double> numbers;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) numbers.push_back(matrix(i, j));
  }
  return numbers;
}

/// Puts one array behind another of the same name, or begins it.
class GrowingArrays {
 public:
  GrowingArrays(std::string prefix, std::vector<std::size_t> outer)
      : prefix_(std::move(prefix)), outer_(std::move(outer)) {}

  void add(const std::vector<NumberArray>& arrays) {
    if (all_.empty()) {
      for (const NumberArray& array : arrays) {
        NumberArray begun{prefix_ + array.name, outer_, {}};
        begun.shape.insert(begun.shape.end(), array.shape.begin(), array.shape.end());
        all_.push_back(std::move(begun));
      }
    }
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      all_[i].numbers.insert(all_[i].numbers.end(), arrays[i].numbers.begin(),
                             arrays[i].numbers.end());
    }
  }

  std::vector<NumberArray> take() && { return std::move(all_); }

 private:
  std::string prefix_;
  std::vector<std::size_t> outer_;
  std::vector<NumberArray> all_;
};

/// The same arrays without numbers.
std::vector<NumberArray> no_moments() {
  std::vector<NumberArray> arrays = moments_arrays(Cumulants(Vector<double>::Zero(6), {}));
  for (NumberArray& array : arrays) {
    std::fill(array.numbers.begin(), array.numbers.end(), std::numeric_limits<double>::quiet_NaN());
  }
  return arrays;
}

std::vector<NumberArray> scatter_arrays(const std::optional<FlownMoments>& flown) {
  const Vector<double> none = Vector<double>::Constant(6, std::numeric_limits<double>::quiet_NaN());
  return {{"mean_scatter", {6}, numbers_of(flown ? flown->mean_error : none)},
          {"standard_deviation_scatter", {6}, numbers_of(flown ? flown->deviation_error : none)},
          {"skewness_scatter", {6}, numbers_of(flown ? flown->skewness_error : none)},
          {"excess_kurtosis_scatter", {6}, numbers_of(flown ? flown->kurtosis_error : none)}};
}

}  // namespace

std::vector<NumberArray> moments_arrays(const Cumulants& moments) {
  const auto m = static_cast<std::size_t>(moments.size());
  return {{"mean", {m}, numbers_of(moments.mean())},
          {"standard_deviation", {m}, numbers_of(moments.standard_deviations())},
          {"skewness", {m}, numbers_of(moments.skewness())},
          {"excess_kurtosis", {m}, numbers_of(moments.excess_kurtosis())},
          {"covariance", {m, m}, numbers_of(moments.covariance())},
          {"mardia_skewness", {}, {moments.mardia_skewness()}},
          {"mardia_excess_kurtosis", {}, {moments.mardia_excess_kurtosis()}},
          {"negentropy", {}, {moments.negentropy()}}};
}

std::vector<NumberArray> uncertainty_arrays(const UncertaintyResult& result) {
  const std::size_t times = result.points.size();
  const std::size_t states = result.points.front().states.size();
  const auto orders = static_cast<std::size_t>(result.scene.order);
  NumberArray seconds{"times_s", {times}, {}};
  NumberArray error{"linear_error_of_probability", {times, states}, {}};
  GrowingArrays cartesian("", {times, states, orders});
  GrowingArrays charted("charted_", {times, states, orders});
  GrowingArrays flown("flown_", {times, states});
  GrowingArrays scatter("flown_", {times, states});
  for (const UncertaintyAt& at : result.points) {
    seconds.numbers.push_back(at.time * result.scene.units.time_s);
    for (const UncertainState& state : at.states) {
      error.numbers.push_back(result.scene.order == 1
                                  ? std::numeric_limits<double>::quiet_NaN()
                                  : linear_error_of_probability(state.cartesian));
      for (std::size_t n = 0; n < orders; ++n) {
        cartesian.add(moments_arrays(state.cartesian[n]));
        charted.add(state.charted.empty() ? no_moments() : moments_arrays(state.charted[n]));
      }
      flown.add(state.flown ? moments_arrays(state.flown->cumulants) : no_moments());
      scatter.add(scatter_arrays(state.flown));
    }
  }
  std::vector<NumberArray> all = {std::move(seconds), std::move(error)};
  for (GrowingArrays* arrays : {&cartesian, &charted, &flown, &scatter}) {
    for (NumberArray& array : std::move(*arrays).take()) all.push_back(std::move(array));
  }
  return all;
}

}  // namespace hamjet::io
