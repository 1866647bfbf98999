// The shapes of all runs side by side under one camera. See report_shapes.hpp for how they are stored.
function bytesOf(id) {
  const text = atob(document.getElementById(id).textContent);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

// Two frames and how far it is from one to the other, for a frame of the run that may not be stored.
function between(frames, frame) {
  let next = frames.findIndex(each => each >= frame);
  if (next < 0) next = frames.length - 1;
  const before = frames[next] === frame || next === 0 ? next : next - 1;
  return [before, next, before === next ? 0 : (frame - frames[before]) / (frames[next] - frames[before])];
}

// Blends points of two frames, stored as 16 bits within a box, into an array of floats.
function blendPoints(stored, count, low, size, [a, b, share], out) {
  for (let i = 0; i < 3 * count; ++i) {
    const k = i % 3;
    const value = (1 - share) * stored[3 * count * a + i] + share * stored[3 * count * b + i];
    out[i] = low[k] + size[k] * value / 65535;
  }
}

// A scene with its camera, and lights that go with that.
class LitScene {
  constructor() {
    this.scene = new THREE.Scene();
    this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.01, 10);
    this.scene.add(this.camera, new THREE.AmbientLight(0xffffff, 0.32));
    for (const [x, y, z, strength] of [[-0.7, 0.8, 1, 0.62], [1, -0.1, 0.8, 0.28], [0.3, 1, -0.6, 0.25]]) {
      const light = new THREE.DirectionalLight(0xffffff, strength);
      light.position.set(x, y, z);
      this.camera.add(light, light.target);
    }
  }

  addSurface(geometry, color) {
    geometry.computeVertexNormals();
    return this.add(new THREE.Mesh(geometry, new THREE.MeshPhongMaterial({color, specular: 0x222222, shininess: 18,
                                                                          side: THREE.DoubleSide})));
  }

  addLines(geometry) {
    return this.add(new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({vertexColors: THREE.VertexColors})));
  }

  // Shapes change without their bounds being told.
  add(shape) {
    shape.frustumCulled = false;
    this.scene.add(shape);
    return shape;
  }
}

class RunShapes extends LitScene {
  constructor(run, index) {
    super();
    this.run = run;
    this.buffer = bytesOf('shapes-' + index);
    this.stripes = stripeTexture(new Uint8Array(this.buffer, run.shapes.brightness_at, 512));
    this.surfaces = run.shapes.surfaces.map(surface => this.makeSurface(surface));
    this.fibers = run.shapes.fibers.map(fibers => this.makeFibers(fibers));
  }

  makeSurface(surface) {
    const muscle = surface.kind === 'muscle';
    const geometry = new THREE.BufferGeometry();
    const points = new Float32Array(3 * surface.vertices);
    const stored = new Uint16Array(this.buffer, surface.points_at,
                                   3 * surface.vertices * (muscle ? this.run.shapes.frames.length : 1));
    blendPoints(stored, surface.vertices, surface.low, surface.size, [0, 0, 0], points);
    geometry.setIndex(new THREE.BufferAttribute(new Uint16Array(this.buffer, surface.faces_at, 3 * surface.faces), 1));
    geometry.setAttribute('position', new THREE.BufferAttribute(points, 3));
    geometry.setAttribute('color', new THREE.BufferAttribute(new Float32Array(points.length).fill(1), 3));
    const mesh = this.addSurface(geometry, 0xefe6d0);
    const result = {...surface, mesh, stored};
    if (muscle) {
      mesh.material.vertexColors = THREE.VertexColors;
      result.color = this.colorOf(surface.name);
      result.evened = new EvenedSurface(points, geometry.index.array);
      const bytes = at => new Uint8Array(this.buffer, at, surface.vertices * this.run.shapes.frames.length);
      result.stretch = bytes(surface.stretch_at);
      result.shape = bytes(surface.shape_at);
      result.look = tissueColors(surface.belly, surface.tendon, new Uint8Array(this.buffer, surface.tendon_at, surface.vertices));
      const places = new Uint16Array(this.buffer, surface.stripes_at, surface.vertices), [low, range] = surface.stripes;
      const uv = Float32Array.from({length: 2 * surface.vertices},
                                   (_, i) => i % 2 ? 0.5 : low + range * places[i / 2] / 65535);
      geometry.setAttribute('uv', new THREE.BufferAttribute(uv, 2));
    } else {
      result.motion = new Float32Array(this.buffer, surface.motion_at, 7 * this.run.shapes.frames.length);
    }
    return result;
  }

  colorOf(muscle) {
    return new THREE.Color(this.run.muscles.find(each => each.name === muscle).color).toArray();
  }

