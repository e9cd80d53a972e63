#pragma once

namespace hamjet {

/// The work of products of series, counted where they are formed. A product up to degree N consists
/// of N - 1 products of slices, of degrees 2 to N, because degree 1 is linear.
struct SeriesWork {
  long slice_products = 0;
  double multiply_adds = 0;  ///< multiply-adds of numbers, or of packs where the series hold packs

  SeriesWork& operator+=(const SeriesWork& other) {
    slice_products += other.slice_products;
    multiply_adds += other.multiply_adds;
    return *this;
  }
};

/// The work on packs of `lanes` lanes, counted in multiply-adds of numbers.
inline SeriesWork operator*(int lanes, SeriesWork work) {
  work.slice_products *= lanes;
  work.multiply_adds *= lanes;
  return work;
}

}  // namespace hamjet
