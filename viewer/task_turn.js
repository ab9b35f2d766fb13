// Turning a robot at its start or goal, by three rings around it.

const kRing = {mouse: 9, touch: 18};  // pixels around a ring
const kRingSteps = 90;                // in which it is looked for
// Rings that are seen from aside by less than this cosine are pulled along.
const kRingAside = 0.25;

// A turn [w, x, y, z] as its axis times its angle in degrees, and back.
function vectorOfTurn([w, x, y, z]) {
  const sine = Math.hypot(x, y, z), sign = w < 0 ? -1 : 1;
  const angle = 2 * Math.atan2(sine, sign * w) * 180 / Math.PI;
  return [x, y, z].map(k => sine > 0 ? sign * k / sine * angle : 0);
}

function turnOfVector(degrees) {
  const angle = Math.hypot(...degrees), half = angle * Math.PI / 360;
  const share = angle > 0 ? Math.sin(half) / angle : 0;
  return [Math.cos(half), ...degrees.map(k => share * k)];
}

class TurnRings {
  // `turned(key, turn)` is told of every turn of the end that the rings are
  // around.
  constructor(viewer, turned) {
    Object.assign(this, {viewer, turned, key: 'start'});
    const {stage} = viewer;
    stage.robotShape.computeBoundingSphere();
    const {center, radius} = stage.robotShape.boundingSphere;
    this.radius = Math.min(0.25, Math.max(
        0.05, 1.05 * (center.length() + radius)));
    this.group = new THREE.Group();
    const material = new THREE.MeshBasicMaterial(
        {transparent: true, opacity: 0.75, depthTest: false});
    stage.colored.push([material, 'mark']);
    this.names = {};
    for (const [name, axis] of Object.entries(kAxes)) {
      const ring = new THREE.Mesh(
          new THREE.TorusBufferGeometry(this.radius, 0.0022, 8, 96), material);
      ring.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1),
                                         new THREE.Vector3(...axis));
      ring.renderOrder = 25;
      this.group.add(ring);
      this.names[name] = {text: name, point: new THREE.Vector3()};
    }
    this.group.visible = false;
    stage.groups.marks.add(this.group);
    viewer.orbit.grabs.push(e => this.grab(e));
    this.place();
  }

  get middle() { return this.viewer.stage.ends[this.key][0].position; }

  place() {
    this.group.position.copy(this.middle);
    for (const name of Object.keys(kAxes)) {
      this.names[name].point.copy(this.pointOf(name, Math.PI / 4));
    }
  }

  // The rings are there from the first time on that an end is taken.
  around(key) {
    this.key = key;
    this.place();
    if (this.group.visible) return;
    this.group.visible = true;
    this.viewer.stage.labels.push(...Object.values(this.names));
  }

  // Of the ring about an axis, at an angle.
  pointOf(name, angle) {
    const k = 'xyz'.indexOf(name), p = [0, 0, 0];
    p[(k + 1) % 3] = this.radius * Math.cos(angle);
    p[(k + 2) % 3] = this.radius * Math.sin(angle);
    return new THREE.Vector3(...p).add(this.middle);
  }

  // The ring that the pointer is on, and where on it.
  at(event) {
    let best = null, least = reachOf(kRing, event);
    for (const name of Object.keys(kAxes)) {
      for (let i = 0; i < kRingSteps; ++i) {
        const angle = 2 * Math.PI * i / kRingSteps;
        const way = pixelsAway(this.viewer, this.pointOf(name, angle), event);
        if (!way || Math.hypot(...way) >= least) continue;
        [best, least] = [{name, angle}, Math.hypot(...way)];
      }
    }
    return best;
  }

  // How far the pointer is around the ring, from the ring's first point; null
  // where one looks at the ring from aside.
  angleAt(event, name) {
    const axis = new THREE.Vector3(...kAxes[name]);
    const {ray, middle} = {ray: rayAt(this.viewer, event), middle: this.middle};
    if (Math.abs(axis.dot(ray.direction)) < kRingAside) return null;
    const hit = ray.intersectPlane(
        new THREE.Plane().setFromNormalAndCoplanarPoint(axis, middle),
        new THREE.Vector3());
    if (!hit) return null;
    const p = hit.sub(middle).toArray(), k = 'xyz'.indexOf(name);
    return Math.atan2(p[(k + 2) % 3], p[(k + 1) % 3]);
  }

  // By how much the pointer pulls a ring along that is seen from aside.
  pullOf(from, event, {name, angle}) {
    const step = 0.01;
    const [a, b] = [0, step].map(more => pixelsAway(
        this.viewer, this.pointOf(name, angle + more), event));
    if (!a || !b) return 0;
    const along = [(a[0] - b[0]) / step, (a[1] - b[1]) / step];
    const pulled = [event.clientX - from[0], event.clientY - from[1]];
    return (pulled[0] * along[0] + pulled[1] * along[1]) /
        Math.max(100, along[0] ** 2 + along[1] ** 2);
  }

  grab(e) {
    const {viewer} = this;
    if (e.button !== 0 || e.shiftKey || !viewer.state.show.marks ||
        !this.group.visible) return null;
    const ring = this.at(e);
    if (!ring) return null;
    const first = this.angleAt(e, ring.name);
    const from = [e.clientX, e.clientY];
    const before = asTurn(viewer.stage.endAt(this.key).turn);
    const axis = new THREE.Vector3(...kAxes[ring.name]);
    return event => {
      const now = first === null ? null : this.angleAt(event, ring.name);
      const angle = now === null ? this.pullOf(from, event, ring) : now - first;
      const {w, x, y, z} = new THREE.Quaternion()
          .setFromAxisAngle(axis, angle).multiply(before).normalize();
      this.turned(this.key, [w, x, y, z]);
    };
  }
}
