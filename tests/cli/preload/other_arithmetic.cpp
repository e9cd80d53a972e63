// Loaded into the command before it starts: rounds upwards and, where the processor can, takes
// denormal numbers for zero, as a library linked with -ffast-math makes it do.

#include <cfenv>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace {

__attribute__((constructor)) void change_arithmetic() {
  std::fesetround(FE_UPWARD);
#if defined(__SSE2__)
  constexpr unsigned flush_to_zero = 0x8000;
  constexpr unsigned denormals_are_zero = 0x0040;
  _mm_setcsr(_mm_getcsr() | flush_to_zero | denormals_are_zero);
#endif
}

}  // namespace
