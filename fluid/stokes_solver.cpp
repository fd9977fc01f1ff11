#include "fluid/stokes_solver.h"

namespace fluid {

StokesSolver::StokesSolver(const Grid &grid, const Decomposition &decomposition, double viscosity,
                           double shift, bool hold_mean, Scheme scheme, std::size_t lent) :
    fourier_(grid, decomposition, lent),
    modes_(!grid.plates ? make_periodic_modes(grid, fourier_.modes(), viscosity, shift, hold_mean)
           : scheme == Scheme::projection
               ? make_projected_modes(grid, fourier_.modes(), viscosity, shift)
               : make_coupled_modes(grid, fourier_.modes(), viscosity, shift))
{
}

std::array<View<Complex>, 3> StokesSolver::spectrum() const
{
  return {fourier_.spectrum(0), fourier_.spectrum(1), fourier_.spectrum(2)};
}

/// The modes of the velocity are in spectrum() then.
void StokesSolver::solve(const VectorField &force, const Forcing &forcing,
                         const View<Complex> *pressure, const ScalarField *source)
{
  if (source) {
    if (!source_modes_.bytes()) source_modes_ = Components<Complex, 1>(fourier_.modes());
    fourier_.forward(source->views());
    std::copy_n(fourier_.spectrum(0).data, fourier_.modes().size(), source_modes_[0].data);
  }
  const View<Complex> source_modes = source_modes_[0];
  fourier_.forward(force.views());
  modes_->solve(spectrum(), forcing, pressure, source ? &source_modes : nullptr);
}

void StokesSolver::velocity(const VectorField &force, const Forcing &forcing,
                            const VectorField &velocity, const ScalarField *source)
{
  solve(force, forcing, nullptr, source);
  fourier_.backward(velocity.views());
}

void StokesSolver::pressure(const VectorField &force, const Forcing &forcing,
                            const ScalarField &pressure, const ScalarField *source)
{
  const Components<Complex, 1> *const kept = modes_->kept_pressure();
  if (!kept && !pressure_modes_.bytes()) pressure_modes_ = Components<Complex, 1>(fourier_.modes());
  const View<Complex> modes = kept ? (*kept)[0] : pressure_modes_[0];
  if (!kept) solve(force, forcing, &modes, source);
  std::copy_n(modes.data, modes.box.size(), fourier_.spectrum(0).data);
  fourier_.backward(pressure.views());
}

std::size_t StokesSolver::bytes() const
{
  const Components<Complex, 1> *const kept = modes_->kept_pressure();
  return fourier_.bytes() + pressure_modes_.bytes() + source_modes_.bytes() +
         (kept ? kept->bytes() : 0);
}

}    // namespace fluid
