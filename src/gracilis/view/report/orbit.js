// A camera that turns about a point: drag to turn, Shift or the right button to move, the wheel or two fingers to zoom,
// arrow keys, + and - for those without a mouse. `up` stays up. OrbitControls of Debian 12's three.js (r111)
// cannot stand in: its keys move instead of turning, and none of them zooms.
class Orbit {
  constructor(element, up, changed) {
    this.element = element;
    this.changed = changed;
    this.center = new THREE.Vector3();
    this.halfHeight = 0.3;  // m, of what is seen
    this.pointers = new Map();
    this.setUp(up);
    element.addEventListener('pointerdown', event => this.press(event));
    element.addEventListener('pointermove', event => this.drag(event));
    for (const name of ['pointerup', 'pointercancel'])
      element.addEventListener(name, event => this.pointers.delete(event.pointerId));
    element.addEventListener('contextmenu', event => event.preventDefault());
    element.addEventListener('wheel', event => this.wheel(event), {passive: false});
    element.addEventListener('keydown', event => this.key(event));
  }

  // Views are given by where the camera stands, seen from the center.
  lookFrom(direction) {
    const up = this.up;
    const height = Math.max(-1, Math.min(1, direction.dot(up)));
    this.tilt = Math.min(Math.max(Math.asin(height), -1.55), 1.55);
    if (Math.abs(height) < 0.99) {
      const level = direction.clone().addScaledVector(up, -height).normalize();
      this.turn = Math.atan2(level.dot(this.side), level.dot(this.ahead));
    }
    this.changed();
  }

  setUp(up) {
    this.up = up.clone().normalize();
    this.ahead = Math.abs(this.up.x) < 0.9 ? new THREE.Vector3(1, 0, 0) : new THREE.Vector3(0, 1, 0);
    this.ahead.addScaledVector(this.up, -this.ahead.dot(this.up)).normalize();
    this.side = this.up.clone().cross(this.ahead);
    this.turn = 0;
    this.tilt = 0;
  }

  direction() {
    const level = Math.cos(this.tilt);
    return this.up.clone().multiplyScalar(Math.sin(this.tilt))
      .addScaledVector(this.ahead, level * Math.cos(this.turn))
      .addScaledVector(this.side, level * Math.sin(this.turn));
  }

  place(camera, aspect) {
    const far = 100 * this.halfHeight;
    Object.assign(camera, {top: this.halfHeight, bottom: -this.halfHeight, right: this.halfHeight * aspect,
                           left: -this.halfHeight * aspect, near: 0.01 * far, far: 2 * far});
    camera.position.copy(this.center).addScaledVector(this.direction(), far);
    camera.up.copy(this.up);
    camera.lookAt(this.center);
    camera.updateProjectionMatrix();
  }

  press(event) {
    this.element.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
  }

  drag(event) {
    const last = this.pointers.get(event.pointerId);
    if (!last) return;
    const dx = event.clientX - last[0], dy = event.clientY - last[1];
    if (this.pointers.size === 2) {
      const other = [...this.pointers].find(([id]) => id !== event.pointerId)[1];
      const before = Math.hypot(last[0] - other[0], last[1] - other[1]);
      const now = Math.hypot(event.clientX - other[0], event.clientY - other[1]);
      if (now > 0) this.zoom(before / now);
    } else if (event.shiftKey || event.buttons & 6) {
      this.shift(dx, dy);
    } else {
      this.rotate(-0.008 * dx, 0.008 * dy);
    }
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
  }

  rotate(turn, tilt) {
    this.turn += turn;
    this.tilt = Math.min(Math.max(this.tilt + tilt, -1.55), 1.55);
    this.changed();
  }

  shift(dx, dy) {
    const perPixel = 2 * this.halfHeight / this.element.clientHeight;
    const right = this.up.clone().cross(this.direction()).normalize();
    const upwards = this.direction().cross(right);
    this.center.addScaledVector(right, -dx * perPixel).addScaledVector(upwards, dy * perPixel);
    this.changed();
  }

  zoom(factor) {
    this.halfHeight = Math.min(Math.max(this.halfHeight * factor, 0.005), 5);
    this.changed();
  }

  wheel(event) {
    event.preventDefault();
    this.zoom(Math.exp(0.001 * Math.max(-200, Math.min(200, event.deltaY))));
  }

  key(event) {
    const turns = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1]};
    if (turns[event.key]) this.rotate(...turns[event.key]);
    else if (event.key === '+') this.zoom(0.9);
    else if (event.key === '-') this.zoom(1.1);
    else return;
    event.preventDefault();
  }
}
