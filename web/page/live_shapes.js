// What the worker sends, as three.js draws it: a Stage's shapes, as RunShapes is for a recorded run.
const SURFACE_COLORS = {natural: 'natural', muscle: 'by muscle', activation: 'by activation', strain: 'by fiber length'};

class LiveShapes extends LitScene {
  constructor(description) {
    super();
    this.bones = description.bones.map(bone => ({...bone, mesh: this.surface(bone, 0xefe6d0)}));
    this.stripes = stripeTexture(description.brightness);
    this.muscles = description.muscles.map(muscle => ({...muscle, mesh: this.muscleSurface(muscle),
                                                       evened: new EvenedSurface(muscle.points, muscle.faces),
                                                       lines: this.addLines(new THREE.BufferGeometry())}));
    for (const bone of this.bones) bone.mesh.matrixAutoUpdate = false;
  }

  surface({points, faces}, color) {
    const geometry = new THREE.BufferGeometry();
    geometry.setIndex(new THREE.BufferAttribute(faces, 1));
    geometry.setAttribute('position', new THREE.BufferAttribute(points.slice(), 3));
    return this.addSurface(geometry, color);
  }

  muscleSurface(muscle) {
    const mesh = this.surface(muscle, 0xffffff), uv = new Float32Array(2 * muscle.stripes.length).fill(0.5);
    muscle.stripes.forEach((place, v) => { uv[2 * v] = place; });
    mesh.geometry.setAttribute('uv', new THREE.BufferAttribute(uv, 2));
    mesh.geometry.setAttribute('color', new THREE.BufferAttribute(tissueColors(muscle.belly, muscle.tendon, muscle.tendonShares), 3));
    return mesh;
  }

  show(frame, state) {
    for (const bone of this.bones) {
      const at = frame.bodies.subarray(12 * bone.body, 12 * bone.body + 12);
      bone.mesh.matrix.set(at[0], at[3], at[6], at[9], at[1], at[4], at[7], at[10], at[2], at[5], at[8], at[11], 0, 0, 0, 1);
      bone.mesh.visible = state.bones;
    }
    frame.muscles.forEach((now, m) => this.showMuscle(this.muscles[m], now, frame.activations[m], state));
  }

  showMuscle(muscle, now, activation, state) {
    const {geometry, material} = muscle.mesh, shown = state.visible.has(muscle.name);
    const fibersShown = state.fibers || state.colorBy === 'strain';
    muscle.mesh.visible = shown;
    muscle.lines.visible = shown && fibersShown;
    if (!shown) return;
    geometry.attributes.position.array.set(now.points);
    if (!SHAPE_COLORS[state.colorBy].colors && !state.wireframe) muscle.evened.even(geometry.attributes.position.array);
    geometry.attributes.position.needsUpdate = true;
    geometry.computeVertexNormals();
    const opacity = fibersShown ? 0.25 : 1;
    Object.assign(material, {opacity, transparent: opacity < 1, depthWrite: opacity === 1, wireframe: state.wireframe});
    const natural = state.colorBy === 'natural', map = natural ? this.stripes : null;
    if (material.map !== map)
      Object.assign(material, {map, vertexColors: natural ? THREE.VertexColors : THREE.NoColors, needsUpdate: true});
    material.color.setRGB(...(natural ? [1, 1, 1] : state.colorBy === 'activation' ? colorAt(SHAPE_COLORS.activation, activation) :
                              state.colorBy === 'strain' ? FLESH : muscle.color));
    if (fibersShown) this.showFibers(muscle, now, state);
  }

  showFibers({lines}, now, state) {
    const count = now.fibers.length / 3;
    if (!lines.geometry.attributes.position || lines.geometry.attributes.position.count !== count) {
      const index = [];
      for (let line = 0; line + 1 < now.offsets.length; ++line)
        for (let i = now.offsets[line]; i + 1 < now.offsets[line + 1]; ++i) index.push(i, i + 1);
      lines.geometry.dispose();
      lines.geometry = new THREE.BufferGeometry();
      lines.geometry.setIndex(index);
      lines.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3 * count), 3));
      lines.geometry.setAttribute('color', new THREE.BufferAttribute(new Float32Array(3 * count), 3));
    }
    const {position, color} = lines.geometry.attributes;
    position.array.set(now.fibers);
    now.strains.forEach((strain, line) => {
      const shown = state.colorBy === 'strain' ? colorAt(SHAPE_COLORS.strain, Math.log2(strain)) : [0.25, 0.04, 0.04];
      for (let i = now.offsets[line]; i < now.offsets[line + 1]; ++i) color.array.set(shown, 3 * i);
    });
    position.needsUpdate = true;
    color.needsUpdate = true;
  }

  // Corners of boxes around everything, where it is now.
  corners() {
    const list = [];
    for (const {mesh} of [...this.bones, ...this.muscles]) {
      const {min, max} = new THREE.Box3().setFromBufferAttribute(mesh.geometry.attributes.position);
      for (let i = 0; i < 8; ++i)
        list.push(new THREE.Vector3(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z)
          .applyMatrix4(mesh.matrixAutoUpdate ? new THREE.Matrix4() : mesh.matrix));
    }
    return list;
  }
}
