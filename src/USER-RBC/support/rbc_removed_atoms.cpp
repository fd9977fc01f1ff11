#include "support/rbc_removed_atoms.h"

#include "atom.h"
#include "atom_vec.h"
#include "force.h"
#include "lammps.h"

#include <array>

using namespace LAMMPS_NS;

// bonds, angles, dihedrals and impropers, with the number of atoms of each

static constexpr std::array<int, 4> SIZES = {2, 3, 4, 4};

void LAMMPS_NS::remove_atoms(LAMMPS *lmp, std::vector<char> marked)
{
  Atom *const atom = lmp->atom;
  const std::array<int *, 4> kept = {atom->num_bond, atom->num_angle, atom->num_dihedral,
                                     atom->num_improper};
  std::array<bigint, 4> removed{};
  for (int i = 0; i < atom->nlocal;) {
    if (!marked[i]) {
      ++i;
      continue;
    }
    for (std::size_t n = 0; n < kept.size(); ++n)
      if (kept[n]) removed[n] += kept[n][i];
    const int last = atom->nlocal - 1;
    atom->avec->copy(last, i, 1);
    marked[i] = marked[last];
    --atom->nlocal;
  }

  bigint nlocal = atom->nlocal;
  MPI_Allreduce(&nlocal, &atom->natoms, 1, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
  MPI_Allreduce(MPI_IN_PLACE, removed.data(), static_cast<int>(removed.size()), MPI_LMP_BIGINT,
                MPI_SUM, lmp->world);
  const std::array<bigint *, 4> all = {&atom->nbonds, &atom->nangles, &atom->ndihedrals,
                                       &atom->nimpropers};
  for (std::size_t n = 0; n < all.size(); ++n)    // each atom keeps its own without newton
    *all[n] -= lmp->force->newton_bond ? removed[n] : removed[n] / SIZES[n];
  if (atom->map_style == Atom::MAP_NONE) return;
  atom->nghost = 0;
  atom->map_init();
  atom->map_set();
}
