#ifndef LMP_RBC_CELL_OFFSETS_H
#define LMP_RBC_CELL_OFFSETS_H

#include "geometry/vec3.h"

#include <cstddef>
#include <vector>

namespace LAMMPS_NS {

/// What leads from LAMMPS's positions of the vertices of cells to ones near the origin of each. A
/// cell in one image of the box has the same for all of its vertices, and it is kept once.
class CellOffsets {
 public:
  /// Of one cell, by vertex. Valid until cells are added.
  class OfCell {
   public:
    OfCell() = default;
    OfCell(const rbc::Vec3 *first, bool same) : first_(first), stride_(same ? 0 : 1) {}
    const rbc::Vec3 &operator[](int v) const { return first_[std::ptrdiff_t(v) * stride_]; }

   private:
    const rbc::Vec3 *first_ = nullptr;
    std::ptrdiff_t stride_ = 0;
  };

  void clear()
  {
    offsets_.clear();
    begin_.assign(1, 0);
  }

  /// The next cell: an entry for each vertex, which counts where its atom is not -1.
  void add(const std::vector<rbc::Vec3> &of_vertices, const int *atom)
  {
    const rbc::Vec3 *known = nullptr;
    bool same = true;
    for (std::size_t v = 0; v < of_vertices.size(); ++v) {
      if (atom[v] < 0) continue;
      if (!known) known = &of_vertices[v];
      same = same && of_vertices[v] == *known;
    }
    if (same)
      offsets_.push_back(known ? *known : rbc::Vec3::Zero());
    else
      offsets_.insert(offsets_.end(), of_vertices.begin(), of_vertices.end());
    begin_.push_back(offsets_.size());
  }

  OfCell operator[](std::size_t c) const
  {
    return {&offsets_[begin_[c]], begin_[c + 1] == begin_[c] + 1};
  }

  /// Moves the origin from which the offsets of a cell count.
  void subtract(std::size_t c, const rbc::Vec3 &origin)
  {
    for (std::size_t n = begin_[c]; n < begin_[c + 1]; ++n) offsets_[n] -= origin;
  }

  std::size_t bytes() const
  {
    return offsets_.capacity() * sizeof(rbc::Vec3) + begin_.capacity() * sizeof(std::size_t);
  }

 private:
  std::vector<rbc::Vec3> offsets_;
  std::vector<std::size_t> begin_{0};    ///< of each cell, and the end
};

}    // namespace LAMMPS_NS

#endif
