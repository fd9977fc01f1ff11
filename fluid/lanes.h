#pragma once

#include "banded.h"
#include "field.h"
#include "wavenumbers.h"

namespace fluid {

// Modes of one ky are solved in blocks of neighbouring kx, one per lane.
constexpr int lanes = 8;
using Lanes = Lane<lanes>;

/// Reads `count` neighbouring modes from (kx, ky, k) on; the other lanes are zero.
inline void load(const View<std::complex<double>> &from, int kx, int ky, int k, int count,
                 Lanes &re, Lanes &im)
{
  const std::complex<double> *row = &from(kx, ky, k);
  const auto read = [&](int n) {
    for (int m = 0; m < n; ++m) {
      re[m] = row[m].real();
      im[m] = row[m].imag();
    }
  };
  if (count == lanes) {
    read(lanes);
    return;
  }
  re.setZero();
  im.setZero();
  read(count);
}

inline void store(const View<std::complex<double>> &to, int kx, int ky, int k, int count,
                  const Lanes &re, const Lanes &im)
{
  std::complex<double> *row = &to(kx, ky, k);
  const auto write = [&](int n) {
    for (int m = 0; m < n; ++m) row[m] = {re[m], im[m]};
  };
  if (count == lanes)
    write(lanes);
  else
    write(count);
}

/// Horizontal wave vectors of a block of modes: magnitude, direction, and the shift between faces and centres. The
/// mean mode counts as one of magnitude 1 along x, without meaning.
struct WaveVectors {
  Lanes kappa = Lanes::Ones(), x = Lanes::Ones(), y = Lanes::Zero();

  /// `mx`, `my` count from the first modes of `along_x`, `along_y`.
  WaveVectors(const Wavenumbers &along_x, const Wavenumbers &along_y, int mx, int my, int count)
  {
    ey_re_.setConstant(along_y.half_shift[my].real());
    ey_im_.setConstant(along_y.half_shift[my].imag());
    for (int m = 0; m < count; ++m) {
      const double kx = along_x.kappa[mx + m], ky = along_y.kappa[my];
      ex_re_[m] = along_x.half_shift[mx + m].real();
      ex_im_[m] = along_x.half_shift[mx + m].imag();
      const double magnitude = std::hypot(kx, ky);
      if (magnitude == 0) continue;
      kappa[m] = magnitude;
      x[m] = kx / magnitude;
      y[m] = ky / magnitude;
    }
  }

  void to_centres(Lanes &u_re, Lanes &u_im, Lanes &v_re, Lanes &v_im) const
  {
    rotate(u_re, u_im, ex_re_, ex_im_);
    rotate(v_re, v_im, ey_re_, ey_im_);
  }
  void to_faces(Lanes &u_re, Lanes &u_im, Lanes &v_re, Lanes &v_im) const
  {
    rotate(u_re, u_im, ex_re_, -ex_im_);
    rotate(v_re, v_im, ey_re_, -ey_im_);
  }

 private:
  static void rotate(Lanes &re, Lanes &im, const Lanes &cosine, const Lanes &sine)
  {
    const Lanes turned = re * cosine - im * sine;
    im = re * sine + im * cosine;
    re = turned;
  }

  Lanes ex_re_ = Lanes::Zero(), ex_im_ = Lanes::Zero(), ey_re_, ey_im_;
};

}    // namespace fluid
