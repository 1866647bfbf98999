#pragma once

#include <filesystem>
#include <fstream>
#include <string>

/// The tables that reproductions/cervenka-2024 draws, each a .csv with a head.
namespace gracilis {

struct TableRequest {
  std::filesystem::path out;   ///< folder, exists
  std::filesystem::path data;  ///< the shared data, or empty
  bool thin = false;           ///< few functions, coarse surfaces

  std::ofstream table(const std::string& name, const std::string& head) const {
    std::ofstream file(out / (name + ".csv"));
    file << head << '\n';
    return file;
  }
};

/// kernels, powers, halton: tables 3.1 and 3.2, eq. 3.5.
void write_kernels(const TableRequest& request);
/// conditions, peaks: figure 5.7.
void write_conditions(const TableRequest& request);
/// signals, exponents: heights along a line (section 5.2, figure 5.5).
void write_signals(const TableRequest& request);
/// placements, centers, heights, compression: heights over a square (figures 5.1, 5.3 and 5.6).
void write_fields(const TableRequest& request);
/// solids: gluteus maximus as an implicit surface.
void write_solids(const TableRequest& request);
/// curvature, crossings, gradient, descent: figure 5.13 and chapter 6.
void write_curvature(const TableRequest& request);
/// outlines, attachment_surfaces: section 5.11. Nothing without data.
void write_outlines(const TableRequest& request);

}  // namespace gracilis
