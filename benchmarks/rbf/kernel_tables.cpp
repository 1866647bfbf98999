#include "tables.hpp"

#include <gracilis/geometry/halton.hpp>
#include <gracilis/geometry/radial_kernel.hpp>

#include <fmt/format.h>

#include <array>

namespace gracilis {

void write_kernels(const TableRequest& request) {
  constexpr int steps = 60;
  constexpr Real most = 1.5;  // reaches: beyond the end of those that end
  std::ofstream kernels = request.table("kernels", "kernel,s,value");
  constexpr auto names = choices_of(RadialShape{});
  for (std::size_t k = 0; k < names.size(); ++k)
    for (int i = 0; i <= steps; ++i) {
      const Real s = most * i / steps;
      kernels << fmt::format("{},{:.4f},{:.17g}\n", names[k], s, radial_value({static_cast<RadialShape>(k)}, 1, s));
    }
  std::ofstream powers = request.table("powers", "exponent,s,value");
  for (const Real exponent : {0.5, 1.5, 2.5, 3.5, 5.5})
    for (int i = 0; i <= steps; ++i) {
      const Real s = 1.2 * i / steps;
      powers << fmt::format("{},{:.4f},{:.10g}\n", exponent, s,
                            radial_value({RadialShape::power_minus_1, exponent}, 1, s));
    }
  std::ofstream halton = request.table("halton", "k,base_2,base_3");
  const Eigen::MatrixXd points = halton_points(7, 2);
  for (Index k = 0; k < 7; ++k) halton << fmt::format("{},{:.12g},{:.12g}\n", k + 1, points(k, 0), points(k, 1));
}

}  // namespace gracilis
