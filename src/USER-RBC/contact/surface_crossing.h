#pragma once

#include "geometry/plain_vector.h"

#include <array>

namespace rbc {

/// A point that moves along a straight line in a step.
struct MovingPoint {
  PlainVector start, end;

  PlainVector at(double time) const { return (1 - time) * start + time * end; }
};

using MovingEdge = std::array<MovingPoint, 2>;
using MovingTriangle = std::array<MovingPoint, 3>;

/// Whether the point touches the triangle in the step, or the one edge the other. No contact is
/// missed. Nearer than 1e-6 of their size and of how far they move counts as contact, and so does
/// a pair that could not be told apart in 1000 advances.
///
/// This is conservative advancement (Mirtich, Impulse-based dynamic simulation of rigid body
/// systems, 1996, section 2.3.2) along a direction: the line between the closest points separates
/// the two until the first corner of the one meets a corner of the other along that line, a time
/// that is exact because all projections are linear in time. There a new line is found.
bool touch(const MovingPoint &point, const MovingTriangle &triangle);
bool touch(const MovingEdge &first, const MovingEdge &second);

/// Whether the triangles touch in the step: a corner of one the other, or two of their edges. They
/// must be apart at its start.
bool touch(const MovingTriangle &first, const MovingTriangle &second);

/// From the point of the edge cd that is closest to the edge ab, to the point of ab closest to it.
PlainVector line_between_edges(PlainVector a, PlainVector b, PlainVector c, PlainVector d);

/// From the point of the second triangle that is closest to the first, to the point of the first
/// that is closest to it. Separates them where they are apart.
PlainVector line_between(const std::array<PlainVector, 3> &first,
                         const std::array<PlainVector, 3> &second);

}    // namespace rbc
