#include "cells/rbc_contact_settings.h"

#include "comm.h"
#include "error.h"
#include "support/rbc_arguments.h"
#include "utils.h"

#include <array>
#include <cmath>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

ContactSettings LAMMPS_NS::read_contact_settings(LAMMPS *lmp, int narg, char **arg)
{
  Arguments args(lmp, "pair_style rbc/jkr", narg, arg);
  ContactSettings settings;
  settings.cutoff = args.positive("cutoff");
  const Arguments::Choices<bool> units{{"box", false}, {"dx", true}};
  args.read({{"self", [&] { settings.self = args.logical(); }},
             {"units", [&] { settings.in_spacings = args.choice(units); }},
             {"plates", [&] { settings.plates = args.logical(); }},
             {"walls", [&] {
                settings.walls = args.text();
                if (settings.walls == "no") settings.walls.clear();
              }}});
  return settings;
}

/* ----------------------------------------------------------------------
   The first number of a file is the cutoff, which is negative where cells touch themselves, or 0
   where there is more: as many as in `More` below, then the characters of the region's ID. So files
   from before units, plates and walls can be read, and files without them can be read by versions
   from before.
------------------------------------------------------------------------- */

using More = std::array<double, 4>;    // cutoff, units, plates, length of the region's ID

void LAMMPS_NS::write_contact_settings(FILE *fp, const ContactSettings &settings)
{
  const double cutoff = settings.self ? -settings.cutoff : settings.cutoff;
  const bool has_more = settings.in_spacings || settings.has_boundaries();
  const double first = has_more ? 0 : cutoff;
  fwrite(&first, sizeof(double), 1, fp);
  if (!has_more) return;
  const More more{cutoff, double(settings.in_spacings), double(settings.plates),
                  double(settings.walls.size())};
  fwrite(more.data(), sizeof(double), more.size(), fp);
  fwrite(settings.walls.data(), sizeof(char), settings.walls.size(), fp);
}

ContactSettings LAMMPS_NS::read_contact_settings(LAMMPS *lmp, FILE *fp)
{
  const auto read = [lmp, fp](void *data, std::size_t size, std::size_t count) {
    if (lmp->comm->me == 0) utils::sfread(FLERR, data, size, count, fp, nullptr, lmp->error);
    MPI_Bcast(data, static_cast<int>(size * count), MPI_CHAR, 0, lmp->world);
  };
  ContactSettings settings;
  More more{};
  read(more.data(), sizeof(double), 1);
  if (more[0] == 0) {
    read(more.data(), sizeof(double), more.size());
    settings.in_spacings = more[1] != 0;
    settings.plates = more[2] != 0;
    settings.walls.resize(static_cast<std::size_t>(more[3]));
    read(settings.walls.data(), sizeof(char), settings.walls.size());
  }
  settings.cutoff = std::abs(more[0]);
  settings.self = more[0] < 0;
  return settings;
}
