#include "fix_rbc_vtk.h"

#include "atom.h"
#include "comm.h"
#include "compute_rbc_aggregate.h"
#include "domain.h"
#include "error.h"
#include "group.h"
#include "membrane/membrane_tension.h"
#include "modify.h"
#include "output/pvd_file.h"
#include "output/vtp_writer.h"
#include "support/rbc_arguments.h"
#include "support/rbc_first_message.h"
#include "support/rbc_molecule_shares.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

using namespace LAMMPS_NS;
using namespace FixConst;
using rbc::Vec3;

static const std::vector<rbc::PointArray> ARRAYS = {{"velocity", 3}, {"force", 3}, {"tension", 1}};
static constexpr int VALUES = 3 + 3 + 3 + 1;    // at a vertex, with its position

// cells whose centre lies this close below a side of the box, as a fraction of its length, count as
// above it: on different ranks round-off must not decide

static constexpr double SIDE = 1.0e-9;

namespace {

// vertices of a cell that are in the group

struct Members {
  tagint molecule;
  int count;

  void include(const Members &other) { count += other.count; }
};

}    // namespace

// a vertex on its way to the rank that writes its cell

struct FixRBCVTK::Vertex {
  int cell, vertex;
  double x[3], v[3], f[3];
};

// of one source: for each cell here the rank that owns its first vertex, -1 outside the group; the
// cells that this rank writes, in order; and where they are among all that are written

struct FixRBCVTK::Writers {
  std::vector<int> ranks;
  std::vector<const LocalCells::Cell *> mine;
  std::vector<int> slots;
  bigint all;
};

/* ---------------------------------------------------------------------- */

FixRBCVTK::FixRBCVTK(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  Arguments args(lmp, "fix rbc/vtk", narg, arg, 3);
  nevery = args.whole(1, MAXSMALLINT, "N");
  file = args.text();
  pieces = utils::strmatch(file, "\\.pvtp$");
  if (!pieces && !utils::strmatch(file, "\\.vtp$"))
    args.fail("Fix rbc/vtk file name {} must end in .vtp or .pvtp", file);
  if (file.find('*') == std::string::npos)
    args.fail("Fix rbc/vtk file name {} must contain a *, which stands for the step", file);
  args.read({{"unwrap", [&] { unwrap = args.logical(); }},
             {"aggregate", [&] { aggregate_id = args.text(); }}});
}

/* ---------------------------------------------------------------------- */

int FixRBCVTK::setmask()
{
  return END_OF_STEP;
}

/* ----------------------------------------------------------------------
   setup() writes what the setup() of the fixes before this one computed
------------------------------------------------------------------------- */

void FixRBCVTK::init()
{
  if (group->dynamic[igroup])
    error->all(FLERR, "Fix rbc/vtk {} cannot be used with dynamic group {}", id,
               group->names[igroup]);
  aggregate = nullptr;
  if (!aggregate_id.empty()) {
    Compute *const compute = modify->get_compute_by_id(aggregate_id);
    if (!compute)
      error->all(FLERR, "Fix rbc/vtk {}: compute ID {} for aggregate does not exist", id,
                 aggregate_id);
    aggregate = dynamic_cast<ComputeRBCAggregate *>(compute);
    if (!aggregate)
      error->all(FLERR,
                 "Fix rbc/vtk {}: compute {} for aggregate is of style {}, not rbc/aggregate", id,
                 aggregate_id, compute->style);
  }

  sources.clear();
  bool before = true;
  for (Fix *fix : modify->get_fix_list()) {
    if (fix == this) before = false;
    const auto owner = dynamic_cast<MembraneOwner *>(fix);
    if (!owner && strcmp(fix->style, "rbc/ib") != 0) continue;
    if (!before)
      error->all(FLERR, "Fix rbc/vtk {} must be defined after fix {} {}", id, fix->style, fix->id);
    if (owner) sources.push_back(&owner->membranes());
  }
  if (sources.empty()) error->all(FLERR, "Fix rbc/vtk {}: there is no fix rbc/membrane", id);
  cells_changed();
}

/* ---------------------------------------------------------------------- */

void FixRBCVTK::cells_changed()
{
  for (const CellMembranes *source : sources) check_whole(*source);
}

/* ---------------------------------------------------------------------- */

void FixRBCVTK::check_whole(const CellMembranes &membranes) const
{
  const int bits = groupbit | membranes.groupbit();
  std::vector<Members> mine;
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & bits) != bits) continue;
    if (mine.empty() || mine.back().molecule != atom->molecule[i])
      mine.push_back({atom->molecule[i], 0});
    ++mine.back().count;
  }
  const int size = membranes.shape().vertex_count();
  std::string broken;
  for (const Members &cell : share_molecules(lmp, std::move(mine)))
    if (cell.count != size && broken.empty())
      broken = fmt::format("Fix rbc/vtk {}: group {} breaks the cell with molecule ID {}: it holds "
                           "{} of its {} vertices",
                           id, group->names[igroup], cell.molecule, cell.count, size);
  broken = first_message(lmp, broken);
  if (!broken.empty()) error->all(FLERR, "{}", broken);
}

