#include "fluid/fourier.h"

namespace fluid {

namespace {

// Estimated plans are the same in every run, so that a restarted run repeats the first bit for bit.
constexpr unsigned planning = FFTW_ESTIMATE;

fftw_complex *raw(Complex *p)
{
  return reinterpret_cast<fftw_complex *>(p);
}

/// Length of rows for transforms across them: at strides of an even number of cache lines, above
/// all at powers of two, few sets of the cache are used.
int padded(int columns)
{
  return columns % 8 == 0 ? columns + 4 : columns;
}

template <typename Visit> void for_each_plane(int components, const Box &box, Visit visit)
{
  if (box.empty()) return;
  for (int k = box.lo[2]; k < box.hi[2]; ++k)
    for (int c = 0; c < components; ++c) visit(c, k);
}

void join_values(const double *a, const double *b, Complex *z, int n)
{
  for (int i = 0; i < n; ++i) z[i] = {a[i], b[i]};
}

void split_values(const Complex *z, double *a, double *b, int n)
{
  for (int i = 0; i < n; ++i) {
    a[i] = z[i].real();
    b[i] = z[i].imag();
  }
}

/// Modes of a and b from those of z = a + i b.
void split_modes(const Complex *z, Complex *a, Complex *b, int n)
{
  a[0] = z[0].real();
  b[0] = z[0].imag();
  for (int k = 1; k <= n / 2; ++k) {
    const Complex p = z[k], q = z[n - k];
    a[k] = {0.5 * (p.real() + q.real()), 0.5 * (p.imag() - q.imag())};
    b[k] = {0.5 * (p.imag() + q.imag()), 0.5 * (q.real() - p.real())};
  }
}

void join_modes(const Complex *a, const Complex *b, Complex *z, int n)
{
  z[0] = {a[0].real(), b[0].real()};
  for (int k = 1; k < (n + 1) / 2; ++k) {
    z[k] = {a[k].real() - b[k].imag(), a[k].imag() + b[k].real()};
    z[n - k] = {a[k].real() + b[k].imag(), b[k].real() - a[k].imag()};
  }
  if (n % 2 == 0) z[n / 2] = {a[n / 2].real(), b[n / 2].real()};
}

}    // namespace

int fast_size(int n)
{
  for (;; ++n) {
    int rest = n;
    for (int factor : {2, 3, 5, 7})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return n;
  }
}

RowTransform::RowTransform(int length) : length_(length), rows_(std::size_t(pairs) * length)
{
  const auto plan = [&](int sign) {
    fftw_complex *rows = raw(rows_.data());
    return Plan(fftw_plan_many_dft(1, &length, pairs, rows, nullptr, 1, length, rows, nullptr, 1,
                                   length, sign, planning));
  };
  forward_ = plan(FFTW_FORWARD);
  backward_ = plan(FFTW_BACKWARD);
}

/// Incomplete pairs and batches of rows are padded by repeating the last row.
template <typename Join, typename Split>
void RowTransform::transform(const Plan &plan, int lo, int hi, Join join, Split split) const
{
  for (int first = lo; first < hi; first += 2 * pairs) {
    const auto for_each_pair = [&](auto visit) {
      for (int pair = 0; pair < pairs; ++pair) {
        const int j = std::min(first + 2 * pair, hi - 1);
        visit(j, std::min(j + 1, hi - 1), rows_.data() + std::ptrdiff_t(pair) * length_);
      }
    };
    for_each_pair(join);
    fftw_execute(plan.get());
    for_each_pair(split);
  }
}

void RowTransform::forward(const View<double> &values, const View<Complex> &modes, int lo, int hi,
                           int k) const
{
  transform(
      forward_, lo, hi,
      [&](int j, int next, Complex *row) {
        join_values(&values(0, j, k), &values(0, next, k), row, length_);
      },
      [&](int j, int next, const Complex *row) {
        split_modes(row, &modes(0, j, k), &modes(0, next, k), length_);
      });
}

void RowTransform::backward(const View<Complex> &modes, const View<double> &values, int lo, int hi,
                            int k) const
{
  transform(
      backward_, lo, hi,
      [&](int j, int next, Complex *row) {
        join_modes(&modes(0, j, k), &modes(0, next, k), row, length_);
      },
      [&](int j, int next, const Complex *row) {
        split_values(row, &values(0, j, k), &values(0, next, k), length_);
      });
}

Fourier::Fourier(const Grid &grid, const Decomposition &decomposition, std::size_t lent)
{
  const Pencils pencils = choose_pencils(grid, decomposition.bricks);
  const MPI_Comm comm = decomposition.comm;
  const int me = decomposition.rank;
  real_x_ = pencils.real_x[me];
  x_ = pencils.x[me];
  y_ = pencils.y[me];
  mode_bricks_ = pencils.z;
  to_x_ = {comm, decomposition.bricks, pencils.real_x};
  const std::size_t modes = 6 * pencils.z[me].size(), real = 3 * real_x_.size();
  work_ = Buffer<double>(std::max(lent, modes + (to_x_.identity() ? 0 : real)));
  modes_ = {pencils.z[me], reinterpret_cast<Complex *>(work_.data())};
  if (!to_x_.identity()) real_ = {real_x_, work_.data() + modes};
  y_to_z_ = {comm, pencils.y, pencils.z, &modes_};
  x_to_y_ = {comm, pencils.x, pencils.y, y_to_z_.identity() ? &modes_ : nullptr};

  x_transform_ = RowTransform(grid.cells[0]);
  const int ny = grid.cells[1], columns = y_.extent(0), row = padded(columns);
  y_in_place_ = y_to_z_.identity() && row == columns;
  plane_ =
      Buffer<Complex>(std::max(std::size_t(x_.extent(0)) * x_.extent(1), std::size_t(row) * ny));
  if (y_.empty()) return;
  const auto plan = [&](int sign) {
    fftw_complex *plane = raw(plane_.data());
    return Plan(fftw_plan_many_dft(1, &ny, columns, plane, nullptr, row, 1, plane, nullptr, row, 1,
                                   sign, planning));
  };
  y_forward_ = plan(FFTW_FORWARD);
  y_backward_ = plan(FFTW_BACKWARD);
}

template <std::size_t N>
std::array<View<double>, N> Fourier::rows(const std::array<View<double>, N> &values) const
{
  if (to_x_.identity()) return values;
  std::array<View<double>, N> rows;
  for (std::size_t c = 0; c < N; ++c) rows[c] = real_[c];
  return rows;
}

View<Complex> Fourier::x_plane(int component, int k) const
{
  if (x_to_y_.identity()) return y_plane(component, k);
  Box box = x_;
  box.lo[2] = k;
  return {plane_.data(), box};
}

View<Complex> Fourier::y_plane(int component, int k) const
{
  if (y_in_place_) return modes_[component];
  Box box = y_;
  box.hi[0] = box.lo[0] + padded(box.extent(0));
  box.lo[2] = k;
  return {plane_.data(), box};
}

void Fourier::transform_y(const Plan &plan, const View<Complex> &plane, int k) const
{
  fftw_complex *first = raw(&plane(y_.lo[0], 0, k));
  fftw_execute_dft(plan.get(), first, first);
}

template <std::size_t N> void Fourier::forward(const std::array<View<double>, N> &values)
{
  const std::array<View<double>, N> real = rows(values);
  if (!to_x_.identity()) to_x_.forward(values, real);

  const auto finish = [&](int c, const View<Complex> &plane, int k) {
    transform_y(y_forward_, plane, k);
    if (!y_in_place_) y_to_z_.from().put(c, plane, k);
  };
  for_each_plane(N, x_, [&](int c, int k) {
    const View<Complex> plane = x_plane(c, k);
    x_transform_.forward(real[c], plane, x_.lo[1], x_.hi[1], k);
    if (x_to_y_.identity())
      finish(c, plane, k);
    else
      x_to_y_.from().put(c, plane, k);
  });
  if (!x_to_y_.identity()) {
    x_to_y_.forward(N);
    for_each_plane(N, y_, [&](int c, int k) {
      const View<Complex> plane = y_plane(c, k);
      if (!y_in_place_) x_to_y_.to().take(c, plane, k);
      finish(c, plane, k);
    });
  }
  y_to_z_.forward(N);
}

template <std::size_t N> void Fourier::backward(const std::array<View<double>, N> &values)
{
  const std::array<View<double>, N> real = rows(values);
  y_to_z_.backward(N);

  const auto start = [&](int c, const View<Complex> &plane, int k) {
    if (!y_in_place_) y_to_z_.from().take(c, plane, k);
    transform_y(y_backward_, plane, k);
  };
  if (!x_to_y_.identity()) {
    for_each_plane(N, y_, [&](int c, int k) {
      const View<Complex> plane = y_plane(c, k);
      start(c, plane, k);
      if (!y_in_place_) x_to_y_.to().put(c, plane, k);
    });
    x_to_y_.backward(N);
  }
  for_each_plane(N, x_, [&](int c, int k) {
    const View<Complex> plane = x_plane(c, k);
    if (x_to_y_.identity())
      start(c, plane, k);
    else
      x_to_y_.from().take(c, plane, k);
    x_transform_.backward(plane, real[c], x_.lo[1], x_.hi[1], k);
  });
  if (!to_x_.identity()) to_x_.backward(real, values);
}

Traffic Fourier::traffic() const
{
  Traffic sum;
  for (const Traffic &part : {to_x_.traffic(), x_to_y_.traffic(), y_to_z_.traffic()}) {
    sum.messages += part.messages;
    sum.bytes += part.bytes;
  }
  return sum;
}

std::size_t Fourier::bytes() const
{
  return work_.bytes() + plane_.bytes() + to_x_.bytes() + x_to_y_.bytes() + y_to_z_.bytes();
}

template void Fourier::forward<1>(const std::array<View<double>, 1> &);
template void Fourier::forward<3>(const std::array<View<double>, 3> &);
template void Fourier::backward<3>(const std::array<View<double>, 3> &);
template void Fourier::backward<1>(const std::array<View<double>, 1> &);

}    // namespace fluid
