#pragma once

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <memory>
#include <new>

// Owners of SUNDIALS objects, which free them at the end of their scope. They throw std::bad_alloc
// if SUNDIALS returns no object.

namespace hamjet::sundials {

template <class T>
T require(T object) {
  if (object == nullptr) throw std::bad_alloc();
  return object;
}

/// The context, which all other objects need and must not outlive.
class Context {
 public:
  Context() {
    if (SUNContext_Create(nullptr, &context_) != 0) throw std::bad_alloc();
  }
  ~Context() { SUNContext_Free(&context_); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  operator SUNContext() const noexcept { return context_; }  // NOLINT: stands for its handle

 private:
  SUNContext context_ = nullptr;
};

struct FreeVector {
  void operator()(N_Vector v) const noexcept { N_VDestroy(v); }
};
using Vector = std::unique_ptr<_generic_N_Vector, FreeVector>;

struct FreeNonlinearSolver {
  void operator()(SUNNonlinearSolver s) const noexcept { SUNNonlinSolFree(s); }
};
using NonlinearSolver = std::unique_ptr<_generic_SUNNonlinearSolver, FreeNonlinearSolver>;

struct FreeMemory {
  void operator()(void* memory) const noexcept { CVodeFree(&memory); }
};
using Memory = std::unique_ptr<void, FreeMemory>;

/// The linear solver and the matrix hold no content of their own.
struct FreeLinearSolver {
  void operator()(SUNLinearSolver s) const noexcept { SUNLinSolFreeEmpty(s); }
};
using LinearSolver = std::unique_ptr<_generic_SUNLinearSolver, FreeLinearSolver>;

struct FreeMatrix {
  void operator()(SUNMatrix m) const noexcept { SUNMatFreeEmpty(m); }
};
using Matrix = std::unique_ptr<_generic_SUNMatrix, FreeMatrix>;

}  // namespace hamjet::sundials
