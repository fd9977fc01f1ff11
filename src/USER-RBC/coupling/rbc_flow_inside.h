#ifndef LMP_RBC_FLOW_INSIDE_H
#define LMP_RBC_FLOW_INSIDE_H

#include "cells/rbc_region_enclosure.h"
#include "fluid/interior.h"
#include "lmptype.h"
#include "pointers.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

/// A region that stays where it is, ready to be asked for points. `use` ends the message if it does
/// not exist, or moves.
class Region *fixed_region(LAMMPS *lmp, const std::string &id, const std::string &use);

/// The part of a flow that lies in a region, the inside of a vessel. Found when first asked for.
class FlowInside : protected Pointers {
 public:
  /// The style is for messages. Without a region the inside is the whole box.
  FlowInside(LAMMPS *lmp, std::string style, std::string region);

  const std::string &style() const { return style_; }
  const std::string &region() const { return region_id_; }    ///< empty: none was given

  /// Call when the region or the decomposition of the flow may have changed: the inside is found
  /// anew when next asked for.
  void forget()
  {
    interior_.reset();
    version_ = -1;
  }

  /// Collective, like what follows.
  double volume(const fluid::Flow &flow);

  /// Mean velocity of the fluid inside, computed once for each `version`. There must be a region.
  /// Collective.
  const fluid::Real3 &mean_velocity(fluid::Flow &flow, bigint version);

  /// The share of each cell that lies inside, found at the first call; null if no region was given.
  /// It is an error if the region does not exist, moves, or is empty.
  fluid::Interior *find(const fluid::Flow &flow);

  /// The region, null if none was given; errors as of find().
  std::unique_ptr<RegionEnclosure> enclosure() const;

 private:
  std::string style_, region_id_;
  std::unique_ptr<fluid::Interior> interior_;
  fluid::Real3 velocity_{0, 0, 0};
  bigint version_ = -1;
};

}    // namespace LAMMPS_NS

#endif
