#include "support/rbc_new_atoms.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "error.h"

#include <algorithm>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

NewAtoms::NewAtoms(LAMMPS *lmp, const std::string &style, bigint count, tagint above) :
    Pointers(lmp), last_(above), before_(atom->nlocal)
{
  for (int i = 0; i < atom->nlocal; ++i) last_ = std::max(last_, atom->tag[i]);
  MPI_Allreduce(MPI_IN_PLACE, &last_, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (last_ + count > MAXTAGINT) error->all(FLERR, "{}: too many atoms for atom IDs", style);
  atom->nghost = 0;    // their indices are taken
}

NewAtoms::Made NewAtoms::add(int type, Eigen::Vector3d x)
{
  ++last_;
  imageint image = ((imageint)IMGMAX << IMG2BITS) | ((imageint)IMGMAX << IMGBITS) | IMGMAX;
  domain->remap(x.data(), image);
  int place[3];
  if (comm->coord2proc(x.data(), place[0], place[1], place[2]) != comm->me) return {-1, image};
  atom->avec->create_atom(type, x.data());
  const int i = atom->nlocal - 1;
  atom->tag[i] = last_;
  return {i, image};
}

void NewAtoms::finish()
{
  atom->data_fix_compute_variable(before_, atom->nlocal);
  bigint nlocal = atom->nlocal;
  MPI_Allreduce(&nlocal, &atom->natoms, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  atom->tag_check();
  if (atom->map_style == Atom::MAP_NONE) return;
  atom->map_init();
  atom->map_set();
}

void NewAtoms::set_missing_mass(int type)
{
  if (!atom->mass || atom->mass_setflag[type]) return;
  atom->set_mass(FLERR, type, 1.0);
  if (comm->me == 0)
    utils::logmesg(lmp, "Mass of atom type {} set to 1.0, for it has not been set\n", type);
}
