// The ceiling: spring forces from contiguous arrays that stay in the L1 cache, with the widest vectors that the
// processor has. No indices, no sums, no memory: what is left is the arithmetic.
#include <benchmark/benchmark.h>

#include "base/aligned.h"
#include "bench/sections.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/ceiling.cpp"
#include <hwy/foreach_target.h>
// After foreach_target: it includes the rest of this file again for each instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace billow::bench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// `in` holds eight arrays of `count`: both ends' x, y, z, rest length, stiffness; `out` three: the force.
void spring_arithmetic(const double* in, double* out, std::size_t count) {
  const hn::ScalableTag<double> d;
  for (std::size_t s = 0; s < count; s += hn::Lanes(d)) {
    const auto load = [&](std::size_t array) HWY_ATTR { return hn::Load(d, in + array * count + s); };
    const auto x = hn::Sub(load(3), load(0)), y = hn::Sub(load(4), load(1)), z = hn::Sub(load(5), load(2));
    const auto length = hn::Sqrt(hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z)));
    const auto scale =
        hn::IfThenElseZero(hn::Gt(length, hn::Zero(d)), hn::Div(hn::Mul(load(7), hn::Sub(length, load(6))), length));
    hn::Store(hn::Mul(scale, x), d, out + s);
    hn::Store(hn::Mul(scale, y), d, out + count + s);
    hn::Store(hn::Mul(scale, z), d, out + 2 * count + s);
  }
}

}  // namespace billow::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace billow::bench {

HWY_EXPORT(spring_arithmetic);

namespace {

void ceiling(benchmark::State& state) {
  constexpr std::size_t count = 256;  // 22 kB in all
  AlignedVector<double> in(8 * count, 1.0), out(3 * count);
  for (std::size_t s = 0; s < 3 * count; ++s) in[3 * count + s] = 1.5 + 0.001 * static_cast<double>(s);
  for (auto _ : state) {
    HWY_DYNAMIC_DISPATCH(spring_arithmetic)(in.data(), out.data(), count);
    benchmark::ClobberMemory();
  }
  state.counters["springs"] = static_cast<double>(count);
}

}  // namespace

Targets add_ceiling() {
  benchmark::RegisterBenchmark(ceiling_name, ceiling);
  return {};
}

}  // namespace billow::bench
#endif
