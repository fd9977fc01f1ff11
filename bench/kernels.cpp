// Time of the solver's parts by themselves, on any number of ranks. One rank also times the Fourier
// transforms that a solve cannot do without, in turn with the solves, so that what else the machine
// does hits both.

#include "fluid/halo.h"
#include "fluid/spreading.h"
#include "fluid/stokes_solver.h"
#include "molecule_file.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

namespace {

using namespace fluid;

constexpr int ghost_layers = 3;
constexpr double spacing = 0.5;
const std::vector<Index3> sizes{{64, 64, 64}, {128, 128, 128}, {256, 256, 38}};

int ranks()
{
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}

// ---- time

/// Seconds until the last rank is done.
template <typename Work> double seconds(const Work &work)
{
  MPI_Barrier(MPI_COMM_WORLD);
  const double start = MPI_Wtime();
  work();
  MPI_Barrier(MPI_COMM_WORLD);
  return MPI_Wtime() - start;
}

class Samples {
 public:
  void add(double seconds) { seconds_.push_back(seconds); }
  double least() const { return *std::min_element(seconds_.begin(), seconds_.end()); }
  double median() const
  {
    std::vector<double> sorted = seconds_;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }

 private:
  std::vector<double> seconds_;
};

/// Minimum and median in ns for each of the `items` of an iteration.
void report(benchmark::State &state, const Samples &samples, double items)
{
  state.counters["least"] = 1e9 * samples.least() / items;
  state.counters["median"] = 1e9 * samples.median() / items;
}

template <typename Work> void run(benchmark::State &state, double items, const Work &work)
{
  Samples samples;
  work();
  while (state.KeepRunning()) {
    const double t = seconds(work);
    samples.add(t);
    state.SetIterationTime(t);
  }
  report(state, samples, items);
}

// ---- grids

Grid grid_of(const Index3 &cells, bool walls)
{
  return {cells, {0, 0, 0}, {spacing, spacing, spacing}, walls};
}

/// Slabs across the longest direction, the last of equals, as LAMMPS divides a box between two
/// ranks.
Decomposition slabs(const Grid &grid)
{
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  int d = 2;
  for (int other : {1, 0})
    if (grid.cells[other] > grid.cells[d]) d = other;
  Box mine = grid.domain();
  mine.lo[d] = grid.cells[d] * rank / ranks();
  mine.hi[d] = grid.cells[d] * (rank + 1) / ranks();
  return {MPI_COMM_WORLD, mine};
}

template <typename T> void fill(T *values, std::size_t count)
{
  for (std::size_t n = 0; n < count; ++n) values[n] = std::sin(double(n));
}

VectorField filled(const Box &box)
{
  VectorField field(box);
  fill(field[0].data, 3 * box.size());
  return field;
}

// ---- the bare transforms

/// FFTW's own transform of three components there and back, in place: of each plane between plates,
/// else of the box. In place and one plane a call are FFTW's fastest.
class BareTransforms {
 public:
  BareTransforms(const Grid &grid, unsigned planning)
  {
    const auto [nx, ny, nz] = grid.cells;
    const int padded = 2 * (nx / 2 + 1);
    calls_ = grid.plates ? 3 * nz : 3;
    stride_ = std::size_t(padded) * ny * (grid.plates ? 1 : nz);
    values_ = Buffer<double>(calls_ * stride_);
    double *real = values_.data();
    auto *modes = reinterpret_cast<fftw_complex *>(real);
    if (grid.plates) {
      forward_ = Plan(fftw_plan_dft_r2c_2d(ny, nx, real, modes, planning));
      backward_ = Plan(fftw_plan_dft_c2r_2d(ny, nx, modes, real, planning));
    } else {
      forward_ = Plan(fftw_plan_dft_r2c_3d(nz, ny, nx, real, modes, planning));
      backward_ = Plan(fftw_plan_dft_c2r_3d(nz, ny, nx, modes, real, planning));
    }
    fftw_forget_wisdom();    // else a measured plan becomes the estimated one of the next
  }

  /// Unnormalised values grow with every call.
  void refresh() const { fill(values_.data(), values_.size()); }

  void operator()() const
  {
    for (int n = 0; n < calls_; ++n)
      fftw_execute_dft_r2c(forward_.get(), real(n), reinterpret_cast<fftw_complex *>(real(n)));
    for (int n = 0; n < calls_; ++n)
      fftw_execute_dft_c2r(backward_.get(), reinterpret_cast<fftw_complex *>(real(n)), real(n));
  }

 private:
  double *real(int call) const { return values_.data() + call * stride_; }

