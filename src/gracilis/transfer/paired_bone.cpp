#include <gracilis/transfer/paired_bone.hpp>

#include <gracilis/core/parallel.hpp>
#include <gracilis/geometry/measures.hpp>

#include <utility>

namespace gracilis {
namespace {

constexpr Index grain = 64;

Vec3 face_normal(const Points& vertices, const Eigen::Matrix3Xi& faces, Index face) {
  return area_vector(vertices, faces.col(face)).normalized();
}

Vec3 on_face(const Points& vertices, const Eigen::Matrix3Xi& faces, const NearestPoint& nearest) {
  Vec3 place = Vec3::Zero();
  for (int k = 0; k < 3; ++k) place += nearest.barycentric[k] * vertices.col(faces(k, nearest.face));
  return place;
}

PlacePairs empty_pairs(Index of_template, Index of_subject) {
  const Index n = of_template + of_subject;
  return {Points(3, n), Points(3, n), Points(3, n), Points(3, n), Eigen::VectorXd(n), of_template};
}

}  // namespace

PairedBone::PairedBone(std::string name, TriangleMesh from, TriangleMesh to, Index samples)
    : name_(std::move(name)),
      from_(std::move(from)),
      to_(std::move(to)),
      from_samples_(area_samples(from_, samples)),
      to_samples_(area_samples(to_, samples)),
      from_points_(from_samples_.points(from_.vertices, from_.faces)),
      from_normals_(from_samples_.normals(from_.vertices, from_.faces)),
      to_points_(to_samples_.points(to_.vertices, to_.faces)),
      to_normals_(to_samples_.normals(to_.vertices, to_.faces)),
      from_tree_(from_),
      to_tree_(to_) {}

PlacePairs PairedBone::pairs(const Eigen::Matrix3d& linear, const Vec3& shift) const {
  const Index n = from_samples_.count(), m = to_samples_.count();
  PlacePairs pairs = empty_pairs(n, m);
  const Eigen::Matrix3d inverse = linear.inverse(), of_normals = inverse.transpose() * linear.determinant();
  parallel_for(n + m, grain, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      if (i < n) {
        const Vec3 place = linear * from_points_.col(i) + shift;
        const NearestPoint nearest = to_tree_.query(place);
        pairs.from.col(i) = from_points_.col(i);
        pairs.to.col(i) = nearest.point;
        pairs.from_normals.col(i) = (of_normals * from_normals_.col(i)).normalized();
        pairs.to_normals.col(i) = face_normal(to_.vertices, to_.faces, nearest.face);
        pairs.distances[i] = nearest.distance;
      } else {
        const Vec3 there = to_points_.col(i - n);
        const NearestPoint nearest = from_tree_.query(inverse * (there - shift));
        pairs.from.col(i) = nearest.point;
        pairs.to.col(i) = there;
        pairs.from_normals.col(i) = (of_normals * face_normal(from_.vertices, from_.faces, nearest.face)).normalized();
        pairs.to_normals.col(i) = to_normals_.col(i - n);
        pairs.distances[i] = (linear * nearest.point + shift - there).norm();
      }
    }
  });
  return pairs;
}

PlacePairs PairedBone::pairs(const Points& moved) const {
  const Index n = from_samples_.count(), m = to_samples_.count();
  PlacePairs pairs = empty_pairs(n, m);
  const NearestTriangle tree({moved, from_.faces});
  const Points places = from_samples_.points(moved, from_.faces), normals = from_samples_.normals(moved, from_.faces);
  parallel_for(n + m, grain, [&](Index begin, Index end) {
    for (Index i = begin; i < end; ++i) {
      const NearestPoint nearest = i < n ? to_tree_.query(places.col(i)) : tree.query(to_points_.col(i - n));
      pairs.distances[i] = nearest.distance;
      if (i < n) {
        pairs.from.col(i) = from_points_.col(i);
        pairs.to.col(i) = nearest.point;
        pairs.from_normals.col(i) = normals.col(i);
        pairs.to_normals.col(i) = face_normal(to_.vertices, to_.faces, nearest.face);
      } else {
        pairs.from.col(i) = on_face(from_.vertices, from_.faces, nearest);
        pairs.to.col(i) = to_points_.col(i - n);
        pairs.from_normals.col(i) = face_normal(moved, from_.faces, nearest.face);
        pairs.to_normals.col(i) = to_normals_.col(i - n);
      }
    }
  });
  return pairs;
}

}  // namespace gracilis
