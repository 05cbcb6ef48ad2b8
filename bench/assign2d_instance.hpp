#pragma once

#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "nda/assign2d.hpp"

/// A two-dimensional problem as bench/assign2d.py writes it, native-endian: num_rows, num_columns,
/// num_pairs as 64-bit integers, row_start and column as 32-bit integers, cost, row_outside,
/// column_outside as doubles.
struct Instance {
  std::vector<std::uint32_t> row_start;
  std::vector<std::uint32_t> column;
  std::vector<double> cost;
  std::vector<double> row_outside;
  std::vector<double> column_outside;

  nda::Assign2dProblem view() const {
    return {row_start, column, cost, row_outside, column_outside};
  }
};

template <class T>
void read_array(std::ifstream& in, std::vector<T>& values, std::size_t size) {
  values.resize(size);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(size * sizeof(T)));
}

/// Throws where the file cannot be read or breaks the contract of Assign2dProblem.
inline Instance read_instance(const char* path) {
  std::ifstream in(path, std::ios::binary);
  std::vector<std::uint64_t> sizes;
  read_array(in, sizes, 3);
  Instance instance;
  read_array(in, instance.row_start, sizes[0] + 1);
  read_array(in, instance.column, sizes[2]);
  read_array(in, instance.cost, sizes[2]);
  read_array(in, instance.row_outside, sizes[0]);
  read_array(in, instance.column_outside, sizes[1]);
  if (!in) throw std::runtime_error(std::string("cannot read ") + path);
  nda::validate(instance.view());
  return instance;
}
