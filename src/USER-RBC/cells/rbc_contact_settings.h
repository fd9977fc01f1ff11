#ifndef LMP_RBC_CONTACT_SETTINGS_H
#define LMP_RBC_CONTACT_SETTINGS_H

#include <cstdio>
#include <string>

namespace LAMMPS_NS {

/// The arguments of pair_style rbc/jkr.
struct ContactSettings {
  double cutoff = 0;           ///< as it was given
  bool self = false;           ///< cells touch themselves, too
  bool in_spacings = false;    ///< lengths are in spacings of the fluid's grid
  bool plates = false;         ///< the plates repel cells
  std::string walls;           ///< region whose surface repels cells; empty: none

  bool has_boundaries() const { return plates || !walls.empty(); }
};

/// An error names the argument that is wrong.
ContactSettings read_contact_settings(class LAMMPS *lmp, int narg, char **arg);

/// Writes them into a restart file; rank 0 only.
void write_contact_settings(FILE *fp, const ContactSettings &settings);

/// Reads them on rank 0, the only one that needs the file; collective.
ContactSettings read_contact_settings(class LAMMPS *lmp, FILE *fp);

}    // namespace LAMMPS_NS

#endif
