// Taking hold of start and goal: in the plane across the view, or along an axis.

const kHandle = {mouse: 16, touch: 30};  // pixels around the mark
const kAxes = {x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1]};

// By the kind of pointer: fingers are wide.
function reachOf(handle, event) {
  return handle[event.pointerType === 'touch' ? 'touch' : 'mouse'];
}

// Pixels from the pointer to a point of the stage; null: it is behind the eye.
function pixelsAway(viewer, point, event) {
  const box = byId('canvas').getBoundingClientRect();
  const p = point.clone().project(viewer.camera);
  if (p.z > 1) return null;
  return [event.clientX - box.left - (p.x + 1) / 2 * box.width,
          event.clientY - box.top - (1 - p.y) / 2 * box.height];
}

// From the eye through the pointer.
function rayAt(viewer, event) {
  const box = byId('canvas').getBoundingClientRect();
  const ray = new THREE.Raycaster();
  ray.setFromCamera(new THREE.Vector2(
      (event.clientX - box.left) / box.width * 2 - 1,
      1 - (event.clientY - box.top) / box.height * 2), viewer.camera);
  return ray.ray;
}

class EndDrag {
  // `isChosen(key)`: is it of the robot that was chosen?  `taken(key)` is told
  // which end somebody takes hold of, `moved(key, raw)` of every place.
  constructor(viewer, isChosen, taken, moved) {
    Object.assign(this, {viewer, isChosen, taken, moved});
    this.axis = '';  // '': across the view
    viewer.orbit.grabs.push(e => this.grab(e));
  }

  // The nearest of all ends, if the pointer is on one of them; of two in one
  // place that which is chosen.
  at(event) {
    let best = null, least = reachOf(kHandle, event);
    for (const [key, [mark]] of Object.entries(this.viewer.stage.ends)) {
      const way = pixelsAway(this.viewer, mark.position, event);
      if (!way) continue;
      const away = Math.hypot(...way) - (this.isChosen(key) ? 2 : 0);
      if (away < least) [best, least] = [key, away];
    }
    return best;
  }

  // Where the pointer says an end is, from `from` on: in the stage's lengths.
  target(event, from, axis) {
    const ray = rayAt(this.viewer, event);
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
    const key = this.at(e);
    if (!key) return null;
    const {stage, data} = viewer;
    // With ctrl, up and down.
    const axis = e.ctrlKey ? 'z' : this.axis;
    const from = stage.ends[key][0].position.clone();
    const raw = stage.endAt(key).place.slice();
    const first = this.target(e, from, axis);
    if (!first) return null;
    this.taken(key);
    return event => {
      const now = this.target(event, from, axis);
      if (!now) return;
      const way = now.sub(first).toArray();
      this.moved(key, raw.map((x, k) => x + data.scale * way[k]));
    };
  }
}