  makeFibers(fibers) {
    const count = fibers.sizes.reduce((sum, size) => sum + size, 0), index = [];
    let begin = 0;
    for (const size of fibers.sizes) {
      for (let i = 0; i + 1 < size; ++i) index.push(begin + i, begin + i + 1);
      begin += size;
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setIndex(index);
    geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3 * count), 3));
    geometry.setAttribute('color', new THREE.BufferAttribute(new Float32Array(3 * count), 3));
    const lines = this.addLines(geometry);
    const frames = this.run.shapes.frames.length;
    // Lines take no light, and are to stand out from their muscle.
    const darker = color => color.map(each => 0.7 * each);
    const {belly} = this.run.shapes.surfaces.find(each => each.name === fibers.muscle);
    return {...fibers, color: darker(this.colorOf(fibers.muscle)), fleshColor: darker(belly), count, lines, stored: new Uint16Array(this.buffer, fibers.points_at, 3 * count * frames),
            strain: new Uint8Array(this.buffer, fibers.strain_at, fibers.sizes.length * frames)};
  }

  // `frame` is one of this run's.
  show(frame, state) {
    const at = between(this.run.shapes.frames, frame);
    for (const surface of this.surfaces) {
      if (surface.kind === 'bone') this.showBone(surface, at, state);
      else this.showMuscle(surface, at, frame, state);
    }
    for (const fibers of this.fibers) this.showFibers(fibers, at, state);
  }

  showBone(bone, [a, b, share], state) {
    bone.mesh.visible = state.bones;
    // Beside colors that mean something bones step back.
    bone.mesh.material.color.set(SHAPE_COLORS[state.colorBy].colors ? 0xa9aeb1 : 0xefe6d0);
    const turn = i => new THREE.Quaternion().fromArray(bone.motion, 7 * i);
    const place = i => new THREE.Vector3().fromArray(bone.motion, 7 * i + 4);
    bone.mesh.quaternion.copy(turn(a)).slerp(turn(b), share);
    bone.mesh.position.copy(place(a)).lerp(place(b), share);
  }

  showMuscle(muscle, at, frame, state) {
    const {geometry, material} = muscle.mesh;
    muscle.mesh.visible = state.visible.has(muscle.name);
    if (!muscle.mesh.visible) return;
    const fibersShown = state.fibers || SHAPE_COLORS[state.colorBy].fibers;
    const opacity = fibersShown ? Math.min(state.opacity, 0.25) : state.opacity;
    const map = state.colorBy === 'natural' ? this.stripes : null;
    if (material.map !== map) Object.assign(material, {map, needsUpdate: true});
    Object.assign(material, {opacity, transparent: opacity < 1, depthWrite: opacity === 1});
    blendPoints(muscle.stored, muscle.vertices, muscle.low, muscle.size, at, geometry.attributes.position.array);
    // Colors that tell values stand where these were measured.
    if (!SHAPE_COLORS[state.colorBy].colors) muscle.evened.even(geometry.attributes.position.array);
    geometry.attributes.position.needsUpdate = true;
    geometry.computeVertexNormals();
    this.colorMuscle(muscle, at, frame, state);
    geometry.attributes.color.needsUpdate = true;
  }

  colorMuscle(muscle, at, frame, state) {
    const colors = muscle.mesh.geometry.attributes.color.array, scale = SHAPE_COLORS[state.colorBy];
    if (state.colorBy === 'natural') return colors.set(muscle.look);
    const chart = scale.chart && this.run.charts.find(each => each.id === scale.chart);
    const values = chart && chart.series.find(each => each.muscle === muscle.name).values;
    const whole = values ? colorAt(scale, values[frame]) : scale.fibers ? FLESH : muscle.color;
    for (let v = 0; v < muscle.vertices; ++v) {
      const [a, b, share] = at;
      const blended = bytes => (1 - share) * bytes[a * muscle.vertices + v] + share * bytes[b * muscle.vertices + v];
      let color = whole;
      if (state.colorBy === 'stretch') color = colorAt(scale, logRatioOf(blended(muscle.stretch)));
      if (state.colorBy === 'shape') color = colorAt(scale, shareOf(blended(muscle.shape)));
      colors.set(color, 3 * v);
    }
  }

  // The least and the largest value that a coloring shows, of all muscles in all frames.
  range(key) {
    const {chart, fibers} = SHAPE_COLORS[key];
    if (fibers) return rangeOfBytes(this.fibers.map(each => each.strain), logRatioOf);
    if (key === 'stretch' || key === 'shape')
      return rangeOfBytes(this.surfaces.filter(each => each.kind === 'muscle').map(each => each[key]),
                          key === 'shape' ? shareOf : logRatioOf);
    const found = chart && this.run.charts.find(each => each.id === chart);
    return rangeOf(found ? found.series.flatMap(each => each.values) : []);
  }

  showFibers(fibers, at, state) {
    const scale = SHAPE_COLORS[state.colorBy];
    fibers.lines.visible = (state.fibers || Boolean(scale.fibers)) && state.visible.has(fibers.muscle);
    if (!fibers.lines.visible) return;
    const {position, color} = fibers.lines.geometry.attributes;
    blendPoints(fibers.stored, fibers.count, fibers.low, fibers.size, at, position.array);
    let point = 0;
    fibers.sizes.forEach((size, line) => {
      const value = logRatioOf(fibers.strain[at[0] * fibers.sizes.length + line]);
      const shown = scale.fibers ? colorAt(scale, value) : state.colorBy === 'natural' ? fibers.fleshColor : fibers.color;
      for (let i = 0; i < size; ++i) color.array.set(shown, 3 * point++);
    });
    position.needsUpdate = true;
    color.needsUpdate = true;
  }

  // Corners of boxes that hold everything in all frames.
  corners() {
    const list = [];
    for (const surface of this.surfaces) {
      const motions = surface.kind === 'bone' ? this.run.shapes.frames.length : 1;
      for (let i = 0; i < 8 * motions; ++i) {
        const corner = new THREE.Vector3(...surface.low.map((low, k) => low + (i >> k & 1) * surface.size[k]));
        if (surface.kind === 'bone') {
          const at = 7 * Math.floor(i / 8);
          corner.applyQuaternion(new THREE.Quaternion().fromArray(surface.motion, at));
          corner.add(new THREE.Vector3().fromArray(surface.motion, at + 4));
        }
        list.push(corner);
      }
    }
    return list;
  }
}

