#include "cells/rbc_atom_mark.h"

#include "atom.h"
#include "domain.h"

#include <cstring>

using namespace LAMMPS_NS;

namespace {

/// Hash of 64-bit words that depends on their order (FNV-1a, with the high bits folded in).
class Hash {
 public:
  void add(std::int64_t number) { mix(static_cast<std::uint64_t>(number)); }
  void add(const double *numbers, int count)
  {
    for (int n = 0; n < count; ++n) {
      std::uint64_t bits;
      std::memcpy(&bits, numbers + n, sizeof(bits));
      mix(bits);
    }
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037u;

  void mix(std::uint64_t word)
  {
    value_ = (value_ ^ word) * 1099511628211u;
    value_ ^= value_ >> 32;
  }
};

}    // namespace

std::uint64_t AtomMark::now() const
{
  Hash hash;
  hash.add(domain->boxlo, 3);
  hash.add(domain->boxhi, 3);
  hash.add(atom->nlocal);
  hash.add(atom->nghost);
  for (int i = 0; i < atom->nlocal; ++i) {
    hash.add(atom->tag[i]);
    hash.add(atom->molecule[i]);
    hash.add(atom->image[i]);
    hash.add(atom->x[i], 3);
  }
  return hash.value();
}

void AtomMark::set()
{
  mark_ = now();
  is_set_ = true;
}

bool AtomMark::is_old() const
{
  return !is_set_ || mark_ != now();
}
