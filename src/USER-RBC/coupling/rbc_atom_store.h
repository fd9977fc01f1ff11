#ifndef LMP_RBC_ATOM_STORE_H
#define LMP_RBC_ATOM_STORE_H

#include "coupling/rbc_immersed_markers.h"
#include "fix_store_atom.h"
#include "motion/integrator.h"

namespace LAMMPS_NS {

/// Keeps vectors of the markers in LAMMPS's fix STORE/ATOM, which moves them with the atoms and
/// writes them to restart files. Columns: number of known steps (only if the integrator counts
/// them), then three for each vector.
class AtomStore : public rbc::PointStore {
 public:
  explicit AtomStore(const ImmersedMarkers &markers) : markers_(markers) {}

  /// Columns that an integrator needs.
  static int columns(const rbc::Integrator &integrator)
  {
    return 3 * integrator.kept_vectors() + (integrator.counts_steps() ? 1 : 0);
  }

  void keep_in(FixStoreAtom *store, const rbc::Integrator &integrator)
  {
    store_ = store;
    first_ = integrator.counts_steps() ? 1 : 0;
  }

  void load(int vector, rbc::Numbers &values) const override
  {
    markers_.load(store_->astore, values, first_ + 3 * vector);
  }

  void store(int vector, const rbc::Numbers &values) override
  {
    markers_.store(values, store_->astore, first_ + 3 * vector);
  }

  int known_steps(std::size_t point) const override
  {
    return static_cast<int>(store_->astore[markers_.members()[point]][0]);
  }

  void set_known_steps(int steps) override
  {
    for (int i : markers_.members()) store_->astore[i][0] = steps;
  }

 private:
  const ImmersedMarkers &markers_;
  FixStoreAtom *store_ = nullptr;
  int first_ = 0;
};

}    // namespace LAMMPS_NS

#endif
