#pragma once

#include "membrane/mooney_rivlin.h"
#include "membrane/neo_hookean.h"
#include "membrane/skalak.h"

#include <variant>

namespace rbc {

/// The table of all sheet laws. A new law needs its header and its place here; fix rbc/membrane
/// finds it by its word (see law_table.h).
///
/// A law is a function of i1 = lambda1^2 + lambda2^2 and J = lambda1 lambda2 that returns a
/// SheetEnergy. At rest, i1 = 2 and J = 1, energy and tension vanish: density = 0 and 2 by_i1 +
/// by_J = 0. It must be free of branches and of calls that are not inlined, so that the loop over
/// triangles vectorises (see vector_loop.h): std::exp or std::log give right forces, slowly. The
/// order of the list is free.
using SheetLaw = std::variant<MooneyRivlin, NeoHookean, Skalak>;

}    // namespace rbc
