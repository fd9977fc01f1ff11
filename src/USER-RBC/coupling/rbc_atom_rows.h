#ifndef LMP_RBC_ATOM_ROWS_H
#define LMP_RBC_ATOM_ROWS_H

#include "geometry/tight_vector.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace LAMMPS_NS {

/// Three numbers for each atom here, ghosts too, in the form that LAMMPS's exchange of ghosts asks
/// for: pack functions fill buf and return how many numbers they wrote.
class AtomRows {
 public:
  /// All zero.
  void assign(int atoms)
  {
    rbc::reserve_tightly(values_, 3 * std::size_t(atoms));
    values_.assign(3 * std::size_t(atoms), 0.0);
  }
  /// Of any values.
  void resize(int atoms) { rbc::resize_tightly(values_, 3 * std::size_t(atoms)); }

  double *operator[](int i) { return values_.data() + 3 * std::size_t(i); }
  const double *operator[](int i) const { return values_.data() + 3 * std::size_t(i); }

  int pack(int n, const int *list, double *buf) const
  {
    for (int m = 0; m < n; ++m) std::copy_n((*this)[list[m]], 3, buf + 3 * std::size_t(m));
    return 3 * n;
  }
  void unpack(int n, int first, const double *buf)
  {
    std::copy_n(buf, 3 * std::size_t(n), (*this)[first]);
  }

  int pack_reverse(int n, int first, double *buf) const
  {
    std::copy_n((*this)[first], 3 * std::size_t(n), buf);
    return 3 * n;
  }
  void add_reverse(int n, const int *list, const double *buf)
  {
    for (int m = 0; m < n; ++m)
      for (int d = 0; d < 3; ++d) (*this)[list[m]][d] += buf[3 * std::size_t(m) + d];
  }

  std::size_t bytes() const { return values_.capacity() * sizeof(double); }

 private:
  std::vector<double> values_;
};

/// Who exchanges the rows of ghosts: a fix, which LAMMPS calls back. Collective.
class RowExchange {
 public:
  /// Ghosts get the rows of the atoms that they are copies of.
  virtual void send_to_ghosts(AtomRows &rows) = 0;

  /// The rows of ghosts are added to those of the atoms that they are copies of.
  virtual void add_from_ghosts(AtomRows &rows) = 0;

  /// Rows to work with, for users that work one at a time.
  AtomRows &work(int n) { return work_[n]; }

  std::size_t bytes() const { return work_[0].bytes() + work_[1].bytes(); }

 protected:
  ~RowExchange() = default;

 private:
  std::array<AtomRows, 2> work_;
};

}    // namespace LAMMPS_NS

#endif
