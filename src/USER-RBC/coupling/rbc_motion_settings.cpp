#include "coupling/rbc_motion_settings.h"

#include "coupling/rbc_kernel_words.h"
#include "error.h"
#include "support/rbc_arguments.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   returns 0 for auto
------------------------------------------------------------------------- */

static int read_stages(LAMMPS *lmp, Arguments &args)
{
  if (args.take("auto")) return 0;
  constexpr int least = rbc::ChebyshevMethod::LEAST_STAGES,
                most = rbc::ChebyshevMethod::MOST_STAGES;
  const std::string word = args.text();
  const int stages = utils::is_integer(word) ? utils::inumeric(FLERR, word, false, lmp) : 0;
  if (stages < least || stages > most)
    args.fail("Fix rbc/ib rkc stages {} must be auto or from {} to {}", word, least, most);
  return stages;
}

/* ---------------------------------------------------------------------- */

MotionSettings MotionSettings::read(LAMMPS *lmp, int narg, char **arg, int first)
{
  MotionSettings settings;
  Arguments::Choices<const rbc::IntegratorKind *> integrators;
  for (const rbc::IntegratorKind &kind : rbc::integrator_kinds)
    integrators.emplace_back(kind.word, &kind);

  Arguments args(lmp, "fix rbc/ib", narg, arg, first);
  args.read({{"kernel", [&] { settings.markers.kernel = args.choice(kernel_words); }},
             {"scheme",
              [&] {
                settings.direct = args.choice<bool>({{"elastic", false}, {"direct", true}});
              }},
             {"integrator",
              [&] {
                settings.integrator = args.choice(integrators);
                if (!settings.integrator->takes_options) return;
                args.enter(settings.integrator->word);
                settings.options.stages = read_stages(lmp, args);
              }},
             {"order", [&] { settings.options.order = args.whole(2, 3); }},
             {"tol",
              [&] {
                settings.tolerance = args.between(0, 1);
                settings.iterates = true;
              }},
             {"maxiter",
              [&] {
                settings.max_solves = args.whole(1, MAXSMALLINT);
                settings.iterates = true;
              }},
             {"courant", [&] { settings.markers.courant = args.positive(); }},
             {"adapt",
              [&] {
                settings.error_bound = args.positive("adapt error");
                settings.largest_dt = args.positive("adapt largest timestep");
              }},
             {"sheets", [&] { settings.sheets = args.logical() ? Sheets::YES : Sheets::NO; }},
             {"gaps", [&] { settings.gaps = settings.asks_gaps = args.logical(); }}});
  return settings;
}

void MotionSettings::check(Error *error) const
{
  if (options.order > 2 && !integrator->takes_options)
    error->all(FLERR, "Fix rbc/ib order {} needs integrator rkc", options.order);
  if (sheets == Sheets::YES && direct)
    error->all(FLERR, "Fix rbc/ib sheets yes needs scheme elastic");
  if (asks_gaps && (sheets == Sheets::NO || direct))
    error->all(FLERR, "Fix rbc/ib gaps yes needs sheets yes and scheme elastic");
}

const rbc::IntegratorKind *LAMMPS_NS::default_integrator(bool inertia)
{
  const std::string word = inertia ? "midpoint" : "rkc";
  return std::find_if(std::begin(rbc::integrator_kinds), std::end(rbc::integrator_kinds),
                      [&](const rbc::IntegratorKind &kind) { return word == kind.word; });
}
