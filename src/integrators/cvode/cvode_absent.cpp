// Replaces cvode.cpp in a build without SUNDIALS.

#include "hamjet/error.hpp"
#include "hamjet/integrators/cvode.hpp"

namespace hamjet {

bool cvode_available() noexcept { return false; }

FlowJet<double> integrate_cvode(const FlowProblem<double>&, const CvodeSettings&,
                                IntegrationStatistics&, const StepObserver<double>&) {
  throw Error(ErrorKind::usage, "this build has no CVODE: configure with -DHAMJET_CVODE=ON");
}

}  // namespace hamjet
