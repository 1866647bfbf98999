#pragma once

#include <gracilis/calibrate/calibration.hpp>
#include <gracilis/io/toml_reader.hpp>

#include <limits>

namespace gracilis {

/// What of a table of curves is wanted.
struct CurveChoice {
  std::vector<std::string> muscles, sources;  ///< empty: all
  std::map<std::string, std::string> names;   ///< of muscles in the file that the scene calls otherwise
  Real from = -std::numeric_limits<Real>::infinity(), to = std::numeric_limits<Real>::infinity();  ///< rad
  Real spacing = 0;  ///< rad: angles nearer than this to the last one taken are left out
};

/// Finds and reads the files that targets name. What is wrong with a file goes to `of_files`, what is wrong with how it
/// is named to the reader's problems.
class TargetFiles {
 public:
  /// All must outlive this.
  TargetFiles(const std::filesystem::path& targets, const std::filesystem::path& data,
              std::vector<std::filesystem::path>& inputs, std::vector<Problem>& of_files)
      : targets_(targets), data_(data), inputs_(inputs), of_files_(of_files) {}

  /// Adds a part per muscle and source of a table of moment arms or lengths, by the target's kind.
  void read_curves(TomlReader& reader, const std::string& file, const CurveChoice& choice,
                   CalibrationTarget& target) const;
  /// Adds a part per row of a .csv with the columns `muscle` and `volume_cm3`.
  void read_volumes(TomlReader& reader, const std::string& file, CalibrationTarget& target) const;
  /// Adds the surface in a file, in the reader's `unit` ("m" where it has none), as a part of this muscle.
  void read_shape(TomlReader& reader, const std::string& muscle, const std::string& file,
                  CalibrationTarget& target) const;

 private:
  std::filesystem::path located(TomlReader& reader, const std::string& file) const;
  template <class Read>
  void guarded(const Read& read) const;

  const std::filesystem::path& targets_;
  const std::filesystem::path& data_;
  std::vector<std::filesystem::path>& inputs_;
  std::vector<Problem>& of_files_;
};

}  // namespace gracilis
