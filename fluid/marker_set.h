#pragma once

namespace fluid {

enum class KernelKind { roma3, peskin4 };

/// The narrower kernel is nearer to lubrication in the gaps of dense blood, see theory.rst.
inline constexpr KernelKind default_kernel = KernelKind::roma3;

/// Sheets are surfaces with fluid on both sides. Their velocity is corrected for what kernels blur,
/// see sheet_correction(). Layers are sheets between fluids of two viscosities: not their velocity
/// but their force is corrected, to the same effect, so that they see their double layer (see
/// DoubleLayer) as it was spread.
enum class MarkerKind { points, sheets, layers };

/// Points of the immersed boundary: `index[0 .. count)` select rows of the arrays of positions,
/// forces and velocities, which hold three numbers a row.
struct MarkerSet {
  KernelKind kernel = default_kernel;
  MarkerKind kind = MarkerKind::points;
  int count = 0;
  const int *index = nullptr;
  const double *position = nullptr;
};

}    // namespace fluid
