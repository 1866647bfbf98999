#include "tissue_export.hpp"

#include <tissue_load_cases.hpp>

#include <CLI/CLI.hpp>

/// The tissue's own functions on blocks whose answer can be written down (docs/validation.md). Prints tables; with
/// --export also what another finite-element program needs to solve the same.
namespace gracilis::tissue {
namespace {

constexpr Real cell_size = 0.005;  // m
const Real bulk = TissueSettings().bulk_modulus;

void print_row(const std::string& what, const std::string& unit, BlockFit fit, const Measured& found) {
  fmt::print("| {} | {} | {} | {:.6g} | {:.6g} | {:+.3f} % | {} | {} | {:.0e} | {:.0f} |\n", what, unit,
             fit == BlockFit::whole ? "whole cells" : "anywhere", found.closed_form, found.ours, 100 * found.error(),
             found.cells, found.done.iterations, found.done.residual, 1000 * found.seconds);
  std::fflush(stdout);
}

void print_head(const std::string& title) {
  fmt::print(
      "\n{}\n\n| case | unit | fit | closed form | ours | error | cells | iterations | residual, N | ms |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n",
      title);
}

void study_even_deformations(BlockFit fit) {
  for (const Real wanted : {0.8, 0.95, 1.2})
    print_row(fmt::format("bar at stretch {}: force", wanted), "N", fit,
              stretched_bar(fit, cell_size, muscle_law(0), wanted));
  print_row("bar at stretch 0.9, activation 0.4: force", "N", fit, stretched_bar(fit, cell_size, muscle_law(0.4), 0.9));
  print_row("active bar, ends fixed, activation 0.4: force", "N", fit, active_bar(fit, cell_size, 0.4));
  for (const Real cell : {cell_size, cell_size / 2}) {
    const auto [along, across] = sheared_cube(fit, cell, muscle_law(0, Vec3(1, 0, 2).normalized()), 0.3);
    print_row(fmt::format("simple shear 0.3, oblique fibers, cells of {} mm: shear stress", 1000 * cell), "Pa", fit,
              along);
    print_row("the same: stress across", "Pa", fit, across);
  }
  print_row("cube pressed on a bone by 15 %: contact force", "N", fit,
            cube_on_bone(fit, cell_size, matrix_law(bulk), 0.85));
}

void study_bending(BlockFit fit, Real with_bulk) {
  for (const Real across : {2, 4, 8, 16})
    print_row(fmt::format("K {:.0e} Pa, {} cells across: moment", with_bulk, across), "N m", fit,
              bent_bar(fit, wide / across, matrix_law(with_bulk)));
}

void study_clamped(Real slenderness, Real with_bulk) {
  for (const Real across : {2, 4, 8})
    print_row(
        fmt::format("{} times as long as wide, K {:.0e} Pa, {} cells across: force", slenderness, with_bulk, across),
        "N", BlockFit::whole, clamped_bar(wide / across, matrix_law(with_bulk), slenderness));
}

// ---- For the peer

void save(const std::filesystem::path& folder, const std::string& name, const Block& block,
          const SettledBlock& settled) {
  export_block(folder, name, block, settled);
  fmt::print("{}: {} cells, {} iterations, residual {:.0e} N, {:.2f} s\n", name, block.muscle.lattice.cell_count(),
             settled.done.iterations, settled.done.residual, settled.seconds);
  std::fflush(stdout);
}

void export_all(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  constexpr Real cell = wide / 8, residual = 1e-8;
  /// A bar whose upper end is moved as it is; nodes begin as bones would carry them.
  const auto bar = [&](const std::string& name, const CellLaw& law, Real length, const Vec3& moved) {
    Block block = make_block({wide, wide, length}, cell, BlockFit::whole, law);
    hold_side(block, 2, false, where_it_was);
    hold_side(block, 2, true, [&](const Vec3& p) { return Vec3(p + moved); });
    save(folder, name, block, settle(block, residual, [&](const Vec3& p) { return Vec3(p + p.z() / length * moved); }));
  };
  bar("stretch", muscle_law(0), 2 * wide, {0, 0, 0.4 * wide});
  bar("compression", muscle_law(0), 2 * wide, {0, 0, -0.2 * wide});
  bar("shear", muscle_law(0, Vec3(1, 0, 2).normalized()), 2 * wide, {0.6 * wide, 0, 0});
  bar("contraction", muscle_law(0.4), 2 * wide, {0, 0, -0.2 * wide});
  bar("bending", matrix_law(bulk), 5 * wide, {0, 0.5 * wide, 0});
  Block block = make_block({wide, wide, wide}, cell, BlockFit::whole, matrix_law(bulk));
  lay_on_bone(block);
  hold_side(block, 2, true, [](const Vec3& p) { return Vec3(p.x(), p.y(), p.z() - 0.15 * wide); });
  save(folder, "pressed_block", block, settle(block, residual));
}

int run_all(int count, char** arguments) {
  CLI::App program("The tissue's energy against closed forms");
  std::filesystem::path folder;
  program.add_option("--export", folder, "solve the peer's load cases and write them there, instead of the tables");
  CLI11_PARSE(program, count, arguments);
  if (!folder.empty()) {
    export_all(folder);
    return 0;
  }
  print_head("Even deformations");
  for (const BlockFit fit : {BlockFit::whole, BlockFit::anywhere}) study_even_deformations(fit);
  print_head("Pure bending");
  study_bending(BlockFit::whole, 0);
  for (const BlockFit fit : {BlockFit::whole, BlockFit::anywhere}) study_bending(fit, bulk);
  print_head("A clamped bar, its tip moved aside");
  for (const Real slenderness : {10, 20}) study_clamped(slenderness, 0);
  study_clamped(10, bulk);
  return 0;
}

}  // namespace
}  // namespace gracilis::tissue

int main(int count, char** arguments) {
  try {
    return gracilis::tissue::run_all(count, arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