  int calls_;
  std::size_t stride_;
  Buffer<double> values_;
  Plan forward_, backward_;
};

// ---- benchmarks

void solve(benchmark::State &state, const Index3 &cells, bool walls, double shift)
{
  const Grid grid = grid_of(cells, walls);
  const Decomposition decomposition = slabs(grid);
  const Halo halo(grid, decomposition, ghost_layers);
  const VectorField force = filled(halo.box()), velocity(halo.box());
  StokesSolver solver(grid, decomposition, 1.0, shift, shift == 0);
  const auto work = [&] { solver.velocity(force, {}, velocity); };
  if (ranks() > 1) {
    run(state, grid.size(), work);
    return;
  }
  const BareTransforms estimated(grid, FFTW_ESTIMATE), measured(grid, FFTW_MEASURE);
  Samples bare_estimated, bare_measured, samples;
  while (state.KeepRunning()) {
    const double t = seconds(work);
    samples.add(t);
    state.SetIterationTime(t);
    estimated.refresh();
    bare_estimated.add(seconds(estimated));
    measured.refresh();
    bare_measured.add(seconds(measured));
  }
  report(state, samples, grid.size());
  state.counters["fftw_estimate"] = 1e9 * bare_estimated.least() / grid.size();
  state.counters["fftw_measure"] = 1e9 * bare_measured.least() / grid.size();
}

/// Vertices of a red cell about a point.
std::vector<double> red_cell(const Real3 &centre)
{
  std::vector<double> x;
  for (const auto &v : MoleculeFile(POTENTIALS "/rbc_642.mol").vertices)
    x.insert(x.end(), {centre[0] + v[0], centre[1] + v[1], centre[2] + v[2]});
  return x;
}

/// Every rank has a cell in the middle of its brick.
void couple(benchmark::State &state, const Index3 &cells, KernelKind kernel, bool spreads)
{
  const Grid grid = grid_of(cells, false);
  const Decomposition decomposition = slabs(grid);
  const Halo halo(grid, decomposition, ghost_layers);
  const VectorField field = filled(halo.box());
  Real3 centre;
  for (int d = 0; d < 3; ++d)
    centre[d] = 0.5 * spacing * (decomposition.mine().lo[d] + decomposition.mine().hi[d]);
  const std::vector<double> x = red_cell(centre);
  std::vector<double> vectors(x.size(), 1.0);
  std::vector<int> index(x.size() / 3);
  for (std::size_t n = 0; n < index.size(); ++n) index[n] = static_cast<int>(n);
  const MarkerSet markers{kernel, MarkerKind::points, static_cast<int>(index.size()), index.data(),
                          x.data()};
  run(state, markers.count, [&] {
    if (spreads)
      spread(grid, markers, vectors.data(), 1.0, field);
    else
      interpolate(grid, markers, field, vectors.data());
  });
}

/// For each ghost cell of this rank.
void fill_halo(benchmark::State &state, const Index3 &cells)
{
  const Grid grid = grid_of(cells, false);
  const Decomposition decomposition = slabs(grid);
  Halo halo(grid, decomposition, ghost_layers);
  const VectorField field = filled(halo.box());
  run(state, halo.box().size() - decomposition.mine().size(), [&] { halo.fill(field.views()); });
}

template <typename Function>
void add(const std::string &name, const Index3 &cells, int iterations, Function function)
{
  std::string size;
  for (int n : cells) size += (size.empty() ? "" : "x") + std::to_string(n);
  benchmark::RegisterBenchmark((name + '/' + size).c_str(), function)
      ->Iterations(iterations)    // the same on all ranks
      ->UseManualTime();
}

void add_all()
{
  for (const Index3 &cells : sizes) {
    const int iterations = cells[0] == 64 ? 100 : 30;
    for (bool walls : {true, false})
      for (double shift : {0.0, 1.0})
        add(std::string(walls ? "walled" : "periodic") + (shift > 0 ? "/unsteady" : "/steady"),
            cells, iterations, [=](benchmark::State &s) { solve(s, cells, walls, shift); });
    add("halo/fill", cells, iterations, [=](benchmark::State &s) { fill_halo(s, cells); });
    if (cells[0] != cells[2]) continue;
    for (bool spreads : {true, false})
      for (KernelKind kernel : {KernelKind::roma3, KernelKind::peskin4})
        add(std::string(spreads ? "spread" : "interpolate") +
                (kernel == KernelKind::roma3 ? "/roma3" : "/peskin4"),
            cells, 200, [=](benchmark::State &s) { couple(s, cells, kernel, spreads); });
  }
}

class Silent : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context &) override { return true; }
  void ReportRuns(const std::vector<Run> &) override {}
};

}    // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  benchmark::Initialize(&argc, argv);
  add_all();
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  Silent silent;
  if (rank == 0)
    benchmark::RunSpecifiedBenchmarks();
  else
    benchmark::RunSpecifiedBenchmarks(&silent);
  benchmark::Shutdown();
  MPI_Finalize();
}
