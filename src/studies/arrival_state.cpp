#include "hamjet/detail/studies/transfer_settings.hpp"

namespace hamjet {

std::vector<double> ArrivalState::deviation(const std::vector<double>& chief,
                                            const MetricUnits& units, RelativeFrame frame) const {
  if (own_state) {
    std::vector<double> difference(own_state->begin(), own_state->end());
    for (std::size_t i = 0; i < difference.size(); ++i) difference[i] -= chief[i];
    return difference;
  }
  if (!in_form) return ChiefFrame(chief, units, frame).deviation(*this);
  const auto found = DeputyCoordinates(chief, units, 1, in_form->form).deviation(in_form->numbers);
  return {found.begin(), found.end()};
}

}  // namespace hamjet
