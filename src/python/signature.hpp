#pragma once

#include <string>

namespace hamjet::python {

/// A docstring that begins with the signature, as in `evaluate(self, w)`, in the form from which
/// Python takes __text_signature__, and inspect.signature what it returns.
inline std::string documented(const std::string& signature, const std::string& text) {
  return signature + "\n--\n\n" + text;
}

}  // namespace hamjet::python
