#ifndef LMP_RBC_CELL_CONTACT_H
#define LMP_RBC_CELL_CONTACT_H

namespace LAMMPS_NS {

/// A pair style in which surfaces of cells act on each other. Its ranges are known once LAMMPS has
/// initialised pair styles.
class CellContact {
 public:
  /// Gap below which surfaces of cells of two atom types act on each other; 0 if they do not.
  virtual double contact_range(int itype, int jtype) const = 0;

 protected:
  ~CellContact() = default;
};

}    // namespace LAMMPS_NS

#endif
