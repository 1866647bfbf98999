#pragma once

#include <gracilis/geometry/box_mesh.hpp>
#include <gracilis/scene/scene.hpp>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace gracilis {

/// A pennate muscle whose fascicles are known: slabs of 120 mm x 15 mm x 40 mm, fascicles of 30 mm at 30 degrees. A
/// place in it has the coordinates a along, b across and c from the origin's aponeurosis (1, in a bipennate one also
/// -1) to the insertion's (0); a fascicle has all of one a and b.
class PennateMuscle {
 public:
  /// `bend`: how much the whole is curved, 1/m.
  PennateMuscle(bool bipennate, Real bend) : bipennate_(bipennate), bend_(bend) {
    muscle_.name = "pennate";
    muscle_.surface = box_mesh(Vec3(0, 0, bipennate ? -1 : 0), Vec3(1, 1, 1), {36, 12, bipennate ? 10 : 5});
    const Points unit = muscle_.surface.vertices;
    place_vertices(muscle_.surface);
    attach("origin", AttachmentEnd::origin, unit,
           [](const Vec3& u) { return u.x() < 1e-9 && std::abs(u.z()) > 1 - 1e-9; });
    attach("insertion", AttachmentEnd::insertion, unit,
           [](const Vec3& u) { return u.x() > 1 - 1e-9 && std::abs(u.z()) < 1e-9; });
  }

  const Muscle& muscle() const { return muscle_; }

  Vec3 at(Real a, Real b, Real c) const {
    const Real x = length * a + (1 - std::abs(c)) * offset, y = thickness * c, z = -width * b;
    // Rolled onto a circle, at whose height 0 lengths stay.
    if (bend_ == 0) return {x, y, z};
    const Real angle = bend_ * (x - length / 2), radius = 1 / bend_ - y;
    return {radius * std::sin(angle), 1 / bend_ - radius * std::cos(angle), z};
  }

  /// A fascicle from the share `from` of its way to the share `to`, of `pieces` pieces.
  Points fascicle(Real a, Real b, bool second_half = false, Real from = 0, Real to = 1, Index pieces = 30) const {
    Points line(3, pieces + 1);
    for (Index i = 0; i <= pieces; ++i) {
      const Real c = 1 - (from + (to - from) * i / pieces);
      line.col(i) = at(a, b, second_half ? -c : c);
    }
    return line;
  }

  /// `count` fascicles spread by chance, as `cut` gets each.
  Polylines fascicles(Index count, const std::function<Points(Points, std::mt19937&)>& cut) const {
    std::mt19937 chance(7);
    std::uniform_real_distribution<Real> share(0, 1);
    std::vector<Points> lines;
    for (Index i = 0; i < count; ++i) {
      const Real a = share(chance), b = share(chance);
      lines.push_back(cut(fascicle(a, b, bipennate_ && i % 2 == 1), chance));
    }
    return join(lines);
  }

  /// With its two, or three, aponeuroses as sheets.
  Muscle with_aponeuroses() const {
    Muscle result = muscle_;
    const auto sheet = [&](Real c) {
      TriangleMesh mesh = box_mesh(Vec3(0, 0, c - 1e-3), Vec3(1, 1, c), {36, 12, 1});
      TriangleMesh top{mesh.vertices, Eigen::Matrix3Xi(3, 0)};
      for (Index f = 0; f < mesh.face_count(); ++f) {
        bool is_top = true;
        for (int k = 0; k < 3; ++k) is_top = is_top && mesh.vertices(2, mesh.faces(k, f)) == c;
        if (!is_top) continue;
        top.faces.conservativeResize(3, top.faces.cols() + 1);
        top.faces.rightCols(1) = mesh.faces.col(f);
      }
      place_vertices(top);
      return top;
    };
    result.aponeuroses.push_back({AttachmentEnd::insertion, sheet(0)});
    result.aponeuroses.push_back({AttachmentEnd::origin, sheet(1)});
    if (bipennate_) result.aponeuroses.push_back({AttachmentEnd::origin, sheet(-1)});
    return result;
  }

  static constexpr Real length = 0.12, width = 0.04, thickness = 0.015, offset = 0.026;

 private:
  void place_vertices(TriangleMesh& mesh) const {
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3 u = mesh.vertices.col(v);
      mesh.vertices.col(v) = at(u.x(), u.y(), u.z());
    }
  }
  void attach(const std::string& name, AttachmentEnd end, const Points& unit,
              const std::function<bool(const Vec3&)>& holds) {
    Attachment attachment;
    attachment.name = name;
    attachment.end = end;
    for (Index v = 0; v < static_cast<Index>(unit.cols()); ++v)
      if (holds(unit.col(v))) attachment.vertices.push_back(v);
    muscle_.attachments.push_back(attachment);
  }

  bool bipennate_;
  Real bend_;
  Muscle muscle_;
};

/// A fascicle as diffusion imaging shows it: cut short by up to a quarter at either end, with
/// noise, turned around by chance, and sometimes plain wrong.
inline Points as_measured(const Points& fascicle, Real noise, Real outliers, std::mt19937& chance) {
  std::uniform_real_distribution<Real> share(0, 1);
  std::normal_distribution<Real> normal(0, 1);
  const auto begin = static_cast<Index>(share(chance) * static_cast<Real>(fascicle.cols()) / 4);
  const auto end = static_cast<Index>(static_cast<Real>(fascicle.cols()) * (1 - share(chance) / 4));
  Points line = fascicle.middleCols(begin, end - begin);
  if (share(chance) < outliers) {
    const Vec3 way = Vec3(normal(chance), normal(chance), normal(chance)).normalized() * polyline_length(line);
    const Vec3 middle = line.rowwise().mean();
    for (Index i = 0; i < static_cast<Index>(line.cols()); ++i)
      line.col(i) = middle + way * (Real(i) / static_cast<Real>(line.cols() - 1) - 0.5);
  }
  for (Index i = 0; i < static_cast<Index>(line.cols()); ++i)
    for (Index k = 0; k < 3; ++k) line(k, i) += noise * normal(chance);
  if (share(chance) < 0.5) line = line.rowwise().reverse().eval();
  return line;
}

}  // namespace gracilis
