#pragma once

#include <gracilis/core/types.hpp>
#include <gracilis/methods/method.hpp>

#include <map>
#include <string>
#include <vector>

namespace gracilis {

/// What each kind of constraint moved a muscle by in a frame, all its steps and iterations together: m, one per vertex
/// of its surface, by the kind's name.
using Corrections = std::map<std::string, Points>;

/// Throws ConfigurationError where the method's solver makes no passes over constraints.
void require_passes(DeformationMethod& method);

/// Adds up what a method's solver tells of its passes while this lives.
class CorrectionSum {
 public:
  /// The method must outlive this. Throws as require_passes.
  CorrectionSum(DeformationMethod& method, std::size_t muscle_count);
  ~CorrectionSum();
  CorrectionSum(const CorrectionSum&) = delete;
  CorrectionSum& operator=(const CorrectionSum&) = delete;

  /// Per muscle: what came together since this was asked last. Not while the method advances.
  std::vector<Corrections> take();

 private:
  DeformationMethod& method_;
  std::vector<Corrections> muscles_;  ///< each is told of by one thread at a time
};

}  // namespace gracilis
