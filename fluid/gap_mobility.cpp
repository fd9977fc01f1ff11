#include "fluid/gap_mobility.h"

#include "fluid/kernel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fluid {

namespace {

constexpr double pi = 3.14159265358979323846;

// Sliding that is missing counts as zero where it is less than this part of the gap.

constexpr double negligible = 0.03;

constexpr int intervals_per_cell = 16;
constexpr double widest_gap = 4;

// ---- two sheets: waves across them

constexpr double wavenumber_step = 0.01, largest_wavenumber = 25;
constexpr int places = 32;    // of a marker in its cell

/// A direction of the normal and its weight in the mean over all directions, which is that of
/// Lebedev's 26 points on the sphere.
struct Direction {
  std::array<double, 3> normal;
  double weight;
};

const std::array<Direction, 3> &directions()
{
  static const double half = std::sqrt(0.5), third = std::sqrt(1.0 / 3);
  static const std::array<Direction, 3> list = {
      {{{1, 0, 0}, 2.0 / 7}, {{half, half, 0}, 16.0 / 35}, {{third, third, third}, 9.0 / 35}}};
  return list;
}

/// Fourier transform of a kernel: the mean over the places of a marker.
template <class Kernel> double transform(double wavenumber)
{
  double sum = 0;
  for (int n = 0; n < places; ++n) {
    const double place = (n + 0.5) / places;
    double w[4];
    const int first = Kernel::weights(place, w);
    for (int m = 0; m < Kernel::width; ++m)
      sum += w[m] * std::cos(wavenumber * (first + m - place));
  }
  return sum / places;
}

/// Velocities of sheets in the flow of a wave of forces across them, of unit size and viscosity,
/// for each wavenumber. `differences` are those of the grid, k^2 for long waves.
template <class Kernel> std::vector<double> sheet_mobility(const std::array<double, 3> &normal)
{
  std::vector<double> mobility;
  for (double k = wavenumber_step / 2; k < largest_wavenumber; k += wavenumber_step) {
    double kernel = 1, differences = 0;
    for (double along : normal) {
      if (along == 0) continue;
      kernel *= transform<Kernel>(k * along);
      differences += 4 * std::pow(std::sin(k * along / 2), 2);
    }
    mobility.push_back(
        kernel * kernel *
        (1 / differences + Kernel::second_correction + Kernel::fourth_correction * differences));
  }
  return mobility;
}

/// Mean over all directions.
template <class Kernel> std::vector<double> mean_sheet_mobility()
{
  std::vector<double> mean;
  for (const Direction &direction : directions()) {
    const auto mobility = sheet_mobility<Kernel>(direction.normal);
    mean.resize(mobility.size());
    for (std::size_t n = 0; n < mean.size(); ++n) mean[n] += direction.weight * mobility[n];
  }
  return mean;
}

/// What sheets of opposite tractions slide too little.
double missing_slide(const std::vector<double> &mobility, double gap)
{
  double sum = 0;
  for (std::size_t n = 0; n < mobility.size(); ++n)
    sum += mobility[n] * (1 - std::cos((static_cast<double>(n) + 0.5) * wavenumber_step * gap));
  return gap - 2 * sum * wavenumber_step / pi;
}

// ---- a sheet and a double layer: waves of layers across them

/// What a sheet sees of layers, as sheet_mobility(); 1 / k for long waves.
template <class Kernel> std::vector<double> layer_waves(const std::array<double, 3> &normal)
{
  std::vector<double> seen;
  for (double k = wavenumber_step / 2; k < largest_wavenumber; k += wavenumber_step) {
    double kernel = 1, differences = 0, slope = 0;
    for (double along : normal) {
      if (along == 0) continue;
      const double difference = 2 * std::sin(k * along / 2);
      kernel *= transform<Kernel>(k * along);
      differences += difference * difference;
      slope += along * difference;
    }
    seen.push_back(kernel * kernel * slope / differences);
  }
  return seen;
}

template <class Kernel> std::vector<double> mean_layer_waves()
{
  std::vector<double> mean;
  for (const Direction &direction : directions()) {
    const auto seen = layer_waves<Kernel>(direction.normal);
    mean.resize(seen.size());
    for (std::size_t n = 0; n < mean.size(); ++n) mean[n] += direction.weight * seen[n];
  }
  return mean;
}

double share_across(const std::vector<double> &seen, double gap)
{
  double sum = 0;
  for (std::size_t n = 0; n < seen.size(); ++n)
    sum += seen[n] * std::sin((static_cast<double>(n) + 0.5) * wavenumber_step * gap);
  return 0.5 - sum * wavenumber_step / pi;
}

// ---- a sheet and a plate half a cell before the first point of the grid

constexpr int points = 10;

/// The flow beyond a plate is its odd reflection. A force at point k gives the velocity min(z_j,
/// z_k) at point j, and second differences are minus the forces.
template <class Kernel> double missing_slide_at_plate(double gap)
{
  std::array<double, points> force{};
  double w[4];
  const int first = Kernel::weights(gap - 0.5, w);
  for (int n = 0; n < Kernel::width; ++n) {
    const int point = first + n;
    if (point < 0)
      force[-1 - point] -= w[n];
    else
      force[point] += w[n];
  }
  double slide = 0;
  for (int j = 0; j < points; ++j) {
    const double before = j > 0 ? force[j - 1] : -force[0];
    const double after = j + 1 < points ? force[j + 1] : 0;
    for (int k = 0; k < points; ++k) slide += force[j] * force[k] * (std::min(j, k) + 0.5);
    slide += Kernel::second_correction * force[j] * force[j];
    slide -= Kernel::fourth_correction * force[j] * (before + after - 2 * force[j]);
  }
  return gap - slide;
}

// ---- tables

/// Gap from which on what is missing is negligible.
template <class Missing> double find_range(Missing missing)
{
  double gap = 1.0 / intervals_per_cell;
  while (gap < widest_gap && missing(gap) > negligible * gap) gap += 1.0 / intervals_per_cell;
  return gap;
}

/// Values from 0 to `range`, lowered so that they end with zero.
template <class Missing> std::vector<double> tabulate(double range, Missing missing)
{
  const int intervals = static_cast<int>(std::lround(range * intervals_per_cell));
  const double rest = missing(range);
  std::vector<double> values;
  for (int n = 0; n <= intervals; ++n) {
    const double part = static_cast<double>(n) / intervals;
    values.push_back(std::max(0.0, missing(part * range) - part * part * rest));
  }
  return values;
}

}    // namespace

