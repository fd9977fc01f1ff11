#ifndef LMP_RBC_BOUNDARY_CONTACT_H
#define LMP_RBC_BOUNDARY_CONTACT_H

#include "contact/repulsive_part.h"
#include "geometry/plain_vector.h"
#include "pointers.h"
#include "support/rbc_collective_stop.h"

#include <optional>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class NearSurfaces;

/// Contact of cells with what bounds the fluid: the plates, which are the ends of the box in z, and
/// the surface of a region. They act on each vertex by the law of its type, without adhesion:
///   E = sum_i A_i w(gap_i)
/// with a vertex' share of area A_i, the gap between it and the surface, and the energy w of
/// RepulsivePart per area. What holds plates and walls takes the forces that they exert.
class BoundaryContact : protected Pointers {
 public:
  /// A vertex of this rank and the surface near it.
  struct Contact {
    int vertex;
    rbc::PlainVector normal;    ///< of the surface, of unit length, into the fluid
    double gap;                 ///< negative behind the surface
    double force, energy;       ///< of the vertex, the force along the normal
  };

  /// `style` names the pair style in messages.
  BoundaryContact(LAMMPS *lmp, std::string style);

  /// At the start of a run: which surfaces there are, none at first, and no type has a law. An
  /// error if there is no such region; empty: none.
  void init(bool plates, const std::string &region);

  /// The law of an atom type among its like, or none. Laws may change during a run.
  void set_law(int itype, const std::optional<rbc::ContactLaw> &law);

  /// Gap from which a type is repelled; 0 if it is not.
  double range(int itype) const;

  /// The surfaces in words for messages.
  std::string names() const;

  /// Lists the vertices that can come nearer than `range` to a surface before they have moved by
  /// slack / 2. After the build() of `surfaces`.
  void build(const NearSurfaces &surfaces, double range, double slack);

  /// All contacts of this rank, for positions as build() allows. Reports a vertex beyond the walls,
  /// further than their law reaches, to `stop`, which must be checked later. Collective where the
  /// region depends on variables.
  const std::vector<Contact> &contacts(CollectiveStop &stop);

  double bytes() const;

 private:
  struct Candidate {
    int vertex;
    double area;
  };

  /// A place inside or outside a region, and what of its surface is near.
  struct NearRegion {
    bool inside;
    int count;    ///< of entries in the region's list of contacts
  };

  std::string style_;
  bool plates_ = false;
  class Region *region_ = nullptr;
  std::string region_id_;
  std::vector<std::optional<rbc::RepulsivePart>> laws_;    ///< of atom types
  std::vector<Candidate> candidates_;
  std::vector<Contact> contacts_;

  void prepare_region() const;
  double plate_gap(const double *x) const;
  NearRegion near_region(const double *x, double distance) const;
  bool can_touch(int i, double range) const;
  void touch(const Candidate &candidate, const rbc::RepulsivePart &law,
             const rbc::PlainVector &normal, double gap);
  void touch_plates(const Candidate &candidate, const rbc::RepulsivePart &law);
  void touch_walls(const Candidate &candidate, const rbc::RepulsivePart &law, CollectiveStop &stop);
  void report_beyond_walls(int i, CollectiveStop &stop) const;
};

}    // namespace LAMMPS_NS

#endif
