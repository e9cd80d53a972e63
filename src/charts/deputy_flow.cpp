#include "hamjet/charts/deputy_flow.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "../integrators/integration_clock.hpp"
#include "hamjet/error.hpp"

namespace hamjet {

DeputyFlow::DeputyFlow(std::vector<Series<double>> polynomials, const SixNumbers<double>& chief_end)
    : polynomials_(std::move(polynomials)), chief_end_(chief_end) {
  if (variables() > widest || polynomials_.size() > widest) {
    throw Error(ErrorKind::usage, "deputy: more variables or values than a deputy has");
  }
  for (int degree = 1; degree <= order(); ++degree) evaluators_.emplace_back(polynomials_, degree);
}

void DeputyFlow::set_derivatives(Matrix<double> entry, Matrix<double> exit) {
  entry_derivative_ = std::move(entry);
  exit_derivative_ = std::move(exit);
}

void DeputyFlow::predict(std::span<const SixNumbers<double>> initial, int degree,
                         std::span<DeputyPrediction> predictions) const {
  DeputyPredictor(*this).predict(initial, degree, predictions);
}

DeputyPrediction DeputyFlow::predict(const SixNumbers<double>& initial, int degree) const {
  return DeputyPredictor(*this).predict(initial, degree);
}

DeputyPrediction DeputyPredictor::predict(const SixNumbers<double>& initial, int degree) {
  DeputyPrediction prediction;
  predict(std::span(&initial, 1), degree, std::span(&prediction, 1));
  return prediction;
}

std::vector<double> DeputyPredictor::variables(const SixNumbers<double>& initial) {
  std::vector<double> result(flow_.variables());
  SixNumbers<double> carried;
  passage_->enter(std::span(&initial, 1), result, std::span(&carried, 1));
  return result;
}

SixNumbers<double> DeputyPredictor::leave(const SixNumbers<double>& initial,
                                          std::span<const double> values) {
  if (values.size() != flow_.polynomials().size()) {
    throw Error(ErrorKind::usage, "deputy: as many values as polynomials are needed");
  }
  std::vector<double> entered(flow_.variables());
  SixNumbers<double> carried;
  SixNumbers<double> final;
  passage_->enter(std::span(&initial, 1), entered, std::span(&carried, 1));
  passage_->leave(std::span(&carried, 1), values, std::span(&final, 1));
  return final;
}

void DeputyPredictor::predict(std::span<const SixNumbers<double>> initial,
                              std::span<const int> degrees,
                              std::span<DeputyPrediction> predictions) {
  for (const int degree : degrees) {
    if (degree < 1 || degree > flow_.order()) {
      throw Error(ErrorKind::usage, "deputy: the polynomials have not that degree");
    }
  }
  if (initial.size() * degrees.size() != predictions.size()) {
    throw Error(ErrorKind::usage, "deputy: as many predictions as deviations are needed");
  }
  constexpr std::size_t block = DeputyFlow::block;
  const std::size_t width = flow_.variables();
  const std::size_t values = flow_.polynomials().size();
  std::array<SixNumbers<double>, DeputyFlow::widest> exit{};  // the columns of the derivative
  for (std::size_t c = 0; c < values; ++c) {
    for (std::size_t i = 0; i < 6; ++i) {
      exit[c][i] =
          flow_.exit_derivative()(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c));
    }
  }
  std::array<double, DeputyFlow::widest * block> numbers;
  std::array<SixNumbers<double>, block> finals;
  carried_.resize(std::min(most_at_once, initial.size()));
  for (std::size_t first = 0; first < initial.size(); first += most_at_once) {
    const std::size_t count = std::min(most_at_once, initial.size() - first);
    count_ = count;
    points_.resize(count * width);
    for (auto& result : results_) result.resize(count * values);
    for (std::size_t j = 0; j < count; j += block) {
      const std::size_t some = std::min(block, count - j);
      passage_->enter(initial.subspan(first + j, some), std::span(numbers).first(some * width),
                      std::span(carried_).subspan(j, some));
      for (std::size_t k = 0; k < some; ++k) {
        for (std::size_t i = 0; i < width; ++i) points_[i * count + j + k] = numbers[k * width + i];
      }
    }
    for (std::size_t d = 0; d < degrees.size(); ++d) {
      const auto degree = static_cast<std::size_t>(degrees[d]);
      const IntegrationClock clock;
      const MapEvaluator& evaluator = flow_.evaluators_[degree - 1];
      evaluator.evaluate(points_, {results_[0], results_[1], results_[2], results_[3]});
      // Degree 0 is the chief itself, from which deviations are counted.
      for (std::size_t h = degree; h < 3; ++h) {
        std::fill(results_[h + 1].begin(), results_[h + 1].end(), 0);
      }
      polynomial_seconds_ += clock.seconds();
      multiply_adds_ += static_cast<double>(count * evaluator.multiply_adds_per_point());
      const auto found = predictions.subspan(d * initial.size() + first, count);
      for (std::size_t j = 0; j < count; j += block) {
        const std::size_t some = std::min(block, count - j);
        for (std::size_t k = 0; k < some; ++k) {
          for (std::size_t c = 0; c < values; ++c) {
            numbers[k * values + c] = results_[0][c * count + j + k];
          }
        }
        passage_->leave(std::span(carried_).subspan(j, some),
                        std::span(numbers).first(some * values), std::span(finals).first(some));
        for (std::size_t k = 0; k < some; ++k) {
          DeputyPrediction& prediction = found[j + k];
          prediction = {finals[k], {}};
          for (std::size_t h = 0; h < prediction.highest.size(); ++h) {
            for (std::size_t c = 0; c < values; ++c) {
              const double share = results_[h + 1][c * count + j + k];
              for (std::size_t i = 0; i < 6; ++i) prediction.highest[h][i] += exit[c][i] * share;
            }
          }
        }
      }
    }
  }
}

