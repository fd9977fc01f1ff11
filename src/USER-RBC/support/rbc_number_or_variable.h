#ifndef LMP_RBC_NUMBER_OR_VARIABLE_H
#define LMP_RBC_NUMBER_OR_VARIABLE_H

#include "error.h"
#include "input.h"
#include "pointers.h"
#include "utils.h"
#include "variable.h"

#include <string>

namespace LAMMPS_NS {

/// An argument that is either a number or v_name, an equal-style variable.
class NumberOrVariable {
 public:
  NumberOrVariable() = default;
  NumberOrVariable(LAMMPS *lmp, const char *arg)
  {
    if (utils::strmatch(arg, "^v_"))
      name = arg + 2;
    else
      number = utils::numeric(FLERR, arg, false, lmp);
  }

  bool is_variable() const { return !name.empty(); }

  /// Reports a missing variable or one of the wrong style as an error of `style`.
  void check(LAMMPS *lmp, const char *style) const
  {
    if (!is_variable()) return;
    const int ivar = lmp->input->variable->find(name.c_str());
    if (ivar < 0) lmp->error->all(FLERR, "Variable {} for {} does not exist", name, style);
    if (!lmp->input->variable->equalstyle(ivar))
      lmp->error->all(FLERR, "Variable {} for {} must be an equal-style variable", name, style);
  }

  /// Collective where the argument is a variable.
  double value(LAMMPS *lmp) const
  {
    if (!is_variable()) return number;
    return lmp->input->variable->compute_equal(lmp->input->variable->find(name.c_str()));
  }

 private:
  double number = 0;
  std::string name;
};

}    // namespace LAMMPS_NS

#endif
