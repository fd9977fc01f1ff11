// What a RigidSurface knows of earlier evaluations: taken back, and kept in restart files.

#include "fluid/rigid_surface.h"

#include <algorithm>

namespace fluid {

struct RigidSurface::Held {
  Times times;
  Vector force, earlier, use;
  double length = 1;
  Real3 mean{0, 0, 0};
  int known = 0;

  /// Directions that others have taken the place of, with their responses.
  struct Column {
    int place;
    Vector direction, response;
  };
  std::vector<Column> columns;
};

RigidSurface::RigidSurface() = default;
RigidSurface::~RigidSurface() = default;

void RigidSurface::hold()
{
  held_ = std::make_unique<Held>();
  held_->times = times_;
  held_->force = force_;
  held_->earlier = earlier_;
  held_->use = use_;
  held_->length = length_;
  held_->mean = mean_;
  held_->known = known_;
}

void RigidSurface::release()
{
  held_.reset();
}

void RigidSurface::keep_column(int place)
{
  auto &columns = held_->columns;
  const auto is_it = [place](const Held::Column &column) { return column.place == place; };
  if (place >= held_->known || std::any_of(columns.begin(), columns.end(), is_it)) return;
  columns.push_back({place, directions_.col(place), responses_.col(place)});
}

void RigidSurface::restore()
{
  if (!held_) return;
  times_ = held_->times;
  force_ = held_->force;
  earlier_ = held_->earlier;
  use_ = held_->use;
  length_ = held_->length;
  mean_ = held_->mean;
  known_ = held_->known;
  for (const Held::Column &column : held_->columns) {
    directions_.col(column.place) = column.direction;
    responses_.col(column.place) = column.response;
  }
  held_.reset();
}

std::vector<double> RigidSurface::shared_memory(bool directions) const
{
  std::vector<double> shared{times_.last, times_.earlier, double(times_.known), length_};
  shared.insert(shared.end(), mean_.begin(), mean_.end());
  if (directions) shared.insert(shared.end(), use_.data(), use_.data() + known_);
  return shared;
}

std::vector<double> RigidSurface::marker_memory(bool directions) const
{
  std::vector<double> all;
  all.reserve(std::size_t(count()) * memory_of_marker(directions));
  for (std::ptrdiff_t first = 0; first < 3 * std::ptrdiff_t(count()); first += 3) {
    for (const Vector *vector : {&built_, &force_, &earlier_})
      all.insert(all.end(), vector->data() + first, vector->data() + first + 3);
    for (int k = 0; directions && k < known_; ++k)
      for (const Columns *columns : {&directions_, &responses_}) {
        const double *const column = columns->col(k).data() + first;
        all.insert(all.end(), column, column + 3);
      }
  }
  return all;
}

void RigidSurface::remember(const std::vector<double> &shared,
                            const std::vector<double> &of_markers)
{
  times_ = {shared[0], shared[1], static_cast<int>(shared[2])};
  length_ = shared[3];
  std::copy_n(shared.begin() + 4, 3, mean_.begin());
  known_ = std::min(static_cast<int>(shared.size()) - 7, settings_.most_directions);
  std::copy_n(shared.begin() + 7, known_, use_.data());
  const int of_marker = 3 * (3 + 2 * (static_cast<int>(shared.size()) - 7));
  for (int n = 0; n < count(); ++n) {
    const double *const own = of_markers.data() + std::size_t(n) * of_marker;
    for (int d = 0; d < 3; ++d) {
      const std::ptrdiff_t row = 3 * std::ptrdiff_t(n) + d;
      force_[row] = own[3 + d];
      earlier_[row] = own[6 + d];
      for (int k = 0; k < known_; ++k) {
        directions_(row, k) = own[9 + 6 * k + d];
        responses_(row, k) = own[12 + 6 * k + d];
      }
    }
  }
}

}    // namespace fluid
