#include "fluid/rigid_surface.h"

#include <Eigen/LU>

#include <cmath>
#include <numeric>

namespace fluid {

namespace {

// farthest: forces are extrapolated over at most this many intervals between the last two
// evaluations. sure: an iteration with kept directions alone is the last one if it should leave
// less than this part of the residual allowed.
constexpr double farthest = 1.5;
constexpr double sure = 0.8;

// If the slip is above the one allowed but the residual is below this part of it, the rest of the
// slip is the compliance of the markers, which iterations cannot lower.
constexpr double negligible = 0.3;

// Factor by which the use of a direction in the past counts less with each evaluation.
constexpr double memory = 0.8;

constexpr double longest = 4;    ///< steps along the preconditioned residual, and their inverse

void reduce(double *values, std::ptrdiff_t count, MPI_Op operation, const Flow &flow)
{
  MPI_Allreduce(MPI_IN_PLACE, values, static_cast<int>(count), MPI_DOUBLE, operation,
                flow.decomposition().comm);
}

/// Largest component of the velocity on this rank.
double fastest(const Flow &flow)
{
  double speed = 0;
  const auto u = flow.velocity().views();
  const int first = flow.brick().lo[0], n = flow.brick().extent(0);
  for (int c = 0; c < 3; ++c)
    for_each_row(flow.brick(), [&](int j, int k) {
      const double *const row = &u[c](first, j, k);
      double largest = 0;
#pragma omp simd reduction(max : largest)
      for (int i = 0; i < n; ++i) largest = std::max(largest, std::abs(row[i]));
      speed = std::max(speed, largest);
    });
  return speed;
}

using Rows = Eigen::Map<Eigen::Matrix<double, 3, Eigen::Dynamic>>;
using ConstRows = Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>>;

Rows rows(Eigen::VectorXd &vector)
{
  return {vector.data(), 3, vector.size() / 3};
}

ConstRows rows(const Eigen::VectorXd &vector)
{
  return {vector.data(), 3, vector.size() / 3};
}

double largest_row(const Eigen::VectorXd &vector)
{
  return vector.size() ? std::sqrt(rows(vector).colwise().squaredNorm().maxCoeff()) : 0;
}

}    // namespace

void RigidSurface::set_markers(const Flow &flow, KernelKind kernel, int count,
                               const double *position, const int *body)
{
  index_.resize(count);
  std::iota(index_.begin(), index_.end(), 0);
  const std::ptrdiff_t numbers = 3 * std::ptrdiff_t(count);
  for (Vector *vector : {&target_, &force_, &earlier_}) vector->setZero(numbers);
  for (Vector *vector :
       {&residual_, &step_, &response_, &direction_, &change_, &compliance_step_, &compliance_})
    vector->resize(numbers);
  built_ = position_ = Eigen::Map<const Vector>(position, numbers);
  release();
  markers_ = {kernel, settings_.kind, count, index_.data(), position_.data()};
  times_.known = 0;
  directions_.resize(numbers, settings_.most_directions);
  responses_.resize(numbers, settings_.most_directions);
  use_.setZero(settings_.most_directions);
  shares_.setZero(settings_.most_directions);
  forget_directions();

  preconditioner_.build(flow, markers_, body);
  if (!settings_.free_mean) return;
  uniform_.resize(numbers, 3);
  for (int d = 0; d < 3; ++d) {
    rows(change_).colwise() = Eigen::Vector3d::Unit(d);
    preconditioner_.apply(change_.data(), direction_.data());
    uniform_.col(d) = direction_;
    drag_.col(d) = rows(direction_).rowwise().sum();
  }
  reduce(drag_.data(), 9, MPI_SUM, flow);
  drag_ = drag_.inverse().eval();
}

void RigidSurface::move(const double *position)
{
  position_ = Eigen::Map<const Vector>(position, position_.size());
  forget_directions();
}

int RigidSurface::spread(Flow &flow, double time, const Real3 &others)
{
  double ahead = 0;
  if (times_.known == 2 && times_.last != times_.earlier)
    ahead = (time - times_.last) / (times_.last - times_.earlier);
  if (!(std::abs(ahead) <= farthest)) ahead = 0;
  change_ = force_ + ahead * (force_ - earlier_);
  if (times_.known == 0 || time != times_.last) {
    earlier_.swap(force_);
    times_.earlier = times_.last;
    times_.known = std::min(times_.known + 1, 2);
  }
  force_ = change_;
  times_.last = time;

  if (settings_.free_mean) {
    Eigen::Vector3d missing = -rows(force_).rowwise().sum();
    for (int d = 0; d < 3; ++d) missing[d] -= others[d];
    reduce(missing.data(), 3, MPI_SUM, flow);
    const Eigen::Vector3d velocity = drag_ * missing;
    force_.noalias() += uniform_ * velocity;
  }
  return flow.spread(markers_, force_.data(), 1.0);
}

/// The uniform velocity that directions without net force leave of a velocity, in the norm of the
/// preconditioner.
Eigen::Vector3d RigidSurface::uniform_part(const Flow &flow, const Vector &velocity) const
{
  Eigen::Vector3d part = uniform_.transpose() * velocity;
  reduce(part.data(), 3, MPI_SUM, flow);
  return drag_ * part;
}

bool RigidSurface::Limit::holds(double residual, double slip) const
{
  return slip <= allowed || residual <= std::min(allowed, negligible * slip);
}

RigidSurface::Outcome RigidSurface::enforce(Flow &flow)
{
  Outcome outcome;
  flow.fill_ghosts();
  flow.interpolate(markers_, response_.data());
  preconditioner_.apply_compliance(force_.data(), compliance_.data());
  residual_ = target_ - response_ - compliance_;

  Real3 mean_change{0, 0, 0};
  // largest residual and slip, which differ by what markers yield; speed
  double largest[3]{0, 0, std::max(fastest(flow), largest_row(target_))};
  int measured = outcome.solves;    // the solve whose speed it is
  while (true) {
    if (settings_.free_mean) {    // what residuals are without their uniform part
      const Eigen::Vector3d part = uniform_part(flow, residual_);
      rows(residual_).colwise() -= part;
      for (int d = 0; d < 3; ++d) mean_change[d] += part[d];
    }
    largest[0] = largest_row(residual_);
    change_ = residual_ + compliance_;
    largest[1] = largest_row(change_);
    reduce(largest, 3, MPI_MAX, flow);
    const Limit limit{settings_.tolerance * largest[2]};
    outcome.slip = largest[1] == 0 ? 0 : largest[1] / largest[2];
    outcome.converged = limit.holds(largest[0], largest[1]);
    if (outcome.converged && measured < outcome.solves) {
      // without good forces to start from, the flow was much faster at first
      add_mean(flow, mean_change);
      largest[2] = std::max(fastest(flow), largest_row(target_));
      measured = outcome.solves;
      continue;
    }
    if (outcome.converged || outcome.solves >= settings_.max_solves) break;
    const bool first = outcome.solves == 1;
    ++outcome.solves;
    if (!improve(flow, limit, first)) break;
  }
  add_mean(flow, mean_change);
  return outcome;
}

/// Takes the change of the mean velocity, where that is free, into the flow.
void RigidSurface::add_mean(Flow &flow, Real3 &change)
{
  if (!settings_.free_mean) return;
  flow.add_mean(change);
  for (int d = 0; d < 3; ++d) mean_[d] += change[d];
  change = {0, 0, 0};
}

/// One solve along the best combination of the directions known and, if that is not enough, along a
/// new direction as well. Returns false when round-off hides how the flow responds to the new one.
bool RigidSurface::improve(Flow &flow, const Limit &limit, bool first)
{
  combine_known_directions(flow, first);
  direction_ = change_ + compliance_;
  double left[2]{largest_row(change_), largest_row(direction_)};
  reduce(left, 2, MPI_MAX, flow);

  const bool enough = limit.holds(left[0] / sure, left[1] / sure);
  double products[2]{0, 0};    // of the new direction: with what is left, with its response
  if (!enough) products[0] = find_new_direction(flow);
  // The response of the directions known is residual_ - change_ but for a uniform velocity, which
  // no direction feels.
  change_ = residual_ - change_;
  apply_step(flow);
  if (enough) return true;

  change_ = (response_ - change_) / length_;
  products[1] = direction_.dot(change_);
  reduce(products, 2, MPI_SUM, flow);
  if (!(products[1] > 0 && products[0] > 0)) return false;
  add_direction(1 / std::sqrt(products[1]));
  length_ = std::min(std::max(products[0] / products[1], 1 / longest), longest);
  return true;
}

/// Sets step_ to the best combination of the directions known, and change_ to the residual that it
/// leaves. Directions count as used by what they take off the first residual of an evaluation; all
/// that they take off later ones is round-off.
void RigidSurface::combine_known_directions(const Flow &flow, bool first)
{
  const auto known = directions_.leftCols(known_), responses = responses_.leftCols(known_);
  auto shares = shares_.head(known_);
  shares.noalias() = known.transpose() * residual_;
  reduce(shares.data(), known_, MPI_SUM, flow);
  step_.noalias() = known * shares;
  change_.noalias() = residual_ - responses * shares;
  const double square = shares.squaredNorm();
  if (first && square > 0)
    use_.head(known_) = memory * use_.head(known_) + shares.cwiseAbs2() / square;
  if (settings_.free_mean) rows(change_).colwise() -= uniform_part(flow, change_);
}

/// Sets direction_ to the preconditioned residual that is left (change_), without its part along
/// the directions known, and adds it to step_. Returns this rank's part of its product with that
/// residual.
double RigidSurface::find_new_direction(const Flow &flow)
{
  const auto known = directions_.leftCols(known_), responses = responses_.leftCols(known_);
  precondition(flow, change_, direction_);
  shares_.head(known_).noalias() = responses.transpose() * direction_;
  reduce(shares_.data(), known_, MPI_SUM, flow);
  direction_.noalias() -= known * shares_.head(known_);
  step_ += length_ * direction_;
  return direction_.dot(change_);
}

/// Adds step_ to the forces, and what it changes to flow, response_ and residual_.
void RigidSurface::apply_step(Flow &flow)
{
  flow.apply_mobility(markers_, step_.data(), response_.data());
  flow.add_mobility_flow(1.0);
  force_ += step_;
  preconditioner_.apply_compliance(step_.data(), compliance_step_.data());
  response_ += compliance_step_;
  compliance_ += compliance_step_;
  residual_ -= response_;
}

/// Positive definite on forces without a sum.
void RigidSurface::precondition(const Flow &flow, const Vector &velocity, Vector &force)
{
  preconditioner_.apply(velocity.data(), force.data());
  if (!settings_.free_mean) return;
  Eigen::Vector3d sum = rows(force).rowwise().sum();
  reduce(sum.data(), 3, MPI_SUM, flow);
  const Eigen::Vector3d uniform_velocity = drag_ * sum;
  force.noalias() -= uniform_ * uniform_velocity;
}

/// Takes the place of the direction that was of least use when there are too many.
void RigidSurface::add_direction(double scale)
{
  int place = known_;
  if (known_ == settings_.most_directions)
    use_.minCoeff(&place);
  else
    ++known_;
  if (held_) keep_column(place);
  directions_.col(place) = scale * direction_;
  responses_.col(place) = scale * change_;
  use_[place] = 1;
}

std::size_t RigidSurface::bytes() const
{
  std::size_t numbers = uniform_.size() + directions_.size() + responses_.size();
  for (const Vector *vector :
       {&built_, &position_, &target_, &force_, &earlier_, &residual_, &step_, &response_,
        &direction_, &change_, &use_, &shares_, &compliance_, &compliance_step_})
    numbers += vector->size();
  return numbers * sizeof(double) + preconditioner_.bytes();
}

}    // namespace fluid
