#include "region_rbc_mesh.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "support/rbc_arguments.h"
#include "vessel/periodic_lids.h"
#include "vessel/stl_file.h"

#include <algorithm>
#include <stdexcept>

using namespace LAMMPS_NS;
using rbc::Triangle;
using rbc::Vec3;

/* ---------------------------------------------------------------------- */

RegionRBCMesh::RegionRBCMesh(LAMMPS *lmp, int narg, char **arg) : Region(lmp, narg, arg)
{
  if (narg < 3) utils::missing_cmd_args(FLERR, "region rbc/mesh", error);
  double scale = 1;
  Vec3 shift = Vec3::Zero();
  Arguments args(lmp, "region rbc/mesh", narg, arg, 3);
  const int iarg =
      args.read_known({{"scale", [&] { scale = args.positive(); }}, {"shift", [&] {
                                                                       for (int d = 0; d < 3; ++d)
                                                                         shift[d] = args.number();
                                                                     }}});
  options(narg - iarg, &arg[iarg]);
  if (openflag)
    error->all(FLERR, "Region rbc/mesh takes no open faces: leave them out of the file");

  std::vector<Triangle> triangles = read(arg[2]);
  const Vec3 units(xscale, yscale, zscale);
  for (Triangle &triangle : triangles)
    for (Vec3 &corner : triangle) corner = units.cwiseProduct(scale * corner + shift);

  rbc::PackingBox box{Vec3::Zero(), Vec3::Constant(HUGE_VAL), {false, false, false}};
  if (domain->box_exist && !domain->triclinic)
    box = {Vec3(domain->boxlo),
           Vec3(domain->prd),
           {domain->xperiodic != 0, domain->yperiodic != 0, domain->zperiodic != 0}};
  check_lids(arg[2], rbc::find_lids(triangles, box));
  std::copy_n(domain->boxlo, 3, box_lo);
  std::copy_n(domain->boxhi, 3, box_hi);
  try {
    solid = std::make_unique<rbc::TriangulatedSolid>(std::move(triangles), box);
  } catch (const std::invalid_argument &problem) {
    error->all(FLERR, 2, "Region rbc/mesh file {}: {}", arg[2], problem.what());
  }

  if (domain->box_exist) warn_if_beyond_box(arg[2]);

  bboxflag = interior;
  if (bboxflag) {
    extent_xlo = solid->lo()[0];
    extent_xhi = solid->hi()[0];
    extent_ylo = solid->lo()[1];
    extent_yhi = solid->hi()[1];
    extent_zlo = solid->lo()[2];
    extent_zhi = solid->hi()[2];
  }
  cmax = tmax = 1;
  contact = new Contact[cmax];
}

RegionRBCMesh::~RegionRBCMesh()
{
  if (copymode) return;
  delete[] contact;
}

/* ----------------------------------------------------------------------
   on one task, for all
------------------------------------------------------------------------- */

std::vector<Triangle> RegionRBCMesh::read(const std::string &path) const
{
  std::vector<Triangle> triangles;
  std::string problem;
  if (comm->me == 0) {
    try {
      triangles = rbc::read_stl(path);
    } catch (const std::invalid_argument &found) {
      problem = found.what();
    }
  }
  int sizes[2] = {static_cast<int>(triangles.size()), static_cast<int>(problem.size())};
  MPI_Bcast(sizes, 2, MPI_INT, 0, world);
  triangles.resize(sizes[0]);
  problem.resize(sizes[1]);
  MPI_Bcast(&problem[0], sizes[1], MPI_CHAR, 0, world);
  if (!problem.empty()) error->all(FLERR, 2, "Region rbc/mesh file {}: {}", path, problem);
  static_assert(sizeof(Triangle) == 9 * sizeof(double), "triangles are sent as numbers");
  MPI_Bcast(triangles.data(), 9 * sizes[0], MPI_DOUBLE, 0, world);
  return triangles;
}

/* ----------------------------------------------------------------------
   a lid has no thickness and nothing behind it but the next image of the vessel
------------------------------------------------------------------------- */

void RegionRBCMesh::check_lids(const char *file, const std::array<rbc::Lids, 3> &lids) const
{
  for (int d = 0; d < 3; ++d) {
    const char along = static_cast<char>('x' + d);
    const auto &[below, above] = lids[d].triangles;
    if (lids[d].facing)
      error->all(
          FLERR, 2,
          "Region rbc/mesh file {}: {} triangles on the periodic face {} = {:.6g} and {} on "
          "the one opposite, {} = {:.6g}, are lids across a vessel that goes on through these "
          "faces: leave them out of the file, or make the box longer than a vessel that ends",
          file, below, along, domain->boxlo[d], above, along, domain->boxhi[d]);
    if ((below > 0 || above > 0) && comm->me == 0)
      error->warning(FLERR,
                     "Region rbc/mesh file {}: {} triangles close the vessel on the periodic face "
                     "{} = {:.6g}, and nothing lies opposite: does its length differ from the box?",
                     file, below + above, along, below > 0 ? domain->boxlo[d] : domain->boxhi[d]);
  }
}

/* ---------------------------------------------------------------------- */

void RegionRBCMesh::warn_if_beyond_box(const char *file) const
{
  if (comm->me != 0) return;
  for (int d = 0; d < 3; ++d) {
    const double lo = solid->lo()[d], hi = solid->hi()[d];
    if (solid->periodic()[d] || (lo >= domain->boxlo[d] && hi <= domain->boxhi[d])) continue;
    const char along = static_cast<char>('x' + d);
    error->warning(FLERR,
                   "Region rbc/mesh file {} extends from {:.6g} to {:.6g} in {}, beyond the box "
                   "({:.6g} to {:.6g}), where it does not go on: is a shift missing?",
                   file, lo, hi, along, domain->boxlo[d], domain->boxhi[d]);
  }
}

/* ---------------------------------------------------------------------- */

bool RegionRBCMesh::has_openings() const
{
  const auto &open = solid->periodic();
  return open[0] || open[1] || open[2];
}

void RegionRBCMesh::init()
{
  Region::init();
  if (has_openings() && !(std::equal(box_lo, box_lo + 3, domain->boxlo) &&
                          std::equal(box_hi, box_hi + 3, domain->boxhi)))
    error->all(FLERR,
               "Region {} rbc/mesh leaves the box through periodic faces, and the box has changed "
               "since the region was defined",
               id);
}

/* ---------------------------------------------------------------------- */

int RegionRBCMesh::inside(double x, double y, double z)
{
  return solid->contains({x, y, z});
}

/* ----------------------------------------------------------------------
   none where the point is on the other side
------------------------------------------------------------------------- */

int RegionRBCMesh::surface_interior(double *x, double cutoff)
{
  return add_nearest(x, cutoff, true);
}

int RegionRBCMesh::surface_exterior(double *x, double cutoff)
{
  return add_nearest(x, cutoff, false);
}

int RegionRBCMesh::add_nearest(double *x, double cutoff, bool within)
{
  const auto nearest = solid->nearest(Vec3(x), cutoff);
  if (!nearest || (nearest->distance <= 0) != within) return 0;
  const Vec3 &arm = nearest->from_surface;
  add_contact(0, x, x[0] - arm[0], x[1] - arm[1], x[2] - arm[2]);
  contact[0].iwall = 0;
  contact[0].varflag = 0;
  return 1;
}
