#include "stack_limit.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include "hamjet/error.hpp"

namespace hamjet::cli {
namespace {

/// The deepest of ten shipped scenes, of all studies, takes an eighth of it; threads get as much.
constexpr rlim_t least_stack_kilobytes = 1024;

}  // namespace

void require_stack() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  if (limit.rlim_cur / 1024 >= least_stack_kilobytes) return;
  throw Error(ErrorKind::too_large,
              fmt::format("the stack is limited to {} kB, must be at least {} (ulimit -s)",
                          limit.rlim_cur / 1024, least_stack_kilobytes));
}

}  // namespace hamjet::cli