class Stage {
  // `shapesOf(run, i)` makes what is shown of a run.
  constructor(runs, canvas, shapesOf = (run, i) => new RunShapes(run, i)) {
    this.canvas = canvas;
    const options = {antialias: true, alpha: true, preserveDrawingBuffer: true};
    const context = canvas.getContext('webgl', options);
    this.renderer = context && new THREE.WebGLRenderer({canvas, context, ...options});
    if (context) this.renderer.setScissorTest(true);
    this.shapes = runs.map(shapesOf);
    const vector = name => new THREE.Vector3(...runs[0][name]);
    this.axes = {anterior: vector('anterior'), superior: vector('superior'), right: vector('right')};
    // What the view was fitted to; null once somebody has turned or moved it.
    this.fitted = null;
    this.orbit = new Orbit(canvas, this.axes.superior, () => { this.fitted = null; this.draw(); });
    new ResizeObserver(() => this.fitted ? this.lookFrom(this.fitted) : this.draw()).observe(canvas);
  }

  // All that any frame shows, seen from `direction`, as large as the view allows.
  lookFrom(direction) {
    this.orbit.lookFrom(direction.clone().normalize());
    const back = this.orbit.direction(), right = this.axes.superior.clone().cross(back).normalize();
    const axes = [right, back.clone().cross(right), back];
    const center = new THREE.Vector3(), half = [];
    const corners = this.shapes.flatMap(shapes => shapes.corners());
    for (const axis of axes) {
      const along = corners.map(corner => corner.dot(axis));
      const low = along.reduce((a, b) => Math.min(a, b)), high = along.reduce((a, b) => Math.max(a, b));
      center.addScaledVector(axis, (low + high) / 2);
      half.push((high - low) / 2);
    }
    const aspect = this.canvas.clientWidth / this.shapes.length / this.canvas.clientHeight || 1;
    this.orbit.center.copy(center);
    this.orbit.halfHeight = 1.04 * Math.max(half[1], half[0] / aspect);
    this.fitted = direction;
    this.draw();
  }

  draw() {
    const {clientWidth: width, clientHeight: height} = this.canvas;
    if (!this.renderer || !this.orbit || !width || !height) return;
    this.renderer.setPixelRatio(window.devicePixelRatio);
    const size = this.renderer.getSize(new THREE.Vector2());
    if (size.x !== width || size.y !== height) this.renderer.setSize(width, height, false);
    const part = width / this.shapes.length;
    this.shapes.forEach((shapes, i) => {
      this.renderer.setViewport(i * part, 0, part, height);
      this.renderer.setScissor(i * part, 0, part, height);
      this.orbit.place(shapes.camera, part / height);
      this.renderer.render(shapes.scene, shapes.camera);
    });
    if (this.drawn) this.drawn();
  }

  pixelsPerMetre() { return this.canvas.clientHeight / (2 * this.orbit.halfHeight); }
}
