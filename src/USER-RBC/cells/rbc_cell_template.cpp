#include "cells/rbc_cell_template.h"

#include "atom.h"
#include "error.h"
#include "molecule.h"

#include <stdexcept>

using namespace LAMMPS_NS;

namespace {

/// The molecule template of that ID; an error naming `style` if there is none.
Molecule *find_cell_molecule(LAMMPS *lmp, const std::string &id, const std::string &style)
{
  const int index = lmp->atom->find_molecule(id.c_str());
  if (index < 0) lmp->error->all(FLERR, "Molecule template ID {} for {} does not exist", id, style);
  Molecule *molecule = lmp->atom->molecules[index];
  if (molecule->nset != 1)
    lmp->error->all(FLERR, "Molecule template {} for {} must hold one molecule, not {}", id, style,
                    molecule->nset);
  if (!molecule->xflag)
    lmp->error->all(FLERR, "Molecule template {} for {} has no Coords", id, style);
  if (!molecule->angleflag)
    lmp->error->all(FLERR, "Molecule template {} for {} has no Angles: they are the triangles", id,
                    style);
  return molecule;
}

}    // namespace

std::unique_ptr<rbc::SurfaceTemplate>
LAMMPS_NS::make_cell_template(LAMMPS *lmp, const std::string &id, const std::string &style)
{
  const Molecule *molecule = find_cell_molecule(lmp, id, style);
  std::vector<rbc::Vec3> vertices;
  std::vector<rbc::SurfaceTemplate::Corners> triangles;
  for (int i = 0; i < molecule->natoms; ++i) {
    vertices.emplace_back(molecule->x[i][0], molecule->x[i][1], molecule->x[i][2]);
    for (int n = 0; n < molecule->num_angle[i]; ++n) {
      // without newton_bond every corner lists the angle
      if (molecule->angle_atom2[i][n] != i + 1) continue;
      triangles.push_back({static_cast<int>(molecule->angle_atom1[i][n]) - 1, i,
                           static_cast<int>(molecule->angle_atom3[i][n]) - 1});
    }
  }
  try {
    return std::make_unique<rbc::SurfaceTemplate>(std::move(vertices), std::move(triangles));
  } catch (const std::invalid_argument &problem) {
    lmp->error->all(FLERR, "Molecule template {} for {} is not a closed oriented surface: {}", id,
                    style, problem.what());
  }
}

void LAMMPS_NS::take_stress_free_shape(LAMMPS *lmp, rbc::SurfaceTemplate &surface,
                                       const std::string &id, const std::string &stress_free_id,
                                       const std::string &style)
{
  const auto stress_free = make_cell_template(lmp, stress_free_id, style + " stress-free");
  try {
    surface.take_reference(*stress_free);
  } catch (const std::invalid_argument &problem) {
    lmp->error->all(FLERR,
                    "Molecule template {} for {} stress-free must have the triangles of {} in the "
                    "same order: {}",
                    stress_free_id, style, id, problem.what());
  }
}
