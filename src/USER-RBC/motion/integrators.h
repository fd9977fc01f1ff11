#pragma once

#include "motion/adams_bashforth.h"
#include "motion/euler.h"
#include "motion/midpoint.h"
#include "motion/runge_kutta_chebyshev.h"

#include <memory>

namespace rbc {

struct IntegratorOptions {
  int stages = 0;    ///< 0: as few as are stable
  int order = 2;
};

/// A word of fix rbc/ib's keyword integrator.
struct IntegratorKind {
  const char *word;
  bool takes_options;    ///< the word is followed by the number of stages; order may be 3
  int code;              ///< in restart files: never changes; 10 is scheme direct of fix rbc/ib
  std::unique_ptr<Integrator> (*make)(const IntegratorOptions &);
};

template <typename Method> std::unique_ptr<Integrator> make_plain(const IntegratorOptions &)
{
  return std::make_unique<Method>();
}

inline std::unique_ptr<Integrator> make_stabilised(const IntegratorOptions &options)
{
  return std::make_unique<RungeKuttaChebyshev>(options.stages, options.order);
}

/// The table of all integrators.
inline const IntegratorKind integrator_kinds[] = {
    {"euler", false, 0, make_plain<Euler>},
    {"midpoint", false, 1, make_plain<Midpoint>},
    {"ab2", false, 2, make_plain<AdamsBashforth>},
    {"rkc", true, 3, make_stabilised},
};

}    // namespace rbc
