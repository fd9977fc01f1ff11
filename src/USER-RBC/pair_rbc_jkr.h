#ifdef PAIR_CLASS
// clang-format off
PairStyle(rbc/jkr,PairRBCJKR);
// clang-format on
#else

#ifndef LMP_PAIR_RBC_JKR_H
#define LMP_PAIR_RBC_JKR_H

#include "contact/jkr_contact.h"
#include "contact/near_triangles.h"
#include "pair.h"
#include "support/rbc_step_part.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {

class PairRBCJKR : public Pair, public StepPart {
 public:
  PairRBCJKR(class LAMMPS *);
  ~PairRBCJKR() override;
  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  void setup() override;
  double single(int, int, int, int, double, double, double, double &) override;
  void *extract(const char *, int &) override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_restart_settings(FILE *) override;
  void read_restart_settings(FILE *) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  double memory_usage() override;

  void report_to(const std::shared_ptr<CollectiveStop> &) override;
  std::vector<Section> sections() override
  {
    return {{"Detection", &finding}, {"Contact", &interacting}};
  }

 private:
  enum Kind { NONE, ADHESIVE, REPULSIVE };

  double cutoff = 0;
  bool own_cells = false;    // cells touch themselves, too
  int **kind = nullptr;
  double **modulus = nullptr, **work = nullptr, **radius = nullptr;

  std::unique_ptr<class NearSurfaces> surfaces;
  std::vector<rbc::TipContact> tips;    // of pairs of types
  double range = 0;                     // largest of them
  bigint neighbor_calls = -1, neighbor_step = -1;

  double adhered_area = 0;
  rbc::Stopwatch finding, interacting;
  std::vector<double> reactions;    // on all atoms, if forces on ghosts are not returned

  void allocate();
  rbc::TipContact make_tip(int, int) const;
  double range_of(int, int) const;
  double slack() const;
  const rbc::TipContact &tip(int itype, int jtype) const;
  void check_cells();
  bool neighbors_changed();
  void add_forces(const std::vector<rbc::NearTriangles::Contact> &);
  void tally(int, double, double, const double *);
};

}    // namespace LAMMPS_NS

#endif
#endif
