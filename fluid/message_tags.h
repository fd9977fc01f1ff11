#pragma once

namespace fluid {

/// Tags of messages: a count of messages can tell what they are for.
enum MessageTag {
  HALO_TAG = 2001,              ///< layers of cells around a brick
  REDISTRIBUTION_TAG = 2002,    ///< of arrays from bricks to those of the transforms
  TRANSPOSITION_TAG = 2003      ///< of transforms
};

}    // namespace fluid
