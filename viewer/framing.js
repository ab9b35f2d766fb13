// What the first view holds, and what the cutting plane goes through.

class FramedStage extends Stage {
  // Is a good part of the shown way, or of start and goal where there is none,
  // behind obstacles, seen from the camera?
  isHidden(camera) {
    const solids = this.solids.filter(s => s.entry.role === 'obstacle');
    const way = this.ways.find(w => w.points.length > 0);
    const triangles = solids.reduce((n, s) => n + s.entry.shown, 0);
    if (solids.length === 0 || triangles > 60000) return false;
    const ray = new THREE.Raycaster();
    // Of a scene without a way its ends.
    const points = way ? Array.from({length: 12}, (_, i) =>
      this.placeOn(way, i / 11).point)
        : Object.values(this.ends).map(([mark]) => mark.position);
    let hidden = 0;
    for (const point of points) {
      const direction = point.clone().sub(camera.position);
      ray.far = direction.length() * 0.999;
      ray.set(camera.position, direction.normalize());
      if (ray.intersectObjects(solids.map(s => s.faces[0])).length) ++hidden;
    }
    return hidden > 0.35 * points.length;
  }

  // Around everything but a robot on its way.
  get box() {
    if (this.box_) return this.box_;
    const box = new THREE.Box3();
    for (const solid of this.solids) {
      box.union(new THREE.Box3().setFromBufferAttribute(
          solid.geometry.attributes.position));
    }
    for (const way of this.ways) way.points.forEach(p => box.expandByPoint(p));
    for (const {way} of this.crew.movers) {
      way.points.forEach(p => box.expandByPoint(p));
    }
    for (const [mark] of Object.values(this.ends)) {
      box.expandByPoint(mark.position);
    }
    // A scene alone: the room it has tells where things are, if it is no waste.
    const {bounds} = this.data;
    if (bounds && this.ways.length === 0) {
      const all = box.clone();
      for (const p of [bounds.min, bounds.max]) all.expandByPoint(this.at(p));
      const length = b => b.getSize(new THREE.Vector3()).length();
      if (length(all) < 2 * length(box)) box.copy(all);
    }
    const own = this.ways.find(way => way.shape);
    const robot = new THREE.Box3().setFromBufferAttribute(
        (own ? own.shape : this.robotShape).attributes.position);
    if (box.isEmpty()) {
      box.copy(robot).translate(this.at([0, 0, 0]));
    } else if (this.ways.length) {
      const size = robot.getSize(new THREE.Vector3()).length() / 4;
      box.expandByScalar(Math.min(size, 0.1));
    }
    return this.box_ = box;
  }

  // Are the bounds of the position in the first view?  Others are lines that
  // cross it from nowhere to nowhere.
  get areBoundsNear() {
    const {bounds} = this.data;
    if (!bounds) return true;
    const size = new THREE.Vector3();
    const near = this.box.clone().expandByScalar(
        0.12 * this.box.getSize(size).length());
    return [bounds.min, bounds.max].every(p => near.containsPoint(this.at(p)));
  }

  // What the first view must hold: all, or of a motion where the robot is
  // and is pushed to.
  get focus() {
    const {motion, scale} = this.data;
    if (!motion || !this.robotShape) return this.box;
    const box = new THREE.Box3();
    motion.positions.forEach((q, f) => {
      for (const {pd} of motion.traces) {
        if (Math.hypot(...pd[f]) < 1e-6 * scale) continue;
        box.expandByPoint(this.at(q));
        box.expandByPoint(this.at(q.map((x, k) => x + pd[f][k])));
      }
    });
    if (box.isEmpty()) return this.box;
    this.robotShape.computeBoundingSphere();
    box.expandByScalar(Math.max(1.3 * this.robotShape.boundingSphere.radius,
                                0.05));
    return box;
  }

  get corners() {
    const {min, max} = this.focus;
    return [0, 1, 2, 3, 4, 5, 6, 7].map(k => new THREE.Vector3(
        k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z));
  }
}
