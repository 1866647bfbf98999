#pragma once

#include <gracilis/io/toml_reader.hpp>
#include <gracilis/study/design.hpp>

#include <optional>
#include <string>
#include <vector>

namespace gracilis {

/// What a study changes from run to run.
struct StudyParameter {
  std::string key;                  ///< as `--set` takes it, or scene or flexion
  std::vector<std::string> values;  ///< those to choose from; empty: a range
  Real low = 0, high = 1;
  bool logarithmic = false, whole = false;
  Index steps = 0;  ///< of a grid
};

/// Reads [[parameters]]; adds to the reader's problems what is wrong with it. Nothing where it cannot be used.
std::optional<StudyParameter> read_parameter(TomlReader reader, SamplingKind kind, std::vector<Problem>& problems);

/// The value at a place of the unit interval, in words that read back as the same number.
std::string value_at(const StudyParameter& parameter, Real place);

}  // namespace gracilis
