#pragma once

#include "contact/contact_laws.h"

#include <variant>

namespace rbc {

/// A contact law without its adhesion: how a surface acts on another to which it never sticks, such
/// as a plate. It begins at the gap at which two surfaces of the law rest without load; its force
/// and energy are zero there, and as large as those of the law further in.
class RepulsivePart {
 public:
  explicit RepulsivePart(const ContactLaw &law) :
      law_(law), tip_radius_(std::visit([](const auto &of) { return of.tip_radius(); }, law)),
      range_(tip_radius_ -
             std::visit([](const auto &of) { return of.equilibrium_overlap(); }, law)),
      work_(std::visit([](const auto &of) { return of.work_per_area(); }, law))
  {
  }

  /// Gap at which it begins.
  double range() const { return range_; }

  /// Traction and energy at a gap below range(); a negative gap is behind the surface.
  ContactTraction at(double gap) const
  {
    const double overlap = tip_radius_ - gap;
    const auto [traction, energy] =
        std::visit([overlap](const auto &of) { return of.per_area(overlap); }, law_);
    return {traction, energy + work_};
  }

 private:
  ContactLaw law_;
  double tip_radius_, range_, work_;
};

}    // namespace rbc