/* ---------------------------------------------------------------------- */

void FixRBCVTK::setup(int /*vflag*/)
{
  if (update->ntimestep % nevery == 0 && update->ntimestep != last_step) write(aggregate);
}

void FixRBCVTK::end_of_step()
{
  write(aggregate);
}

/* ----------------------------------------------------------------------
   the cells where a step went wrong, without aggregates: who is near whom may not be known
------------------------------------------------------------------------- */

void FixRBCVTK::write_failure(const std::string &why)
{
  if (!sources.empty()) write(nullptr, "; the run ends because of this: " + why);
}

/* ---------------------------------------------------------------------- */

void FixRBCVTK::write(ComputeRBCAggregate *grouping, const std::string &context)
{
  last_step = update->ntimestep;
  const std::string name = utils::star_subst(file, last_step, 0);
  const std::string stem = name.substr(0, name.rfind('.'));
  const auto piece = [&](int rank) { return fmt::format("{}_{}.vtp", stem, rank); };
  const double time = update->atime + (last_step - update->atimestep) * update->dt;
  using Labels = std::vector<std::string>;
  const rbc::PointData data{ARRAYS,
                            grouping ? Labels{"molecule", "aggregate"} : Labels{"molecule"}};
  if (grouping) {
    modify->clearstep_compute();
    if (!(grouping->invoked_flag & Compute::INVOKED_PERATOM)) {
      grouping->compute_peratom();
      grouping->invoked_flag |= Compute::INVOKED_PERATOM;
    }
    modify->addstep_compute((last_step / nevery + 1) * nevery);
  }

  std::vector<Writers> writers;
  std::vector<rbc::VtpWriter::Block> blocks;
  for (CellMembranes *source : sources) {
    writers.push_back(find_writers(*source));
    const auto here = static_cast<bigint>(writers.back().mine.size());
    blocks.push_back({&source->shape(), pieces ? here : writers.back().all});
  }

  try {
    std::unique_ptr<rbc::VtpWriter> writer;
    if (pieces || comm->me == 0)
      writer =
          std::make_unique<rbc::VtpWriter>(pieces ? piece(comm->me) : name, time, data, blocks);
    for (std::size_t s = 0; s < sources.size(); ++s)
      write_cells(*sources[s], static_cast<int>(s), writers[s], grouping, writer.get());
    if (writer) writer->close();
    if (pieces && comm->me == 0) {
      std::vector<std::string> names(comm->nprocs);
      for (int rank = 0; rank < comm->nprocs; ++rank)
        names[rank] = platform::path_basename(piece(rank));
      rbc::write_pvtp(name, time, data, names);
    }
    const std::string list = rbc::pvd_name(file);
    if (comm->me == 0 && !list.empty()) rbc::add_to_pvd(list, time, platform::path_basename(name));
  } catch (const std::runtime_error &problem) {
    error->one(FLERR, "Fix rbc/vtk {}: {}{}", id, problem.what(), context);
  }
}

/* ----------------------------------------------------------------------
   A cell is in the group if its first vertex is: check_whole() has seen that all others are then,
   too. In a file of its own a rank writes its cells in order; in a single one all are in order of
   molecule ID.
------------------------------------------------------------------------- */

