// Dragging a bone: the point that was taken hold of follows the pointer. Beside bones, the pointer turns the view, and
// two fingers zoom and shift it, wherever the first one lies.
class Pulling {
  // `pull(bone, point, target, looking)`: numbers in m.
  constructor(view, stage, shapes, pull) {
    Object.assign(this, {stage, shapes, pull, held: null, caster: new THREE.Raycaster()});
    // Before the orbit hears of it.
    view.addEventListener('pointerdown', event => this.press(event), true);
    view.addEventListener('pointermove', event => this.move(event), true);
    for (const name of ['pointerup', 'pointercancel']) view.addEventListener(name, event => this.release(event), true);
  }

  aim(event) {
    const box = this.stage.canvas.getBoundingClientRect();
    const at = new THREE.Vector2(2 * (event.clientX - box.left) / box.width - 1, 1 - 2 * (event.clientY - box.top) / box.height);
    this.caster.setFromCamera(at, this.shapes.camera);
    return this.caster;
  }

  press(event) {
    if (event.target !== this.stage.canvas) return;
    if (this.held && this.held.pointer !== event.pointerId) this.handOver();
    const isSecond = [...this.stage.orbit.pointers.keys()].some(pointer => pointer !== event.pointerId);
    if (event.button !== 0 || event.shiftKey || isSecond) return;
    const meshes = [...this.shapes.bones, ...this.shapes.muscles].map(each => each.mesh).filter(mesh => mesh.visible);
    const hit = this.aim(event).intersectObjects(meshes)[0];
    const bone = hit ? this.shapes.bones.findIndex(each => each.mesh === hit.object) : -1;
    if (bone < 0 || this.shapes.bones[bone].body === 0) return;
    const rest = hit.point.clone().applyMatrix4(new THREE.Matrix4().getInverse(hit.object.matrix));
    this.held = {bone, rest, depth: hit.distance, pointer: event.pointerId, last: event};
    this.stage.canvas.setPointerCapture(event.pointerId);
    this.stage.canvas.focus({preventScroll: true});
    event.preventDefault();
    event.stopPropagation();
  }

  // The bone stays where it is, and the orbit has the pointer as if it had been pressed beside the bone.
  handOver() {
    this.stage.orbit.press(this.held.last);
    this.held = null;
  }

  // The point between two fingers shifts the view. The orbit itself zooms by their distance.
  shift(event) {
    const {pointers} = this.stage.orbit, last = pointers.get(event.pointerId);
    if (pointers.size === 2 && last)
      this.stage.orbit.shift((event.clientX - last[0]) / 2, (event.clientY - last[1]) / 2);
  }

  move(event) {
    if (!this.held) return this.shift(event);
    if (event.pointerId !== this.held.pointer) return;
    event.stopPropagation();
    this.held.last = event;
    const {ray} = this.aim(event), target = ray.at(this.held.depth, new THREE.Vector3());
    this.pull(this.held.bone, this.held.rest.toArray(), target.toArray(), ray.direction.toArray());
  }

  release(event) {
    if (!this.held || event.pointerId !== this.held.pointer) return;
    this.held = null;
    event.stopPropagation();
  }
}
