#pragma once

#include "lammpsplugin.h"

#include <vector>

namespace USER_RBC {

/// The package's styles, in the order of style_headers.h; `handle` is left for the plugin to fill
/// in.
std::vector<lammpsplugin_t> styles();

}    // namespace USER_RBC
