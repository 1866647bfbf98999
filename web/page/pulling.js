// Dragging a bone: the point that was taken hold of follows the pointer. Beside bones, the pointer turns the view.
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
    if (event.button !== 0 || event.shiftKey || this.held || event.target !== this.stage.canvas) return;
    const meshes = [...this.shapes.bones, ...this.shapes.muscles].map(each => each.mesh).filter(mesh => mesh.visible);
    const hit = this.aim(event).intersectObjects(meshes)[0];
    const bone = hit ? this.shapes.bones.findIndex(each => each.mesh === hit.object) : -1;
    if (bone < 0 || this.shapes.bones[bone].body === 0) return;
    const rest = hit.point.clone().applyMatrix4(new THREE.Matrix4().getInverse(hit.object.matrix));
    this.held = {bone, rest, depth: hit.distance, pointer: event.pointerId};
    this.stage.canvas.setPointerCapture(event.pointerId);
    this.stage.canvas.focus({preventScroll: true});
    event.preventDefault();
    event.stopPropagation();
  }

  move(event) {
    if (!this.held || event.pointerId !== this.held.pointer) return;
    event.stopPropagation();
    const {ray} = this.aim(event), target = ray.at(this.held.depth, new THREE.Vector3());
    this.pull(this.held.bone, this.held.rest.toArray(), target.toArray(), ray.direction.toArray());
  }

  release(event) {
    if (!this.held || event.pointerId !== this.held.pointer) return;
    this.held = null;
    event.stopPropagation();
  }
}
