#pragma once

#include <Eigen/Core>

namespace gracilis {

/// Four triangles side by side, so that one point is measured against all at once.
struct TrianglePack {
  using Lanes = Eigen::Array4f;
  using Rows = Eigen::Matrix4f;
  struct Vectors {
    Lanes x, y, z;

    /// Lane by lane, as what follows.
    Vectors operator-(const Vectors& other) const { return {x - other.x, y - other.y, z - other.z}; }
    Lanes dot(const Vectors& other) const { return x * other.x + y * other.y + z * other.z; }  ///< scalar products
    /// Vector products.
    Vectors cross(const Vectors& other) const {
      return {y * other.z - z * other.y, z * other.x - x * other.z, x * other.y - y * other.x};
    }
    Vectors scaled(const Lanes& by) const { return {x * by, y * by, z * by}; }  ///< each by its own number
    /// One vector per column, its fourth coordinate 0.
    Rows columns() const {
      Rows rows;
      rows << x.matrix(), y.matrix(), z.matrix(), Eigen::Vector4f::Zero();
      rows.transposeInPlace();
      return rows;
    }
  };

  Vectors corner, along, back;  ///< a, b - a, c - a; m
  Lanes along2, back2, both;    ///< their products, m²

  /// From the corners a, b and c, each with one column of four coordinates per triangle; the fourth is nobody's.
  static TrianglePack of(Rows a, Rows b, Rows c) {
    const auto vectors = [](Rows& columns) -> Vectors {
      columns.transposeInPlace();
      return {columns.col(0).array(), columns.col(1).array(), columns.col(2).array()};
    };
    TrianglePack pack;
    pack.corner = vectors(a), pack.along = vectors(b) - pack.corner, pack.back = vectors(c) - pack.corner;
    pack.along2 = pack.along.dot(pack.along), pack.back2 = pack.back.dot(pack.back);
    pack.both = pack.along.dot(pack.back);
    return pack;
  }

  /// Along the normals, twice the areas long.
  Vectors areas() const { return along.cross(back); }

  /// Squared distances of p from the triangles (m²), exact but for what rounding does to squares of the triangle's own
  /// size. Flat triangles count as their sides.
  Lanes squared_distances(const Eigen::Vector3f& p) const {
    constexpr float tiny = 1e-30f, flattest = 1e-5f;  // squared sine of the angle between the sides
    const Vectors from{p.x() - corner.x, p.y() - corner.y, p.z() - corner.z};
    const Lanes from2 = from.dot(from), on_along = from.dot(along), on_back = from.dot(back);
    // To a side that starts somewhere, from a point whose squared distance from there is `start2`.
    const auto to_side = [&](const Lanes& start2, const Lanes& projected, const Lanes& length2) -> Lanes {
      const Lanes share = (projected / length2.max(tiny)).max(0.0f).min(1.0f);
      return start2 + share * (share * length2 - 2 * projected);
    };
    const Lanes third2 = along2 + back2 - 2 * both;
    const Lanes sides = to_side(from2, on_along, along2)
                            .min(to_side(from2, on_back, back2))
                            .min(to_side(from2 - 2 * on_along + along2, on_back - on_along - both + along2, third2));
    const Lanes whole = along2 * back2 - both * both;
    const Lanes v = back2 * on_along - both * on_back, w = along2 * on_back - both * on_along;
    const Lanes plane = from2 - (v * on_along + w * on_back) / whole.max(tiny);
    const auto is_over = v >= 0 && w >= 0 && v + w <= whole && whole > flattest * along2 * back2;
    return is_over.select(plane, sides).max(0.0f);
  }
};

}  // namespace gracilis
