#pragma once

namespace hamjet {

/// Products of series, counted where they are formed. A product up to degree N is N - 1 products of
/// slices (of degree 2 to N): at degree 1 everything is linear.
struct SeriesWork {
  long slice_products = 0;
  double multiply_adds = 0;  ///< of numbers, or of packs where the series hold packs

  SeriesWork& operator+=(const SeriesWork& other) {
    slice_products += other.slice_products;
    multiply_adds += other.multiply_adds;
    return *this;
  }
};

/// The work on packs of `lanes` lanes, counted in numbers.
inline SeriesWork operator*(int lanes, SeriesWork work) {
  work.slice_products *= lanes;
  work.multiply_adds *= lanes;
  return work;
}

}  // namespace hamjet
