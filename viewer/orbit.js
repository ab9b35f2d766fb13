// The eye on a sphere around a target, z up: mouse, pen and fingers.
class Orbit {
  constructor(element, changed) {
    this.target = new THREE.Vector3();
    this.changed = changed;
    this.pointers = new Map();
    // Each may take a press of the pointer: gives what is called with its moves,
    // or null.
    this.grabs = [];
    // Part of a page that is scrolled: the wheel is that page's (embedded.js).
    this.isAsleep = false;
    this.onAsleep = () => {};
    this.grip = null;
    this.height = 1;
    this.home = {yaw: -0.9, pitch: 0.45, distance: 2.2, target: [0, 0, 0]};
    this.reset();
    element.addEventListener('contextmenu', e => e.preventDefault());
    element.addEventListener('pointerdown', e => {
      this.grip = this.pointers.size > 0 ? null
          : this.grabs.reduce((grip, grab) => grip || grab(e), null);
      this.pointers.set(e.pointerId, [e.clientX, e.clientY]);
      element.setPointerCapture(e.pointerId);
    });
    for (const end of ['pointerup', 'pointercancel']) {
      element.addEventListener(end, e => this.pointers.delete(e.pointerId));
    }
    element.addEventListener('pointermove', e => this.drag(e));
    element.addEventListener('wheel', e => {
      if (this.isAsleep && !e.ctrlKey) return this.onAsleep();
      const step = e.deltaMode === 1 ? 30 : 1;
      this.zoom(Math.exp(e.deltaY * step / 700));
      e.preventDefault();
    }, {passive: false});
  }

  reset() {
    Object.assign(this, this.home);
    this.target = new THREE.Vector3(...this.home.target);
    this.changed();
  }

  turn(yaw, pitch) {
    this.yaw += yaw;
    this.pitch = Math.min(1.57, Math.max(-1.57, this.pitch + pitch));
    this.changed();
  }

  zoom(factor) {
    this.distance = Math.min(50, Math.max(1e-4, this.distance * factor));
    this.changed();
  }

  // By pixels; the view is `height` of them high.
  pan(dx, dy) {
    const step =
        2 * this.distance * Math.tan(kFieldOfView / 2) / this.height;
    const c = Math.cos(this.yaw), s = Math.sin(this.yaw);
    const up = Math.sin(this.pitch);
    this.target.x += step * (s * dx - c * up * dy);
    this.target.y += step * (-c * dx - s * up * dy);
    this.target.z += step * Math.cos(this.pitch) * dy;
    this.changed();
  }

  drag(e) {
    const before = this.pointers.get(e.pointerId);
    if (!before) return;
    if (this.grip) return this.grip(e);
    const spread = () => {
      const [a, b] = [...this.pointers.values()];
      return Math.hypot(a[0] - b[0], a[1] - b[1]);
    };
    const dx = e.clientX - before[0], dy = e.clientY - before[1];
    const isPair = this.pointers.size === 2;
    const width = isPair ? spread() : 0;
    this.pointers.set(e.pointerId, [e.clientX, e.clientY]);
    if (isPair) {
      this.pan(dx / 2, dy / 2);
      this.zoom(width / Math.max(1, spread()));
    } else if (this.pointers.size > 2) {
      return;
    } else if (e.buttons === 2 || e.buttons === 4 || e.shiftKey) {
      this.pan(dx, dy);
    } else {
      this.turn(-dx / 180, dy / 180);
    }
  }

  // The least distance from which all points are seen, from here, in a view
  // whose width is `aspect` times its height.
  fit(points, aspect) {
    const {yaw, pitch} = this.home;
    const c = Math.cos(yaw), s = Math.sin(yaw);
    const up = Math.sin(pitch), flat = Math.cos(pitch);
    const slope = 0.94 * Math.tan(kFieldOfView / 2);
    let distance = 0.05;
    for (const p of points) {
      const q = p.clone().sub(new THREE.Vector3(...this.home.target));
      const x = -s * q.x + c * q.y;
      const y = -up * (c * q.x + s * q.y) + flat * q.z;
      const z = flat * (c * q.x + s * q.y) + up * q.z;
      distance = Math.max(distance, z + Math.abs(x) / (slope * aspect),
                          z + Math.abs(y) / slope);
    }
    return distance;
  }

  place(camera) {
    const c = Math.cos(this.pitch);
    camera.position.set(c * Math.cos(this.yaw), c * Math.sin(this.yaw),
                        Math.sin(this.pitch));
    camera.position.multiplyScalar(this.distance).add(this.target);
    // Straight from above, up is where the eye came from.
    camera.up.set(0, 0, 1);
    if (c < 1e-3) {
      camera.up.set(-Math.cos(this.yaw), -Math.sin(this.yaw), 0);
    }
    camera.near = Math.max(this.distance / 200, this.distance - 3) / 2;
    camera.far = this.distance + 6;
    camera.lookAt(this.target);
    camera.updateProjectionMatrix();
  }
}

const kFieldOfView = 28 * Math.PI / 180;
