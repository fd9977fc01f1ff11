#ifndef LMP_RBC_NEAR_SURFACES_H
#define LMP_RBC_NEAR_SURFACES_H

#include "contact/held_positions.h"
#include "contact/near_triangles.h"
#include "contact/triangle_fans.h"
#include "geometry/surface_template.h"
#include "lmptype.h"
#include "pointers.h"
#include "support/rbc_collective_stop.h"

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace LAMMPS_NS {

class CellMembranes;

/// The vertices that this rank owns and the surfaces of cells near them, of all fixes rbc/membrane.
class NearSurfaces : protected Pointers {
 public:
  /// A vertex and the closest point of a surface that it sees. Points and corners are local indices
  /// of atoms; corners may be ghosts.
  using Contact = rbc::VertexContact;

  NearSurfaces(LAMMPS *lmp, std::string style);

  /// Vertices see their own cell, too, but for the triangles nearer than `patch` along the edges of
  /// the cell at rest.
  void see_own_cells(double patch) { own_patch = patch; }

  /// Collective, at the start of a run: finds the cells.
  void init();

  /// Collective, within a run, once the membranes know of cells that were added or removed. Call
  /// build() next, before anything else.
  void cells_changed();

  /// Largest length of an edge that is allowed: 1.5 times that of the longest edge of the cells at
  /// rest.
  double longest_edge() const;

  /// An error if ghosts do not reach far enough for build().
  void check_ghosts(double range, double slack) const { longest_known_edge(range, slack); }

  /// Collective; ghosts must have their positions. Lists all pairs of a vertex and a triangle that
  /// can come nearer than `range` before an atom has moved by slack / 2. `stale`: atoms have moved
  /// by up to stale / 2 since LAMMPS chose the ghosts. The ghost cutoff must be at least range +
  /// slack + stale + longest_edge(). All are lengths.
  void build(double range, double slack, double stale = 0);

  /// Collective, for positions that ghosts have too: one contact for each owned vertex and cell
  /// seen nearer to it than `range`, at most that of build().
  const std::vector<Contact> &contacts(double range);

  /// What contacts() returned last.
  const std::vector<Contact> &last_contacts() const { return finder.last_contacts(); }

  /// How often build() was called: what follows is that of the last time.
  bigint builds() const { return build_count; }

  /// All triangles of which this rank has all corners, each periodic image once.
  const std::vector<rbc::NearTriangles::Triangle> &known_triangles() const { return triangles; }

  /// Where each of them is among the fans of its cell.
  const std::vector<rbc::TriangleFans::Place> &places() const { return triangle_places; }

  /// How far an atom may have moved since build(), and a report to `stop` if one has moved further:
  /// returns whether. Not collective.
  double allowed_displacement() const { return allowed; }
  bool report_moved(CollectiveStop &to) const;

  bool see_own_cells() const { return own_patch > 0; }

  /// Whether a vertex sees a triangle of its own cell, given by its place in known_triangles().
  /// Only where vertices see their own cells.
  bool sees_own(int i, int triangle) const;

  /// Whether a vertex of a fan of a cell sees a triangle of another fan of that cell, or the other
  /// way around. Fans are given by a triangle of each. Only where vertices see their own cells.
  bool fans_see(int first, int second) const;

  bool is_vertex(int i) const { return cell_of(i) != NO_CELL; }

  /// Molecule ID of the first cell whose vertices are of more than one atom type, or 0. Collective.
  tagint cell_of_mixed_type() const;

  /// A vertex' share of the area of its cell at rest, after build().
  double area(int i) const;

  /// Who ends the run, or takes a step again, for what is found here.
  void report_to(const std::shared_ptr<CollectiveStop> &stop_in) { stop = stop_in; }
  CollectiveStop &stopper() { return *stop; }

  double bytes() const;

 private:
  static constexpr int NO_CELL = -1;
  struct Cell {
    int shape;
    tagint first;                          ///< atom
    rbc::NearTriangles::Surface number;    ///< the same on all ranks
  };
  struct Shape {
    CellMembranes *membranes;
    const rbc::SurfaceTemplate *surface;
    std::vector<std::vector<int>>
        triangles_by_first_vertex;    ///< triangles of which a vertex is the first corner
    std::vector<std::vector<bool>>
        hidden;    ///< whether a vertex does not see a triangle, if it sees its own cell
    std::vector<rbc::TriangleFans::Place> places;    ///< of the triangles
    int fans = 0;
    std::vector<char> fans_see{};    ///< each other, if vertices see their own cell
  };

  std::string style;
  std::shared_ptr<CollectiveStop> stop;
  std::vector<Shape> shapes;
  std::vector<Cell> cells;                          ///< that have atoms here
  std::unordered_map<tagint, int> place_of_cell;    ///< in cells, by molecule ID
  std::vector<int> cell_at;    ///< place in cells, or NO_CELL; at build(), of all atoms, ghosts too
  rbc::NearTriangles finder;
  std::vector<rbc::NearTriangles::Triangle> triangles;
  std::vector<int> template_triangle;    ///< of each, if vertices see their own cells
  std::vector<rbc::TriangleFans::Place> triangle_places;
  std::vector<rbc::NearTriangles::Surface> surfaces;    ///< of vertices; other atoms see nothing
  rbc::HeldPositions built;                             ///< positions at build()
  double own_patch = 0;                                 ///< 0: vertices do not see their own cells
  double allowed = 0;                                   ///< displacement of an atom since build()
  bigint build_count = 0;

  int cell_of(int i) const;
  double longest_known_edge(double range, double slack) const;
  void collect_triangles(double longest);
  void check_apart() const;
  void take_cells();
  void find_fans(Shape &shape) const;
  void find_own_patches(Shape &shape) const;
  int image_near(int i, tagint id, double longest) const;
  bool are_near(int i, int j, double longest) const;
};

}    // namespace LAMMPS_NS

#endif
