#include "fourier.h"

namespace fluid {

namespace {

// Estimated plans are the same in every run, so that a restarted run repeats the first bit for bit.
constexpr unsigned planning = FFTW_ESTIMATE;

fftw_complex *raw(Complex *p)
{
  return reinterpret_cast<fftw_complex *>(p);
}

template <std::size_t N> std::array<View<Complex>, N> leading(const Components<Complex, 3> &all)
{
  std::array<View<Complex>, N> views;
  for (std::size_t c = 0; c < N; ++c) views[c] = all[c];
  return views;
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

Fourier::Fourier(const Grid &grid, const Decomposition &decomposition, const Box &storage)
{
  const Pencils pencils = choose_pencils(grid, decomposition.bricks);
  const MPI_Comm comm = decomposition.comm;
  to_x_ = {comm, decomposition.bricks, pencils.real_x};
  x_to_y_ = {comm, pencils.x, pencils.y};
  y_to_z_ = {comm, pencils.y, pencils.z};

  const int me = decomposition.rank;
  row_box_ = pencils.real_x[me];
  mode_bricks_ = pencils.z;
  storage_[0] = Modes(pencils.z[me]);
  z_ = &storage_[0];
  if (!y_to_z_.identity()) storage_[1] = Modes(pencils.y[me]);
  y_ = y_to_z_.identity() ? z_ : &storage_[1];
  if (!x_to_y_.identity()) storage_[2] = Modes(pencils.x[me]);
  x_ = x_to_y_.identity() ? y_ : &storage_[2];
  if (!to_x_.identity()) real_ = VectorField(row_box_);

  const int nx = grid.cells[0], ny = grid.cells[1], modes = nx / 2 + 1;
  if (!row_box_.empty()) {
    const Box &stored = to_x_.identity() ? storage : row_box_;
    const int stride = stored.extent(0), rows = row_box_.extent(1);
    Buffer<double> values(std::size_t(stride) * rows);
    Buffer<Complex> spectrum(std::size_t(modes) * rows);
    x_forward_ = Plan(fftw_plan_many_dft_r2c(1, &nx, rows, values.data(), nullptr, 1, stride,
                                             raw(spectrum.data()), nullptr, 1, modes,
                                             planning | FFTW_UNALIGNED));
    x_backward_ =
        Plan(fftw_plan_many_dft_c2r(1, &nx, rows, raw(spectrum.data()), nullptr, 1, modes,
                                    values.data(), nullptr, 1, stride, planning | FFTW_UNALIGNED));
  }
  if (!y_->box().empty()) {
    const int columns = y_->box().extent(0);
    Buffer<Complex> plane(std::size_t(columns) * ny);
    const auto plan = [&](int sign) {
      return Plan(fftw_plan_many_dft(1, &ny, columns, raw(plane.data()), nullptr, columns, 1,
                                     raw(plane.data()), nullptr, columns, 1, sign, planning));
    };
    y_forward_ = plan(FFTW_FORWARD);
    y_backward_ = plan(FFTW_BACKWARD);
  }
}

View<double> Fourier::rows(const View<double> &values, int component) const
{
  return to_x_.identity() ? values : real_[component];
}

template <std::size_t N> void Fourier::forward(const std::array<View<double>, N> &values)
{
  std::array<View<double>, N> real;
  for (std::size_t c = 0; c < N; ++c) real[c] = rows(values[c], c);
  if (!to_x_.identity()) to_x_.forward(values, real);

  const bool planes_whole = x_to_y_.identity();
  const auto transform_y = [&](std::size_t c, int k) {
    const View<Complex> modes = (*y_)[c];
    fftw_complex *plane = raw(&modes(modes.box.lo[0], 0, k));
    fftw_execute_dft(y_forward_.get(), plane, plane);
  };

  if (!row_box_.empty())
    for (std::size_t c = 0; c < N; ++c)
      for (int k = row_box_.lo[2]; k < row_box_.hi[2]; ++k) {
        const View<Complex> modes = (*x_)[c];
        fftw_execute_dft_r2c(x_forward_.get(), &real[c](0, row_box_.lo[1], k),
                             raw(&modes(0, row_box_.lo[1], k)));
        if (planes_whole) transform_y(c, k);
      }
  if (!planes_whole) {
    x_to_y_.forward(leading<N>(*x_), leading<N>(*y_));
    if (!y_->box().empty())
      for (std::size_t c = 0; c < N; ++c)
        for (int k = y_->box().lo[2]; k < y_->box().hi[2]; ++k) transform_y(c, k);
  }
  if (!y_to_z_.identity()) y_to_z_.forward(leading<N>(*y_), leading<N>(*z_));
}

template <std::size_t N> void Fourier::backward(const std::array<View<double>, N> &values)
{
  if (!y_to_z_.identity()) y_to_z_.backward(leading<N>(*z_), leading<N>(*y_));

  const bool planes_whole = x_to_y_.identity();
  const auto transform_y = [&](std::size_t c, int k) {
    const View<Complex> modes = (*y_)[c];
    fftw_complex *plane = raw(&modes(modes.box.lo[0], 0, k));
    fftw_execute_dft(y_backward_.get(), plane, plane);
  };
  if (!planes_whole) {
    if (!y_->box().empty())
      for (std::size_t c = 0; c < N; ++c)
        for (int k = y_->box().lo[2]; k < y_->box().hi[2]; ++k) transform_y(c, k);
    x_to_y_.backward(leading<N>(*y_), leading<N>(*x_));
  }

  std::array<View<double>, N> real;
  for (std::size_t c = 0; c < N; ++c) real[c] = rows(values[c], c);
  if (!row_box_.empty())
    for (std::size_t c = 0; c < N; ++c)
      for (int k = row_box_.lo[2]; k < row_box_.hi[2]; ++k) {
        if (planes_whole) transform_y(c, k);
        const View<Complex> modes = (*x_)[c];
        fftw_execute_dft_c2r(x_backward_.get(), raw(&modes(0, row_box_.lo[1], k)),
                             &real[c](0, row_box_.lo[1], k));
      }
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
  std::size_t sum = real_.bytes() + to_x_.bytes() + x_to_y_.bytes() + y_to_z_.bytes();
  for (const Modes &modes : storage_) sum += modes.bytes();
  return sum;
}

template void Fourier::forward<3>(const std::array<View<double>, 3> &);
template void Fourier::backward<3>(const std::array<View<double>, 3> &);
template void Fourier::backward<1>(const std::array<View<double>, 1> &);

}    // namespace fluid
