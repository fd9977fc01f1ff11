#ifdef FIX_CLASS
// clang-format off
FixStyle(rbc/stream,FixRBCStream);
// clang-format on
#else

#ifndef LMP_FIX_RBC_STREAM_H
#define LMP_FIX_RBC_STREAM_H

#include "cells/rbc_cell_changes.h"
#include "cells/rbc_common_enclosure.h"
#include "fix.h"
#include "lmptype.h"
#include "packing/cell_placement.h"
#include "packing/periodic_stretch.h"
#include "packing/stream_ledger.h"

#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace LAMMPS_NS {

/// Cells that enter a vessel behind a port and leave it before others: arguments, checks, output
/// and LAMMPS's hooks.
class FixRBCStream : public Fix, public CellSource {
 public:
  FixRBCStream(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup(int) override;
  void post_integrate() override;
  void pre_exchange() override;
  void end_of_step() override;
  void post_run() override;
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  int fed_groupbit() const override { return groupbit; }

 private:
  struct Outlet {
    std::string port, region;
  };
  struct Leaver {
    tagint molecule;
    int outlet;    // -1: a copy that is taken back
  };

  std::string style;    // and ID, for messages
  std::string port, region;
  std::vector<Outlet> outlets;
  double hematocrit = 0, gap = -1;
  int seed = 0, cell_type = 1, attempts = 100, every = 1;
  int along = -1;         // dimension along which the region is periodic, -1: it is not
  bool upwards = true;    // whether the stream goes in its direction
  std::unique_ptr<rbc::SurfaceTemplate> shape;    // of new cells

  std::optional<rbc::StreamLedger> ledger;
  std::optional<rbc::CellPlacement> placement;
  std::optional<rbc::PeriodicStretch> stretch;
  std::vector<double> remembered;         // of it, from a restart file
  std::optional<CommonEnclosure> feed;    // where they appear
  rbc::Vec3 feed_lo, feed_length;
  double room = 0;                            // cells of this hematocrit in it
  int moved_groupbit = 0;                     // of the fix rbc/ib that moves them
  tagint last_atom = 0, last_molecule = 0;    // highest IDs there have been
  bool warned = false;

  std::vector<rbc::PeriodicStretch::Copy> copies;    // the first arrivals, without IDs
  std::map<tagint, std::vector<rbc::Vec3>> noted;    // shapes of them and their cells, on rank 0

  class CellMembranes *membranes = nullptr;        // of the group's cells
  std::vector<Leaver> leavers;                     // of this step
  std::vector<std::vector<rbc::Vec3>> arrivals;    // vertices of new cells

  void parse(int, char **);
  void check_ports();
  class CellMembranes *membranes_of_group() const;
  void find_membranes();
  void check_moved();
  void find_feed();
  std::vector<rbc::Vec3> feed_points() const;
  double lead() const;
  void check_stretch(const std::vector<rbc::Vec3> &points, const std::string &vessel) const;
  class FixRBCPort *find_port(const std::string &) const;
  double rate_through(const std::string &) const;
  std::vector<double> rates_out() const;

  void read_direction(class Arguments &);
  std::vector<Leaver> find_leavers(const std::vector<rbc::Vec3> &centres) const;
  std::vector<rbc::Vec3> centres_here() const;
  bool is_due() const;
  double late() const;
  void collect_obstacles();
  void add_arrivals_of_others();
  void add_surfaces(CellMembranes &);
  void add_points();
  rbc::Vec3 near_feed(const rbc::Vec3 &) const;
  std::vector<std::vector<rbc::Vec3>> find_arrivals();
  void add_random(std::vector<std::vector<rbc::Vec3>> &found);
  void share(std::vector<std::vector<rbc::Vec3>> &found) const;
  void warn_of_delay();
  void note_ids();
  void remove_leavers();
  void add_arrivals();

  // of a periodic stretch
  void follow(const std::vector<rbc::Vec3> &centres);
  double place_along(const rbc::Vec3 &centre) const;
  bool is_beside(const rbc::Vec3 &centre) const;
  bool leads() const { return stretch && !stretch->led().empty(); }
  bool note_cell(const struct WholeCell &);
  std::vector<rbc::Vec3> behind(tagint cell, double shift) const;
  void lead_copies();
  void move_copies(const std::map<tagint, const std::vector<rbc::Vec3> *> &places);
  rbc::Vec3 nearest_image(rbc::Vec3) const;
  void add_copies(std::vector<std::vector<rbc::Vec3>> &found);
  void note_copies();
};

}    // namespace LAMMPS_NS

#endif
#endif
