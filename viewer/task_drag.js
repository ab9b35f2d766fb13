// Taking hold of start and goal: in the plane across the view, or along an axis.

const kHandle = {mouse: 16, touch: 30};  // pixels around the mark
const kAxes = {x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1]};

class EndDrag {
  // `moved(name, raw)` is told of every place.
  constructor(viewer, moved) {
    this.viewer = viewer;
    this.moved = moved;
    this.axis = '';  // '': across the view
    viewer.orbit.grabs.push(e => this.grab(e));
  }

  aim(event) {
    const box = byId('canvas').getBoundingClientRect();
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2(
        (event.clientX - box.left) / box.width * 2 - 1,
        1 - (event.clientY - box.top) / box.height * 2), this.viewer.camera);
    return ray.ray;
  }

  // The nearer of start and goal, if the pointer is on one of them.
  at(event) {
    const {viewer} = this;
    const box = byId('canvas').getBoundingClientRect();
    let best = null;
    let least = kHandle[event.pointerType === 'touch' ? 'touch' : 'mouse'];
    for (const name of ['start', 'goal']) {
      const p = viewer.stage.ends[name][0].position.clone()
          .project(viewer.camera);
      if (p.z > 1) continue;
      const away = Math.hypot(
          box.left + (p.x + 1) / 2 * box.width - event.clientX,
          box.top + (1 - p.y) / 2 * box.height - event.clientY);
      if (away < least) [best, least] = [name, away];
    }
    return best;
  }

  // Where the pointer says an end is, from `from` on: in the stage's lengths.
  target(event, from, axis) {
    const ray = this.aim(event);
    if (!axis) {
      const across = new THREE.Plane().setFromNormalAndCoplanarPoint(
          this.viewer.camera.getWorldDirection(new THREE.Vector3()), from);
      return ray.intersectPlane(across, new THREE.Vector3());
    }
    // The point of the axis that is nearest to the ray.
    const along = new THREE.Vector3(...kAxes[axis]);
    const cosine = along.dot(ray.direction);
    if (Math.abs(cosine) > 0.999) return null;  // one looks along it
    const way = from.clone().sub(ray.origin);
    const t = (ray.direction.dot(way) * cosine - along.dot(way)) /
        (1 - cosine * cosine);
    return from.clone().addScaledVector(along, t);
  }

  grab(e) {
    const {viewer} = this;
    if (e.button !== 0 || e.shiftKey || !viewer.state.show.marks) return null;
    const name = this.at(e);
    if (!name) return null;
    const {stage, data} = viewer;
    // With ctrl, up and down.
    const axis = e.ctrlKey ? 'z' : this.axis;
    const from = stage.ends[name][0].position.clone(), raw = data[name].slice();
    const first = this.target(e, from, axis);
    if (!first) return null;
    return event => {
      const now = this.target(event, from, axis);
      if (!now) return;
      const way = now.sub(first).toArray();
      this.moved(name, raw.map((x, k) => x + data.scale * way[k]));
    };
  }
}
