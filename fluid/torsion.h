#pragma once

#include "fluid/grid.h"

#include <cstdint>
#include <vector>

namespace fluid {

/// The solution of lap w = -1 in some cells of a grid with w = 0 in all others: smooth and
/// positive, across a duct Poiseuille's profile. The cells are offsets in the grid's domain, in
/// ascending order; periodic sides do not part them. Without plates they must not be all cells, as
/// there is no solution then. Not parallel.
std::vector<double> torsion_function(const Grid &grid, const std::vector<std::int64_t> &cells);

}    // namespace fluid
