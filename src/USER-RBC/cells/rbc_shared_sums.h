#ifndef LMP_RBC_SHARED_SUMS_H
#define LMP_RBC_SHARED_SUMS_H

#include "pointers.h"

#include <mpi.h>
#include <vector>

namespace LAMMPS_NS {

/// Sums over the ranks that have parts of the same cells. A rank exchanges one message with each
/// rank that it shares a cell with, and knows of no other.
class SharedSums : protected Pointers {
 public:
  explicit SharedSums(LAMMPS *lmp) : Pointers(lmp) {}

  /// A cell of which this rank has a part.
  struct Part {
    int cell;     ///< its number among all cells
    int place;    ///< of its values among those that are summed
  };

  /// Collective, after atoms migrated: finds the ranks that have parts of the same cells.
  void find_partners(std::vector<Part> parts);

  /// Sums the values of each part, `width` numbers at values[place * width], over the ranks that
  /// have one of its cell. All of them get the same to the last bit. All ranks that have parts
  /// must call it.
  void sum(double *values, int width);

  /// Whether ranks share cells; the same on all of them.
  bool any() const { return any_; }

 private:
  /// A rank that this one shares cells with, and where their values are, in the order of the cells.
  struct Partner {
    int rank;
    std::vector<int> places;
  };
  /// A rank that has a part of a cell.
  struct Holder {
    int cell, rank;
  };

  std::vector<Partner> partners_;    ///< in ascending order of rank
  std::vector<int> places_;          ///< of the values of all parts
  bool any_ = false;
  std::vector<double> own_, sent_, received_;
  std::vector<MPI_Request> requests_;

  std::vector<Holder> find_others(const std::vector<Part> &parts);
  static int introduce(int count, char *in, int &flag, int *&ranks, char *&out, void *self);
  void exchange(const double *values, int width);
};

}    // namespace LAMMPS_NS

#endif
