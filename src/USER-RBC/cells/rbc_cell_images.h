#ifndef LMP_RBC_CELL_IMAGES_H
#define LMP_RBC_CELL_IMAGES_H

#include "cells/rbc_cell_offsets.h"
#include "geometry/joined_vertices.h"
#include "lmptype.h"
#include "pointers.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class LocalCells;

/// Which periodic image of each vertex is the cell's own. At the start of a run edges decide, so
/// that atoms read without image flags give whole cells; then LAMMPS's image flags do, so that
/// cells may be drawn out to any length. All functions are collective.
class CellImages : protected Pointers {
 public:
  CellImages(LAMMPS *, const rbc::SurfaceTemplate &, std::string style);

  /// Sets the image flags of cells such that no edge is longer than half of the box. Cells for
  /// which that is impossible keep their flags. It is an error if this rank's parts of a cell do
  /// not meet those of others; flags that change are a warning.
  void correct_flags(LocalCells &cells);

  /// Sets `offsets` of this rank's cells to what leads from LAMMPS's positions to unwrapped ones.
  void find_offsets(LocalCells &cells, CellOffsets &offsets);

  struct Stretch {
    double ratio;       ///< of an edge to its length in the template
    tagint molecule;    ///< of the cell that has it
  };
  /// The edge of all cells that is stretched most.
  Stretch largest_stretch(LocalCells &cells);

 private:
  const rbc::SurfaceTemplate &shape;
  std::string style;
  rbc::JoinedVertices joined;

  // an entry for each vertex of each of this rank's cells, while flags are corrected
  std::vector<rbc::Vec3> shifts;
  std::vector<char> placed;    ///< whether the shift of a vertex is known

  // while ghosts get the positions of their owners
  std::vector<double> numbers;    ///< three for each atom
  std::vector<double *> rows;

  // of the current cell
  std::vector<rbc::Vec3> wrapped;
  std::vector<char> is_known;

  void put_together(const LocalCells &cells);
  void set_current_cell(const int *atoms);
  rbc::JoinedVertices::Cell vertices(const LocalCells &cells, std::size_t c);
  bigint count_missing(const LocalCells &cells) const;
  void take_from_neighbors(const LocalCells &cells);
  imageint flags_of(const rbc::Vec3 &shift, imageint old) const;
  void warn_of_corrections(LocalCells &cells, std::vector<double> &corrected);
  const double *const *find_boxes(bool of_ghosts);
  void free_memory();
  std::vector<double> count_far(LocalCells &cells, const double *const *boxes_of);
};

}    // namespace LAMMPS_NS

#endif
