#include "coupling/rbc_grid_output.h"

#include "force.h"
#include "memory.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

int GridOutput::find(const std::string &name, int &columns)
{
  columns = name == "pressure" || name == "interior" ? 0 : 3;
  if (name == "velocity") return VELOCITY;
  if (name == "pressure") return PRESSURE;
  if (name == "force") return FORCE;
  if (name == "interior") return INTERIOR;
  return -1;
}

/* ---------------------------------------------------------------------- */

void *GridOutput::get(int index, fluid::Flow &flow, const std::array<double, 3> &uniform_force,
                      bigint version)
{
  if (index < 0 || index >= KINDS) return nullptr;
  box_ = flow.brick();
  if (version_[index] == version) return data_[index];
  version_[index] = version;
  if (!data_[index]) data_[index] = allocate(index);

  if (index == PRESSURE)
    fill_scalar(PRESSURE, flow.pressure(), 1.0 / force->ftm2v);
  else if (index == INTERIOR)
    fill_scalar(INTERIOR, fraction_.find(flow), 1.0);
  else if (index == VELOCITY) {
    fill_vector(VELOCITY, &flow.fluid_velocity(), {0, 0, 0}, 1.0);
  } else {
    const bool spread = flow.has_force();
    if (spread) flow.fill_force_ghosts();
    fill_vector(FORCE, spread ? &flow.force() : nullptr, uniform_force, 1.0 / force->ftm2v);
  }
  return data_[index];
}

/* ----------------------------------------------------------------------
   null where a subdomain holds no centre of a cell: LAMMPS cannot free an array without elements
------------------------------------------------------------------------- */

void *GridOutput::allocate(int index)
{
  if (box_.empty()) return nullptr;
  const auto &[lo, hi] = box_;
  if (is_scalar(index)) {
    double ***p = nullptr;
    return memory->create3d_offset(p, lo[2], hi[2] - 1, lo[1], hi[1] - 1, lo[0], hi[0] - 1,
                                   "rbc/fluid:pressure");
  }
  double ****v = nullptr;
  return memory->create4d_offset_last(v, lo[2], hi[2] - 1, lo[1], hi[1] - 1, lo[0], hi[0] - 1, 3,
                                      "rbc/fluid:data");
}

/* ---------------------------------------------------------------------- */

void GridOutput::free()
{
  version_.fill(NONE);
  const auto &lo = box_.lo;
  for (int index = 0; index < KINDS; ++index) {
    if (!data_[index]) continue;
    if (is_scalar(index)) {
      auto p = static_cast<double ***>(data_[index]);
      memory->destroy3d_offset(p, lo[2], lo[1], lo[0]);
    } else {
      auto v = static_cast<double ****>(data_[index]);
      memory->destroy4d_offset_last(v, lo[2], lo[1], lo[0]);
    }
    data_[index] = nullptr;
  }
}

/* ---------------------------------------------------------------------- */

double GridOutput::bytes() const
{
  double numbers = 0;
  for (int index = 0; index < KINDS; ++index)
    if (data_[index]) numbers += static_cast<double>(box_.size()) * (is_scalar(index) ? 1 : 3);
  return numbers * sizeof(double) + static_cast<double>(fraction_.bytes());
}

/* ---------------------------------------------------------------------- */

void GridOutput::fill_scalar(int index, const fluid::ScalarField &centres, double scale)
{
  auto p = static_cast<double ***>(data_[index]);
  fluid::for_each_cell(
      box_, [&, from = centres[0]](int i, int j, int k) { p[k][j][i] = from(i, j, k) * scale; });
}

/* ----------------------------------------------------------------------
   faces to centres, plus a uniform vector
------------------------------------------------------------------------- */

void GridOutput::fill_vector(int index, const fluid::VectorField *faces,
                             const std::array<double, 3> &uniform, double scale)
{
  auto v = static_cast<double ****>(data_[index]);
  fluid::for_each_cell(box_, [&](int i, int j, int k) {
    for (int c = 0; c < 3; ++c) {
      double value = uniform[c];
      if (faces)
        value +=
            0.5 * ((*faces)[c](i, j, k) + (*faces)[c](i + (c == 0), j + (c == 1), k + (c == 2)));
      v[k][j][i][c] = scale * value;
    }
  });
}
