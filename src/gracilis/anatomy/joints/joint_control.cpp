#include <gracilis/anatomy/joints/joint_control.hpp>

#include <nanoflann.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace gracilis {

using Samples = Eigen::MatrixXd;  // one per row, degrees
using KdTree = nanoflann::KDTreeEigenMatrixAdaptor<Samples>;

struct JointControl::Tree {
  Samples angles;
  Eigen::MatrixXd activations;
  std::unique_ptr<KdTree> index;
};

namespace {

struct Neighbors {
  std::vector<Eigen::Index> rows;
  std::vector<Real> squares;  ///< deg², ascending
};

Neighbors nearest(const KdTree& tree, const Eigen::VectorXd& q, std::size_t count) {
  Neighbors found{std::vector<Eigen::Index>(count), std::vector<Real>(count)};
  nanoflann::KNNResultSet<Real, Eigen::Index> result(count);
  result.init(found.rows.data(), found.squares.data());
  tree.index->findNeighbors(result, q.data(), nanoflann::SearchParams());
  found.rows.resize(result.size());
  found.squares.resize(result.size());
  return found;
}

/// Those whose activations count at q (degrees): the nearest, at most `count`, or the one that is hit.
Neighbors asked(const KdTree& tree, const Eigen::VectorXd& q, std::size_t count, Real hit_deg) {
  Neighbors found = nearest(tree, q, std::min(count, tree.kdtree_get_point_count()));
  if (found.squares[0] <= hit_deg * hit_deg) found.rows.resize(1), found.squares.resize(1);
  return found;
}

/// Rows with the same angles become one with the mean of their activations.
void merge_repeated(Samples& angles, Eigen::MatrixXd& activations) {
  std::map<std::vector<Real>, std::pair<Eigen::VectorXd, int>> merged;
  for (Index row = 0; row < angles.rows(); ++row) {
    const Eigen::VectorXd key = angles.row(row);
    auto& [sum, count] = merged[std::vector<Real>(key.begin(), key.end())];
    if (count++ == 0) {
      sum = activations.row(row);
    } else {
      sum += activations.row(row).transpose();
    }
  }
  Index row = 0;
  for (const auto& [key, value] : merged) {
    angles.row(row) = Eigen::Map<const Eigen::RowVectorXd>(key.data(), static_cast<Index>(key.size()));
    activations.row(row++) = value.first.transpose() / value.second;
  }
  angles.conservativeResize(row, Eigen::NoChange);
  activations.conservativeResize(row, Eigen::NoChange);
}

}  // namespace

Real falloff_for(const Eigen::MatrixXd& samples_deg) {
  if (samples_deg.rows() < 2) return 1;
  const KdTree tree(static_cast<Index>(samples_deg.cols()), std::cref(samples_deg));
  std::vector<Real> squares;
  for (Index row = 0; row < samples_deg.rows(); ++row) {
    const Neighbors found = nearest(tree, samples_deg.row(row).transpose(), 2);
    if (found.squares[1] > 0) squares.push_back(found.squares[1]);
  }
  if (squares.empty()) return 1;
  std::nth_element(squares.begin(), squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2), squares.end());
  return 1 / (2 * squares[squares.size() / 2]);
}

JointControl::JointControl(const JointControlUnit& unit)
    : tree_(std::make_unique<Tree>()),
      hit_deg_(degrees(unit.hit_distance)),
      neighbors_(static_cast<std::size_t>(unit.neighbors)) {
  tree_->angles = unit.angles * degrees(1);
  tree_->activations = unit.activations;
  merge_repeated(tree_->angles, tree_->activations);
  falloff_ = unit.falloff > 0 ? unit.falloff : falloff_for(tree_->angles);
  tree_->index = std::make_unique<KdTree>(static_cast<Index>(tree_->angles.cols()), std::cref(tree_->angles));
}

JointControl::~JointControl() = default;
JointControl::JointControl(JointControl&&) noexcept = default;
JointControl& JointControl::operator=(JointControl&&) noexcept = default;

Index JointControl::sample_count() const { return static_cast<Index>(tree_->angles.rows()); }

std::vector<Index> JointControl::neighbors(const Eigen::VectorXd& angles) const {
  const Neighbors found = asked(*tree_->index, angles * degrees(1), neighbors_, hit_deg_);
  return {found.rows.begin(), found.rows.end()};
}

const Eigen::MatrixXd& JointControl::angles_deg() const { return tree_->angles; }

Eigen::VectorXd JointControl::at(const Eigen::VectorXd& angles) const {
  const Neighbors found = asked(*tree_->index, angles * degrees(1), neighbors_, hit_deg_);
  if (found.rows.size() == 1) return tree_->activations.row(found.rows[0]);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(tree_->activations.cols());
  Real total = 0;
  for (std::size_t i = 0; i < found.rows.size(); ++i) {
    const Real weight = std::exp(-falloff_ * found.squares[i]);
    sum += weight * tree_->activations.row(found.rows[i]).transpose();
    total += weight;
  }
  // Denormal weights have lost their digits: they count as underflow.
  if (!(total > std::numeric_limits<Real>::min())) return tree_->activations.row(found.rows[0]);
  return sum / total;
}

Eigen::VectorXd leave_out_error(const JointControlUnit& unit) {
  const Index samples = static_cast<Index>(unit.angles.rows()), left_out = samples / 2;
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(unit.activations.cols());
  if (samples < 3) return squares;
  JointControlUnit half = unit;
  half.angles.resize(samples - left_out, Eigen::NoChange);
  half.activations.resize(samples - left_out, Eigen::NoChange);
  for (Index i = 0; i < samples - left_out; ++i) {
    half.angles.row(i) = unit.angles.row(2 * i);
    half.activations.row(i) = unit.activations.row(2 * i);
  }
  const JointControl control(half);
  for (Index i = 0; i < left_out; ++i) {
    const Eigen::VectorXd known = unit.activations.row(2 * i + 1).transpose();
    squares += (control.at(unit.angles.row(2 * i + 1).transpose()) - known).cwiseAbs2();
  }
  return (squares / left_out).cwiseSqrt();
}

MovingBody moving_body(const Scene& scene, const JointControlUnit& unit) {
  for (const Joint& joint : scene.joints)
    if (joint.name == unit.joint) return {joint.child_body, joint.frame.translation()};
  return {};
}

}  // namespace gracilis
