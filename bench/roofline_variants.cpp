#include "roofline_variants.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>

#if defined(__x86_64__) && defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // in the header itself
#include <immintrin.h>
#pragma GCC diagnostic pop
#define NDA_BENCH_AVX2 __attribute__((target("avx2")))
#define NDA_BENCH_AVX512 __attribute__((target("avx512f,avx512vl")))
#endif

namespace nda::bench {
namespace {

using core::ArcId;
using core::Component;
using relax::Cells;

constexpr int kRelaxed = 3;  // of five dimensions

template <typename Number>
struct Columns {
  std::array<const Number*, kRelaxed> index;
  std::array<const double*, kRelaxed> u;
};

Columns<Index> columns_of(const Component& component, std::span<const double> u) {
  Columns<Index> columns;
  for (std::size_t k = 0; k < kRelaxed; ++k) {
    columns.index[k] = component.indices[k + 2].data();
    columns.u[k] = u.data() + component.offset[k + 2];
  }
  return columns;
}

template <typename Number>
double reduced(const Columns<Number>& columns, const double* cost, ArcId a) {
  double r = cost[a];
  for (std::size_t k = 0; k < kRelaxed; ++k) r -= columns.u[k][columns.index[k][a]];
  return r;
}

// Cell by cell, arc by arc; also which arc.
void with_arcs(const Component& component,
               const Cells& cells,
               std::span<const double> u,
               std::span<double> d,
               std::span<ArcId> from) {
  const Columns<Index> columns = columns_of(component, u);
  for (std::size_t cell = 0; cell < d.size(); ++cell) {
    d[cell] = kInfinity;
    for (ArcId a = cells.first_arc[cell]; a < cells.first_arc[cell + 1]; ++a) {
      const double r = reduced(columns, component.costs.data(), a);
      if (r >= d[cell]) continue;
      d[cell] = r;
      from[cell] = a;
    }
  }
}

void any_dimensions(const Component& component,
                    const Cells& cells,
                    std::span<const double> u,
                    std::span<double> d,
                    std::span<ArcId>) {
  for (std::size_t cell = 0; cell < d.size(); ++cell) {
    double best = kInfinity;
    for (ArcId a = cells.first_arc[cell]; a < cells.first_arc[cell + 1]; ++a) {
      double r = component.costs[a];
      for (int k = 2; k < component.num_dimensions(); ++k) r -= u[component.slot(k, a)];
      best = std::min(best, r);
    }
    d[cell] = best;
  }
}

template <typename Number>
void cell_by_cell(const Columns<Number>& columns,
                  const Component& component,
                  const Cells& cells,
                  std::span<double> d) {
  for (std::size_t cell = 0; cell < d.size(); ++cell) {
    double best = kInfinity;
    for (ArcId a = cells.first_arc[cell]; a < cells.first_arc[cell + 1]; ++a) {
      best = std::min(best, reduced(columns, component.costs.data(), a));
    }
    d[cell] = best;
  }
}

void plain(const Component& component,
           const Cells& cells,
           std::span<const double> u,
           std::span<double> d,
           std::span<ArcId>) {
  cell_by_cell(columns_of(component, u), component, cells, d);
}

// The columns are copied once, before anything is timed.
void short_indices(const Component& component,
                   const Cells& cells,
                   std::span<const double> u,
                   std::span<double> d,
                   std::span<ArcId>) {
  static std::map<const Component*, std::array<std::vector<std::uint16_t>, kRelaxed>> copies;
  auto& copy = copies[&component];
  Columns<std::uint16_t> columns;
  for (std::size_t k = 0; k < kRelaxed; ++k) {
    const core::Column& column = component.indices[k + 2];
    if (copy[k].empty()) copy[k].assign(column.begin(), column.end());
    columns.index[k] = copy[k].data();
    columns.u[k] = u.data() + component.offset[k + 2];
  }
  cell_by_cell(columns, component, cells, d);
}

#ifdef NDA_BENCH_AVX2

NDA_BENCH_AVX2 double least_of(__m256d r, double best) {
  std::array<double, 4> lane;
  _mm256_storeu_pd(lane.data(), r);
  for (const double x : lane) best = std::min(best, x);
  return best;
}

// Four arcs in a register, their multipliers gathered.
NDA_BENCH_AVX2 void gathered(const Component& component,
                             const Cells& cells,
                             std::span<const double> u,
                             std::span<double> d,
                             std::span<ArcId>) {
  const Columns<Index> columns = columns_of(component, u);
  const double* cost = component.costs.data();
  const __m256d all = _mm256_castsi256_pd(_mm256_set1_epi64x(-1));
  for (std::size_t cell = 0; cell < d.size(); ++cell) {
    __m256d least = _mm256_set1_pd(kInfinity);
    ArcId a = cells.first_arc[cell];
    const ArcId end = cells.first_arc[cell + 1];
    for (; a + 4 <= end; a += 4) {
      __m256d r = _mm256_loadu_pd(cost + a);
      for (std::size_t k = 0; k < kRelaxed; ++k) {
        const auto* index = reinterpret_cast<const __m128i*>(columns.index[k] + a);
        const __m256d u_k = _mm256_mask_i32gather_pd(
            _mm256_setzero_pd(), columns.u[k], _mm_loadu_si128(index), all, 8);
        r = _mm256_sub_pd(r, u_k);
      }
      least = _mm256_min_pd(least, r);
    }
    double best = least_of(least, kInfinity);
    for (; a < end; ++a) best = std::min(best, reduced(columns, cost, a));
    d[cell] = best;
  }
}

// Four arcs in a register, their multipliers loaded one by one.
NDA_BENCH_AVX2 void inserted(const Component& component,
                             const Cells& cells,
                             std::span<const double> u,
                             std::span<double> d,
                             std::span<ArcId>) {
  const Columns<Index> columns = columns_of(component, u);
  const double* cost = component.costs.data();
  for (std::size_t cell = 0; cell < d.size(); ++cell) {
    __m256d least = _mm256_set1_pd(kInfinity);
    ArcId a = cells.first_arc[cell];
    const ArcId end = cells.first_arc[cell + 1];
    for (; a + 4 <= end; a += 4) {
      __m256d r = _mm256_loadu_pd(cost + a);
      for (std::size_t k = 0; k < kRelaxed; ++k) {
        const Index* i = columns.index[k] + a;
        const double* v = columns.u[k];
        r = _mm256_sub_pd(r, _mm256_set_pd(v[i[3]], v[i[2]], v[i[1]], v[i[0]]));
      }
      least = _mm256_min_pd(least, r);
    }
    double best = least_of(least, kInfinity);
    for (; a < end; ++a) best = std::min(best, reduced(columns, cost, a));
    d[cell] = best;
  }
}

// Eight arcs in a register, a mask for the last of a cell.
NDA_BENCH_AVX512 void gathered_wide(const Component& component,
                                    const Cells& cells,
                                    std::span<const double> u,
                                    std::span<double> d,
                                    std::span<ArcId>) {
  const Columns<Index> columns = columns_of(component, u);
  const __m512d none = _mm512_set1_pd(kInfinity);
  for (std::size_t cell = 0; cell < d.size(); ++cell) {
    __m512d least = none;
    const ArcId end = cells.first_arc[cell + 1];
    for (ArcId a = cells.first_arc[cell]; a < end; a += 8) {
      const auto mask = static_cast<__mmask8>(end - a >= 8 ? 0xff : (1u << (end - a)) - 1);
      __m512d r = _mm512_mask_loadu_pd(none, mask, component.costs.data() + a);
      for (std::size_t k = 0; k < kRelaxed; ++k) {
        const __m256i index = _mm256_maskz_loadu_epi32(mask, columns.index[k] + a);
        const __m512d u_k =
            _mm512_mask_i32gather_pd(_mm512_setzero_pd(), mask, index, columns.u[k], 8);
        r = _mm512_sub_pd(r, u_k);
      }
      least = _mm512_min_pd(least, r);
    }
    d[cell] = _mm512_reduce_min_pd(least);
  }
}

#endif

}  // namespace

std::vector<Variant> variants() {
  std::vector<Variant> all = {{"cell by cell, with the arc of the minimum", with_arcs},
                              {"cell by cell, N known at run time", any_dimensions},
                              {"cell by cell", plain},
                              {"cell by cell, indices of 16 bits", short_indices}};
#ifdef NDA_BENCH_AVX2
  if (__builtin_cpu_supports("avx2")) {
    all.push_back({"cell by cell, AVX2, gathers", gathered});
    all.push_back({"cell by cell, AVX2, single loads", inserted});
  }
  if (__builtin_cpu_supports("avx512vl"))
    all.push_back({"cell by cell, AVX-512, gathers", gathered_wide});
#endif
  return all;
}

}  // namespace nda::bench
