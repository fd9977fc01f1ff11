#include "coupling/rbc_massive_markers.h"

#include "atom.h"
#include "coupling/rbc_driven_flow.h"
#include "coupling/rbc_immersed_markers.h"
#include "fix_store_atom.h"
#include "force.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void MassiveMarkers::set_limits(double tolerance, int max_solves)
{
  direct_.tolerance = tolerance;
  direct_.max_solves = max_solves;
}

/* ---------------------------------------------------------------------- */

void MassiveMarkers::couple(ImmersedMarkers &markers, DrivenFlow &flow)
{
  const double between = 0.5 * (update->dt + last_dt_);    // the middles of this step and the last
  find_target(markers, between);
  markers.stop()->check();

  const auto outcome = flow.couple_masses(
      direct_, {markers.set(), applied_.data(), resistance_.data(), target_.data(),
                inertial_.data(), markers.members().empty() ? nullptr : atom->v[0], atom->nlocal});
  if (outcome.outside >= 0) markers.report_outside(outcome.outside);
  markers.stop()->check();
  error_ = outcome.error;
  if (!(outcome.error <= direct_.tolerance)) ++unconverged_;
  keep(markers);
  last_between_ = between;
}

/* ----------------------------------------------------------------------
   resistance W and velocity V such that the inertial force is -W (U - V), see fluid::DirectForcing
------------------------------------------------------------------------- */

void MassiveMarkers::find_target(ImmersedMarkers &markers, double between)
{
  double **const history = store_->astore;
  const std::size_t numbers = 3 * static_cast<std::size_t>(atom->nlocal);
  for (auto *vector : {&applied_, &target_, &inertial_}) vector->resize(numbers);
  resistance_.resize(atom->nlocal);

  for (int i : markers.members()) {
    const double mass = atom->rmass ? atom->rmass[i] : atom->mass[atom->type[i]];
    if (!(mass > 0))
      markers.report(i, fmt::format("has mass {}; scheme direct needs a mass > 0", mass));
    const int steps = static_cast<int>(history[i][STEPS]);
    const double span = steps == 0 ? 0.5 * update->dt : between;
    const double r = steps > 1 ? span / last_between_ : 1;

    // coefficients, times span, of this velocity and the two before it
    const double own = steps > 1 ? (1 + 2 * r) / (1 + r) : 1;
    const double last = steps > 1 ? 1 + r : 1;
    const double older = steps > 1 ? r * r / (1 + r) : 0;
    resistance_[i] = mass * own / span;
    for (int d = 0; d < 3; ++d) {
      const double velocity = atom->v[i][d] + history[i][MISSING + d];
      target_[3 * i + d] = (last * velocity - older * history[i][OLDER + d]) / own;
      applied_[3 * i + d] = atom->f[i][d] * force->ftm2v;
      inertial_[3 * i + d] = history[i][INERTIAL + d];
      history[i][OLDER + d] = velocity;
    }
    history[i][STEPS] = std::min(steps + 1, 2);
  }
}

void MassiveMarkers::keep(const ImmersedMarkers &markers)
{
  double **const history = store_->astore;
  exerted_ = {};
  for (int i : markers.members())
    for (int d = 0; d < 3; ++d) {
      history[i][INERTIAL + d] = inertial_[3 * i + d];
      history[i][MISSING + d] =
          target_[3 * i + d] - inertial_[3 * i + d] / resistance_[i] - atom->v[i][d];
      exerted_[d] += applied_[3 * i + d] + inertial_[3 * i + d];
    }
}

/* ---------------------------------------------------------------------- */

std::size_t MassiveMarkers::bytes() const
{
  std::size_t numbers = 0;
  for (const auto *vector : {&applied_, &resistance_, &target_, &inertial_})
    numbers += vector->capacity();
  return direct_.bytes() + numbers * sizeof(double);
}
