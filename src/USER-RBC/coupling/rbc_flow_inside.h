#ifndef LMP_RBC_FLOW_INSIDE_H
#define LMP_RBC_FLOW_INSIDE_H

#include "fluid/interior.h"
#include "lmptype.h"
#include "pointers.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

/// The part of a flow that lies in a region, the inside of a vessel. Found when first asked for.
class FlowInside : protected Pointers {
 public:
  /// The style is for messages. Without a region the inside is the whole box.
  FlowInside(LAMMPS *lmp, std::string style, std::string region);

  const std::string &style() const { return style_; }

  /// The region, or the decomposition of the flow, may be another.
  void forget()
  {
    interior_.reset();
    version_ = -1;
  }

  /// Collective, like what follows.
  double volume(const fluid::Flow &flow);

  /// Computed once for each version of the flow. Not for the whole box.
  const fluid::Real3 &mean_velocity(fluid::Flow &flow, bigint version);

  /// Null for the whole box.
  fluid::Interior *find(const fluid::Flow &flow);

 private:
  std::string style_, region_id_;
  std::unique_ptr<fluid::Interior> interior_;
  fluid::Real3 velocity_{0, 0, 0};
  bigint version_ = -1;
};

}    // namespace LAMMPS_NS

#endif
