// Where a muscle's vertices are drawn while colors tell no values: what goes up and down from vertex to vertex is
// smoothed out, by up to half an edge, which leaves rims on bones without notches (pictures/evened_surface.hpp).
class EvenedSurface {
  // `rest` has three numbers a vertex, `faces` three vertices a face.
  constructor(rest, faces) {
    const stars = Array.from({length: rest.length / 3}, () => new Set());
    for (let i = 0; i < faces.length; i += 3)
      for (let k = 0; k < 3; ++k) {
        const a = faces[i + k], b = faces[i + (k + 1) % 3];
        stars[a].add(b);
        stars[b].add(a);
      }
    this.begins = new Int32Array(stars.length + 1);
    stars.forEach((star, v) => { this.begins[v + 1] = this.begins[v] + star.size; });
    this.neighbors = Int32Array.from(stars.flatMap(star => [...star]));
    this.farthest = meanEdge(rest, stars) / 2;
    this.forth = new Float32Array(rest.length);
    this.start = new Float32Array(rest.length);
  }

  // Moves `points` of the same vertices.
  even(points) {
    this.start.set(points);
    for (let round = 0; round < 8; ++round) {
      this.step(points, 0.5, this.forth);
      this.step(this.forth, -0.53, points);
    }
    this.keepNear(points);
  }

  // Every vertex by `factor` of the way to the mean of its neighbors.
  step(from, factor, to) {
    for (let v = 0; v + 1 < this.begins.length; ++v) {
      const begin = this.begins[v], end = this.begins[v + 1], share = begin < end ? factor / (end - begin) : 0;
      let x = 0, y = 0, z = 0;
      for (let i = begin; i < end; ++i) {
        const at = 3 * this.neighbors[i];
        x += from[at], y += from[at + 1], z += from[at + 2];
      }
      const rest = begin < end ? 1 - factor : 1, at = 3 * v;
      to[at] = rest * from[at] + share * x;
      to[at + 1] = rest * from[at + 1] + share * y;
      to[at + 2] = rest * from[at + 2] + share * z;
    }
  }

  keepNear(points) {
    for (let at = 0; at < points.length; at += 3) {
      const moved = [0, 1, 2].map(k => points[at + k] - this.start[at + k]), far = Math.hypot(...moved);
      if (far > this.farthest)
        moved.forEach((way, k) => { points[at + k] = this.start[at + k] + way * this.farthest / far; });
    }
  }
}

function meanEdge(points, stars) {
  let sum = 0, count = 0;
  stars.forEach((star, a) => star.forEach(b => {
    sum += Math.hypot(...[0, 1, 2].map(k => points[3 * a + k] - points[3 * b + k]));
    ++count;
  }));
  return count > 0 ? sum / count : 0;
}
