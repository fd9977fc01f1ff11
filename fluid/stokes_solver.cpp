#include "stokes_solver.h"

namespace fluid {

StokesSolver::StokesSolver(const Grid &grid, const Decomposition &decomposition, const Box &storage,
                           double viscosity, double shift, bool hold_mean) :
    fourier_(grid, decomposition, storage),
    modes_(grid.walls ? make_walled_modes(grid, fourier_.modes(), viscosity, shift)
                      : make_periodic_modes(grid, fourier_.modes(), viscosity, shift, hold_mean))
{
}

std::array<View<Complex>, 3> StokesSolver::spectrum() const
{
  return {fourier_.spectrum(0), fourier_.spectrum(1), fourier_.spectrum(2)};
}

void StokesSolver::velocity(const VectorField &force, const Drive &drive,
                            const VectorField &velocity)
{
  fourier_.forward(force.views());
  modes_->solve(spectrum(), drive, nullptr);
  fourier_.backward(velocity.views());
}

void StokesSolver::pressure(const VectorField &force, const Drive &drive,
                            const ScalarField &pressure)
{
  if (!pressure_modes_.bytes()) pressure_modes_ = Components<Complex, 1>(fourier_.modes());
  const View<Complex> modes = pressure_modes_[0];
  fourier_.forward(force.views());
  modes_->solve(spectrum(), drive, &modes);
  std::copy_n(modes.data, modes.box.size(), fourier_.spectrum(0).data);
  fourier_.backward(pressure.views());
}

}    // namespace fluid