double GapMobility::Table::at(double gap) const
{
  if (gap <= 0 || gap >= range) return 0;
  const double place = gap / range * static_cast<double>(value.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), value.size() - 2);
  const double part = place - static_cast<double>(below);
  return (1 - part) * value[below] + part * value[below + 1];
}

template <class Kernel> void GapMobility::fill()
{
  const auto make = [](auto missing) {
    const double range = find_range(missing);
    return Table{range, tabulate(range, missing)};
  };
  slide_ = make([mobility = mean_sheet_mobility<Kernel>()](double gap) {
    return missing_slide(mobility, gap);
  });
  plate_ = make(missing_slide_at_plate<Kernel>);

  const auto share = [seen = mean_layer_waves<Kernel>()](double gap) {
    return share_across(seen, gap);
  };
  share_.range = find_range(share);
  const int intervals = static_cast<int>(std::lround(share_.range * intervals_per_cell));
  for (int n = 0; n < intervals; ++n)
    share_.value.push_back(std::max(0.0, share(static_cast<double>(n) / intervals_per_cell)));
  share_.value.push_back(0);
}

GapMobility::GapMobility(KernelKind kernel)
{
  if (kernel == KernelKind::peskin4)
    fill<Peskin4>();
  else
    fill<Roma3>();
}

}    // namespace fluid