void DeputyPredictor::predict_lower(std::span<const std::size_t> deputies,
                                    std::span<std::array<SixNumbers<double>, 3>> lower) {
  constexpr std::size_t block = DeputyFlow::block;
  const std::size_t values = flow_.polynomials().size();
  std::array<double, DeputyFlow::widest * block> numbers;
  std::array<SixNumbers<double>, block> carried;
  std::array<SixNumbers<double>, block> finals;
  for (std::size_t j = 0; j < deputies.size(); j += block) {
    const std::size_t some = std::min(block, deputies.size() - j);
    for (std::size_t k = 0; k < some; ++k) carried[k] = carried_[deputies[j + k]];
    // The shares of the highest degrees are taken off the values, which contain all degrees.
    for (std::size_t h = 0; h < lower[j].size(); ++h) {
      for (std::size_t k = 0; k < some; ++k) {
        for (std::size_t c = 0; c < values; ++c) {
          const std::size_t place = c * count_ + deputies[j + k];
          double& number = numbers[k * values + c];
          if (h == 0) number = results_[0][place];
          number -= results_[h + 1][place];
        }
      }
      passage_->leave(std::span(carried).first(some), std::span(numbers).first(some * values),
                      std::span(finals).first(some));
      for (std::size_t k = 0; k < some; ++k) lower[j + k][h] = finals[k];
    }
  }
}

namespace {

SixNumbers<double> end_of(const FlowMap<double>& jet, std::size_t parameters) {
  if (jet.components() < 6 || jet.variables() != 6 + parameters) {
    throw Error(ErrorKind::usage,
                "deputy: a jet of six components in six variables, and in one for each parameter "
                "of the deputy, is needed");
  }
  SixNumbers<double> end;
  for (std::size_t i = 0; i < 6; ++i) end[i] = jet.jet()[i][0];
  return end;
}

/// The polynomials of positions and momenta, without those of parameters, which stay.
std::vector<Series<double>> phase_space_part(const FlowMap<double>& jet) {
  std::vector<Series<double>> part = without_constants(jet.jet());
  part.erase(part.begin() + 6, part.end());
  return part;
}

class CartesianDeputyFlow : public DeputyFlow {
 public:
  CartesianDeputyFlow(const FlowMap<double>& jet, std::span<const double> parameters)
      : DeputyFlow(phase_space_part(jet), end_of(jet, parameters.size())),
        parameters_(parameters.begin(), parameters.end()) {
    const auto width = static_cast<Eigen::Index>(variables());
    set_derivatives(Matrix<double>::Identity(width, 6), Matrix<double>::Identity(6, 6));
  }

 private:
  struct Through : Passage {
    explicit Through(std::span<const double> parameters) : parameters_(parameters) {}
    void enter(std::span<const SixNumbers<double>> deviations, std::span<double> variables,
               std::span<SixNumbers<double>>) override {
      auto out = variables.begin();
      for (const SixNumbers<double>& deviation : deviations) {
        out = std::copy(deviation.begin(), deviation.end(), out);
        out = std::copy(parameters_.begin(), parameters_.end(), out);
      }
    }
    void leave(std::span<const SixNumbers<double>>, std::span<const double> values,
               std::span<SixNumbers<double>> deviations) override {
      for (std::size_t k = 0; k < deviations.size(); ++k) {
        std::copy_n(values.begin() + 6 * static_cast<long>(k), 6, deviations[k].begin());
      }
    }
    std::span<const double> parameters_;
  };
  std::unique_ptr<Passage> passage() const override {
    return std::make_unique<Through>(parameters_);
  }

  std::vector<double> parameters_;
};

}  // namespace

std::unique_ptr<DeputyFlow> cartesian_deputy_flow(const FlowMap<double>& jet,
                                                  std::span<const double> parameters) {
  return std::make_unique<CartesianDeputyFlow>(jet, parameters);
}

}  // namespace hamjet
