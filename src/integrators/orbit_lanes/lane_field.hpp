#pragma once

#include <cstddef>
#include <vector>

#include "hamjet/detail/dynamics/slice_evaluator.hpp"
#include "hamjet/dynamics/dynamical_system.hpp"
#include "orbits.hpp"

namespace hamjet {

/// The slopes g of orbits side by side at the stages of their steps, and their derivatives by the m
/// inputs of the evaluated list. The number of stage i and component c stands at c s + i.
class LaneField {
 public:
  LaneField(const DynamicalSystem& system, std::size_t stages, int order)
      : stages_(stages),
        inputs_(system.evaluated_list().variables()),
        list_(system.evaluated_list()),
        half_(list_, SeriesSpace::create(inputs_, 0), 0),
        whole_(list_, SeriesSpace::create(inputs_, 0), 0),
        point_(list_, SeriesSpace::create(inputs_, order), order) {
    for (std::size_t c = 0; c < inputs_ && order >= 2; ++c) {
      const SeriesSpace& space = *(space_ = SeriesSpace::create(inputs_, order));
      point_.input(c)[space.linear_index(c)] = Orbits(1.0);
    }
  }

  /// Sets the times of the system's clock at the stages, time(i); nothing is done for a system
  /// without time.
  template <class Time>
  void set_stage_times(const Time& time) {
    if (!point_.has_time()) return;
    const std::size_t count = point_.numbers();
    numbers_.resize(count * stages_);
    for (std::size_t i = 0; i < stages_; ++i) {
      point_.set_time(time(i));
      for (std::size_t k = 0; k < count; ++k) numbers_[k * stages_ + i] = point_.number(k);
    }
  }

  /// Sets the slopes at all stages.
  void evaluate(const std::vector<Orbits>& places, std::vector<Orbits>& slopes) {
    std::size_t first = 0;
    while (first < stages_) {
      if (stages_ - first > half) {
        put(places, first, whole_);
        whole_.evaluate_constant_values();
        take_slopes(whole_, first, slopes);
        first += 2 * half;
      } else {
        put(places, first, half_);
        half_.evaluate_constant_values();
        take_slopes(half_, first, slopes);
        first += half;
      }
    }
  }

  /// Sets the slopes, and d g_c / d Y_k, which stands at (c m + k) s + i.
  void evaluate(const std::vector<Orbits>& places, std::vector<Orbits>& slopes,
                std::vector<Orbits>& gradients) {
    for (std::size_t first = 0; first < stages_; first += half) {
      put(places, first, half_);
      half_.evaluate_constant_terms();
      take_slopes(half_, first, slopes);
      for (std::size_t c = 0; c < inputs_; ++c) {
        for (std::size_t k = 0; k < inputs_; ++k) {
          take(half_.output_gradient(c, k), first, &gradients[(c * inputs_ + k) * stages_]);
        }
      }
    }
  }

  /// Sets the slopes at one point, whose component c is `place(c)`, at a time of the system's
  /// clock.
  template <class Place>
  void evaluate_at(const Orbits& time, const Place& place, std::vector<Orbits>& slopes) {
    point_.set_time(time);
    for (std::size_t c = 0; c < inputs_; ++c) point_.input(c)[0] = place(c);
    point_.evaluate_constant_values();
    for (std::size_t c = 0; c < inputs_; ++c) slopes[c] = point_.output(c)[0];
  }
  /// ComponentUnits::row_norm of Dg at the last evaluated point.
  Orbits gradient_norm(const ComponentUnits& units) {
    point_.evaluate_constant_terms();
    const auto entry = [this](std::size_t c, std::size_t k) {
      return point_.output_gradient(c, k);
    };
    return units.row_norm(entry, inverse_sigma(units.blocks<Orbits>(entry)));
  }

  /// For orders of 2 and more, sets the coefficients of the monomials of degree 2 in the inputs'
  /// deviations: the coefficient of Y_a Y_b, a <= b, in g_c stands at ((c m + a) m + b) s + i.
  void evaluate_second(const std::vector<Orbits>& places, std::vector<Orbits>& second) {
    for (std::size_t i = 0; i < stages_; ++i) {
      for (std::size_t c = 0; c < inputs_; ++c) point_.input(c)[0] = places[c * stages_ + i];
      if (point_.has_time()) {
        for (std::size_t k = 0; k < point_.numbers(); ++k) {
          point_.number(k) = numbers_[k * stages_ + i];
        }
      }
      point_.evaluate_constant_terms();
      point_.complete(1);
      point_.evaluate_remainder(2);
      for (std::size_t c = 0; c < inputs_; ++c) {
        std::size_t monomial = space_->first(2);
        for (std::size_t a = 0; a < inputs_; ++a) {
          for (std::size_t b = a; b < inputs_; ++b, ++monomial) {
            second[((c * inputs_ + a) * inputs_ + b) * stages_ + i] =
                point_.has_remainder(c, 2) ? point_.remainder(c)[monomial] : Orbits(0.0);
          }
        }
      }
    }
  }

 private:
  /// The number of stages that are evaluated together; twice as many without derivatives. With a
  /// single stage each operation would wait for the one before, and with more stages the values
  /// would not fit the cache.
  static constexpr std::size_t half = 4;
  template <std::size_t Count>
  using Group = SliceEvaluator<Pack<double, static_cast<int>(Count* orbit_lanes)>, double>;

  /// Puts the places of the stages from `first` on into a group; beyond the last stage the first
  /// one of the group is repeated.
  template <class Evaluator>
  void put(const std::vector<Orbits>& places, std::size_t first, Evaluator& group) const {
    const auto put_stages = [&](const Orbits* values, auto& target) {
      for (std::size_t i = 0; i * Orbits::parts < target.part.size(); ++i) {
        const std::size_t stage = first + i < stages_ ? first + i : first;
        for (std::size_t p = 0; p < Orbits::parts; ++p) {
          target.part[i * Orbits::parts + p] = values[stage].part[p];
        }
      }
    };
    for (std::size_t c = 0; c < inputs_; ++c) put_stages(&places[c * stages_], *group.input(c));
    if (!group.has_time()) return;
    for (std::size_t k = 0; k < group.numbers(); ++k) {
      put_stages(&numbers_[k * stages_], group.number(k));
    }
  }
  template <class Evaluator>
  void take_slopes(const Evaluator& group, std::size_t first, std::vector<Orbits>& slopes) const {
    for (std::size_t c = 0; c < inputs_; ++c) take(*group.output(c), first, &slopes[c * stages_]);
  }
  template <class Values>
  void take(const Values& values, std::size_t first, Orbits* target) const {
    for (std::size_t i = 0; i * Orbits::parts < values.part.size(); ++i) {
      if (first + i == stages_) return;
      for (std::size_t p = 0; p < Orbits::parts; ++p) {
        target[first + i].part[p] = values.part[i * Orbits::parts + p];
      }
    }
  }

  std::size_t stages_;
  std::size_t inputs_;
  OperationList list_;
  Group<half> half_;
  Group<2 * half> whole_;
  SliceEvaluator<Orbits, double> point_;
  std::vector<Orbits> numbers_;  ///< the values that depend on the time alone, by stage
  SpacePointer space_;
};

}  // namespace hamjet
