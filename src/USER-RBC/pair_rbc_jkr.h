#ifdef PAIR_CLASS
// clang-format off
PairStyle(rbc/jkr,PairRBCJKR);
// clang-format on
#else

#ifndef LMP_PAIR_RBC_JKR_H
#define LMP_PAIR_RBC_JKR_H

#include "cells/rbc_cell_changes.h"
#include "cells/rbc_cell_contact.h"
#include "cells/rbc_cell_crossings.h"
#include "cells/rbc_contact_settings.h"
#include "contact/contact_laws.h"
#include "contact/near_triangles.h"
#include "pair.h"
#include "support/rbc_step_part.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class PairRBCJKR : public Pair, public StepPart, public CellContact, public CellWatcher {
 public:
  PairRBCJKR(class LAMMPS *);
  ~PairRBCJKR() override;
  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  void cells_changed() override;
  double init_one(int, int) override;
  void setup() override;
  void finish() override { crossing->tell(); }
  double single(int, int, int, int, double, double, double, double &) override;
  void *extract(const char *, int &) override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  double memory_usage() override;

  double contact_range(int, int) const override;
  double adhesion(int i, int j) const override { return types(i, j).work; }
  const std::vector<rbc::VertexContact> &near_contacts() const override;
  double seen_gap() const override { return std::max(range, widest_gap); }
  bool sees_this_step() const override;
  double own_gap() const override { return given.self ? cutoff : 0; }
  std::string repelling_boundaries(int) const override;
  CellCrossings *crossings() override { return range > 0 ? crossing.get() : nullptr; }

  void report_to(const std::shared_ptr<CollectiveStop> &) override;
  std::vector<Section> sections() override
  {
    std::vector<Section> all = {{"Detection", &finding}, {"Contact", &interacting}};
    if (crossings()) all.push_back({"Crossings", &crossing->stopwatch()});
    return all;
  }

 private:
  /// How the surfaces of a pair of types act on each other.
  struct TypePair {
    std::optional<rbc::ContactLaw> law;    ///< none: they do not touch
    double tip_radius = 0;                 ///< gap at which the overlap is zero
    double detachment = 0;                 ///< overlap at which contact is lost
    double equilibrium = 0;                ///< overlap at which the force vanishes
    double work = 0;                       ///< energy per area to separate surfaces from there

    double range() const { return tip_radius - detachment; }
  };

  ContactSettings given;
  double unit = 1;      // of the lengths that are given
  double cutoff = 0;    // in distance units

  std::unique_ptr<class ContactCoefficients> coefficients;
  std::unique_ptr<class NearSurfaces> surfaces;
  std::unique_ptr<class BoundaryContact> boundaries;
  std::unique_ptr<CellCrossings> crossing;
  std::vector<TypePair> type_pairs;
  double range = 0;         // largest of them
  double widest_gap = 0;    // up to which fixes want to know of surfaces
  bigint neighbor_calls = -1, neighbor_step = -1, seen_step = -1;

  double adhered_area = 0;
  rbc::Stopwatch finding, interacting;
  std::vector<double> reactions;    // on all atoms, if forces on ghosts are not returned

  void allocate();
  void init_lengths();
  void init_boundaries();
  void log_boundaries() const;
  TypePair make_type_pair(int, int) const;
  const TypePair &types(int itype, int jtype) const;
  double read_number(FILE *);
  double slack() const;
  double ghost_reach() const;
  bool has_law() const;
  void check_cells();
  bool neighbors_changed();
  void add_forces(const std::vector<rbc::VertexContact> &);
  void add_forces_of_boundaries();
  void tally(int, double, double, const double *);
};

}    // namespace LAMMPS_NS

#endif
#endif
