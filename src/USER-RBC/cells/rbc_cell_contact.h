#ifndef LMP_RBC_CELL_CONTACT_H
#define LMP_RBC_CELL_CONTACT_H

#include "contact/near_triangles.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

/// A pair style in which surfaces of cells act on each other. Its ranges are known once LAMMPS has
/// initialised pair styles.
class CellContact {
 public:
  /// Gap below which surfaces of cells of two atom types act on each other; 0 if they do not.
  virtual double contact_range(int itype, int jtype) const = 0;

  /// Energy per area by which surfaces of two atom types hold each other; 0 if they do not.
  virtual double adhesion(int itype, int jtype) const = 0;

  /// Vertices of this rank and the surfaces near them at the last evaluation of forces, as near as
  /// the largest range, and as the readers of contacts want. Corners may be ghosts.
  virtual const std::vector<rbc::VertexContact> &near_contacts() const = 0;

  /// Gap up to which these are all, and whether they are of the present step.
  virtual double seen_gap() const = 0;
  virtual bool sees_this_step() const = 0;

  /// Gap up to which a cell is near itself only where its surface faces itself: a part of the
  /// surface around each vertex is not seen. 0 if cells do not see themselves.
  virtual double own_gap() const = 0;

  /// What else repels cells of an atom type, in words: plates, walls. Empty if nothing does.
  virtual std::string repelling_boundaries(int itype) const = 0;

  /// Whether surfaces that act on each other pass through each other in a step; null if none do.
  /// Known from setup() on.
  virtual class CellCrossings *crossings() = 0;

 protected:
  ~CellContact() = default;
};

/// A fix that reads the contacts of a CellContact.
class ContactReader {
 public:
  /// Gap of surfaces up to which it wants them. Known before LAMMPS initialises pair styles.
  virtual double widest_gap() const = 0;

 protected:
  ~ContactReader() = default;
};

/// The pair styles that are a CellContact and are computed in each step, those of pair_style hybrid
/// included.
std::vector<CellContact *> find_cell_contacts(class Force *force);

/// Of them the first that sees the most, or null: all see all cells, those with an own_gap() also
/// these cells themselves.
CellContact *find_cell_contact(class Force *force);

/// The widest gap that any fix wants, or 0.
double widest_gap_wanted(class Modify *modify);

}    // namespace LAMMPS_NS

#endif