FixRBCVTK::Writers FixRBCVTK::find_writers(CellMembranes &source) const
{
  LocalCells &local = source.local_cells();
  std::vector<double> counted(local.cells().size());    // ranks from 1 on, 0 for none
  for (std::size_t c = 0; c < counted.size(); ++c) {
    const LocalCells::Cell &cell = local.cells()[c];
    if (cell.elements->owned[0] && (atom->mask[cell.atom[0]] & groupbit)) counted[c] = comm->me + 1;
  }
  local.sum_shared(counted, 1);

  Writers writers{};
  for (std::size_t c = 0; c < counted.size(); ++c) {
    writers.ranks.push_back(static_cast<int>(counted[c]) - 1);
    if (writers.ranks[c] == comm->me) writers.mine.push_back(&local.cells()[c]);
  }
  std::sort(writers.mine.begin(), writers.mine.end(),
            [](const auto *a, const auto *b) { return a->index < b->index; });
  if (pieces) return writers;

  const auto here = static_cast<bigint>(writers.mine.size());
  MPI_Allreduce(&here, &writers.all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  std::vector<tagint> molecules;
  for (const LocalCells::Cell *cell : writers.mine) molecules.push_back(cell->molecule);
  std::vector<MoleculePlace> places = places_in_order(lmp, std::move(molecules));
  for (const MoleculePlace &place : places) writers.slots.push_back(place.place);
  std::sort(writers.slots.begin(), writers.slots.end());    // as the cells are
  return writers;
}

/* ----------------------------------------------------------------------
   what other ranks own of the cells that this one writes, in order of cells
------------------------------------------------------------------------- */

std::vector<FixRBCVTK::Vertex> FixRBCVTK::collect(const CellMembranes &source,
                                                  const Writers &writers)
{
  const std::vector<LocalCells::Cell> &cells = source.local_cells().cells();
  const int size = source.shape().vertex_count();
  std::vector<Vertex> sent;
  std::vector<int> ranks;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (writers.ranks[c] < 0 || writers.ranks[c] == comm->me) continue;
    for (int v = 0; v < size; ++v) {
      if (!cells[c].elements->owned[v]) continue;
      const int i = cells[c].atom[v];
      Vertex vertex{cells[c].index, v, {}, {}, {}};
      const Vec3 x = cells[c].position(v, atom->x);
      std::copy_n(x.data(), 3, vertex.x);
      std::copy_n(atom->v[i], 3, vertex.v);
      std::copy_n(atom->f[i], 3, vertex.f);
      sent.push_back(vertex);
      ranks.push_back(writers.ranks[c]);
    }
  }

  std::vector<Vertex> received = send_elements(lmp, std::move(sent), std::move(ranks));
  std::sort(received.begin(), received.end(),
            [](const Vertex &a, const Vertex &b) { return a.cell < b.cell; });
  return received;
}

/* ----------------------------------------------------------------------
   every cell is put together on one rank, which writes it or, for a single file, sends it to rank 0
------------------------------------------------------------------------- */

void FixRBCVTK::write_cells(const CellMembranes &source, int block, const Writers &writers,
                            const ComputeRBCAggregate *grouping, rbc::VtpWriter *writer)
{
  const rbc::SurfaceTemplate &shape = source.shape();
  const rbc::MembraneParameters &parameters = source.parameters();
  const int size = shape.vertex_count();
  const std::vector<const LocalCells::Cell *> &mine = writers.mine;

  const std::vector<Vertex> received = collect(source, writers);
  auto next = received.begin();
  std::vector<Vec3> x(size), v(size), f(size);
  std::vector<double> tension;
  const int head = grouping ? 3 : 2;    // slot and labels
  std::vector<double> message(head + VALUES * size);
  const auto write = [&] { writer->write(block, message[0], &message[1], &message[head]); };
  for (std::size_t n = 0; n < mine.size(); ++n) {
    const LocalCells::Cell &cell = *mine[n];
    for (int p = 0; p < size; ++p) {
      if (!cell.elements->owned[p]) continue;
      const int i = cell.atom[p];
      x[p] = cell.position(p, atom->x);
      v[p] = Vec3(atom->v[i]);
      f[p] = Vec3(atom->f[i]);
    }
    for (; next != received.end() && next->cell == cell.index; ++next) {
      x[next->vertex] = Vec3(next->x);
      v[next->vertex] = Vec3(next->v);
      f[next->vertex] = Vec3(next->f);
    }
    rbc::vertex_tension(shape, parameters, x, tension);
    if (!unwrap) wrap(x);

    message[0] = pieces ? static_cast<double>(n) : writers.slots[n];
    message[1] = static_cast<double>(cell.molecule);
    if (grouping) message[2] = grouping->vector_atom[cell.atom[0]];
    double *at = message.data() + head;
    for (const std::vector<Vec3> *vectors : {&x, &v, &f})
      for (const Vec3 &vector : *vectors) at = std::copy_n(vector.data(), 3, at);
    std::copy(tension.begin(), tension.end(), at);
    if (writer)
      write();
    else
      MPI_Ssend(message.data(), static_cast<int>(message.size()), MPI_DOUBLE, 0, 1 + block, world);
  }

  if (pieces || comm->me != 0) return;
  for (auto n = static_cast<bigint>(mine.size()); n < writers.all; ++n) {
    MPI_Recv(message.data(), static_cast<int>(message.size()), MPI_DOUBLE, MPI_ANY_SOURCE,
             1 + block, world, MPI_STATUS_IGNORE);
    write();
  }
}

/* ----------------------------------------------------------------------
   moves a whole cell by periods of the box such that its centre lies inside
------------------------------------------------------------------------- */

void FixRBCVTK::wrap(std::vector<Vec3> &x) const
{
  Vec3 centre = Vec3::Zero();
  for (const Vec3 &vertex : x) centre += vertex;
  centre /= static_cast<double>(x.size());
  Vec3 shift = Vec3::Zero();
  for (int d = 0; d < 3; ++d)
    if (domain->periodicity[d])
      shift[d] =
          std::floor((centre[d] - domain->boxlo[d]) / domain->prd[d] + SIDE) * domain->prd[d];
  for (Vec3 &vertex : x) vertex -= shift;
}
