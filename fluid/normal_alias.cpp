#include "fluid/normal_alias.h"

namespace fluid {

namespace {

double factor(KernelKind kernel, MarkerKind kind)
{
  const bool sharpened = kind == MarkerKind::sheets;
  if (kernel == KernelKind::peskin4) return sharpened ? 4.7e-3 : 7.2e-4;
  return sharpened ? 1.12e-2 : 2.1e-3;
}

}    // namespace

double normal_alias(KernelKind kernel, MarkerKind kind, const Real3 &normal)
{
  double fourth = 0, sixth = 0;
  for (double component : normal) {
    const double square = component * component;
    fourth += square * square;
    sixth += square * square * square;
  }
  return factor(kernel, kind) * (sixth - fourth * fourth);
}

}    // namespace fluid
