#include <fmt/format.h>

#include <cstddef>
#include <vector>

#include "hamjet/error.hpp"
#include "hamjet/integrators/symmetric_composition.hpp"

namespace hamjet {
namespace {

// The first half and the middle of each symmetric sequence. The order conditions were solved to 80
// digits, starting from the printed values. With 9 and 17 substeps they leave one number free, with
// which the authors made the error small: the first substep, which is taken as printed.

/// Suzuki (1990): gamma_1 = 1/(4 - 4^(1/3)).
const std::vector<const char*> suzuki_order_4 = {
    "0.414490771794375737142354062860761495711774604",
    "0.414490771794375737142354062860761495711774604",
    "-0.657963087177502948569416251443045982847098416",
};

/// Kahan and Li (1997); Hairer, Lubich and Wanner, eq. (V.3.11).
const std::vector<const char*> kahan_li_order_6 = {
    "0.39216144400731413927925056",
    "0.332599136789359438599748634257274355737334099",
    "-0.706246172557639359809964819634910351039340311",
    "0.0822135962935508002314904488531569176963106415",
    "0.798543990934829963398950353048958155211391141",
};

/// Kahan and Li (1997); Hairer, Lubich and Wanner, eq. (V.3.13).
const std::vector<const char*> kahan_li_order_8 = {
    "0.13020248308889008087881763",
    "0.56116298177510838456196440768200010264986345",
    "-0.389474962644847286408078593043166997128494533",
    "0.158841906555155600896210746677682393213504632",
    "-0.395903894133237577336231543466131671452409608",
    "0.184539640978315707091832543364086516175002388",
    "0.258374387686322047293979111695425973702570489",
    "0.295011723609310298870966236757462976621284831",
    "-0.605508533830034511698921079334718587562643298",
};

const std::vector<const char*>& half_sequence(int order) {
  switch (order) {
    case 4:
      return suzuki_order_4;
    case 6:
      return kahan_li_order_6;
    case 8:
      return kahan_li_order_8;
    default:
      throw Error(ErrorKind::usage,
                  fmt::format("symmetric composition: the order must be 4, 6 or 8, not {}", order));
  }
}

}  // namespace

std::vector<Extended> composition_substeps(int order) {
  std::vector<Extended> substeps;
  for (const char* digits : half_sequence(order)) substeps.emplace_back(digits);
  for (std::size_t k = substeps.size() - 1; k-- > 0;) substeps.push_back(substeps[k]);
  return substeps;
}

}  // namespace hamjet
