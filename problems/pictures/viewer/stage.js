// What stands on the stage, in lengths of the scene's size around its centre.

class Stage {
  constructor(data) {
    this.data = data;
    this.scene = new THREE.Scene();
    this.plane = new THREE.Plane(new THREE.Vector3(-1, 0, 0), 10);
    this.center = new THREE.Vector3(...data.center);
    this.groups = {};
    for (const name of ['obstacle', 'contact', 'mesh', 'caps', 'paths', 'marks',
                        'stages', 'traces']) {
      this.groups[name] = new THREE.Group();
      this.scene.add(this.groups[name]);
    }
    this.solids = [];    // {mesh, edges, role}
    this.glass = [];     // materials whose rims are denser
    this.colored = [];   // [material, name of its colour in the theme]
    // Nothing to see behind a contact space that is alone.
    this.glassOpacity = data.meshes.every(m => m.role === 'contact') &&
        !data.paths.length && !data.motion && !data.answers.length ? 0.42 : 0.2;
    this.light();
    for (const entry of data.meshes) this.addMesh(entry);
    this.addCap();
    this.addRobot();
    this.ways = this.makeWays();
    this.addWays();
    this.addMarks();
  }

  // The user's coordinates to the stage's.
  at(point) {
    return new THREE.Vector3(...point).sub(this.center)
        .divideScalar(this.data.scale);
  }

  light() {
    const sky = new THREE.HemisphereLight(0xffffff, 0x9a958e, 0.66);
    sky.position.set(0, 0, 1);
    this.scene.add(sky);
    this.key = new THREE.DirectionalLight(0xffffff, 0.55);
    this.scene.add(this.key);
    const fill = new THREE.DirectionalLight(0xdfe9ff, 0.2);
    fill.position.set(-3, 2, -1);
    this.scene.add(fill);
  }

  solid(color, more) {
    const material = new THREE.MeshPhongMaterial({
      shininess: 18, specular: 0x222222, side: THREE.DoubleSide,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
      ...more,
    });
    this.colored.push([material, color]);
    return material;
  }

  // Clear where one looks straight through it, dense at its rims.
  makeGlass(material) {
    material.transparent = true;
    material.depthWrite = false;
    material.onBeforeCompile = shader => {
      shader.fragmentShader = shader.fragmentShader.replace(
          '#include <premultiplied_alpha_fragment>',
          'gl_FragColor.a *= mix(0.55, 2.6, pow(1.0 - abs(dot(normalize(' +
          'vViewPosition), normal)), 2.5));\n' +
          '#include <premultiplied_alpha_fragment>');
    };
    this.glass.push(material);
  }

  addMesh(entry) {
    const mesh = decodeMesh(entry);
    const geometry = shadedGeometry(mesh);
    const group = new THREE.Group();
    const clip = {clippingPlanes: [this.plane]};
    const lines = new THREE.LineBasicMaterial(
        {transparent: true, opacity: 0.55, ...clip});
    // What was simplified for display has creases that the solid has not.
    const isWhole = entry.shown === entry.triangles;
    const edges = new THREE.LineSegments(
        edgeGeometry(isWhole ? mesh : {positions: [], indices: []}), lines);
    edges.renderOrder = 3;
    const solid = {entry, mesh, geometry, edges, group, faces: []};
    if (entry.role === 'contact') {
      lines.opacity = 0.3;
      this.colored.push([lines, 'contact']);
      for (const side of [THREE.BackSide, THREE.FrontSide]) {
        const material = this.solid('contact', {side, ...clip});
        this.makeGlass(material);
        material.opacity = this.glassOpacity;
        const faces = new THREE.Mesh(geometry, material);
        faces.renderOrder = side === THREE.BackSide ? 10 : 11;
        solid.faces.push(faces);
      }
    } else {
      this.colored.push([lines, 'edge']);
      solid.faces.push(new THREE.Mesh(
          geometry, this.solid(this.colorName(entry), {...clip})));
      this.addStencil(solid);
    }
    group.add(...solid.faces, edges);
    this.groups[entry.role].add(group);
    this.solids.push(solid);
  }

  // Meshes side by side take turns.
  colorName(entry) {
    if (entry.role !== 'mesh') return entry.role;
    const i = this.data.meshes.filter(m => m.role === 'mesh').indexOf(entry);
    return ['mesh', 'mesh2', 'obstacle'][i % 3];
  }

  // Counts, at each pixel, how many of the solid's surfaces lie before the
  // plane; where they do not cancel, the plane runs inside.
  addStencil(solid) {
    for (const [side, operation] of [
             [THREE.BackSide, THREE.IncrementWrapStencilOp],
             [THREE.FrontSide, THREE.DecrementWrapStencilOp]]) {
      const material = new THREE.MeshBasicMaterial({
        side, depthWrite: false, depthTest: false, colorWrite: false,
        clippingPlanes: [this.plane], stencilWrite: true,
        stencilFunc: THREE.AlwaysStencilFunc, stencilFail: operation,
        stencilZFail: operation, stencilZPass: operation,
      });
      const mesh = new THREE.Mesh(solid.geometry, material);
      mesh.renderOrder = -2;
      this.groups.caps.add(mesh);
    }
  }

  addCap() {
    const material = new THREE.MeshBasicMaterial({
      side: THREE.DoubleSide, stencilWrite: true, stencilRef: 0,
      stencilFunc: THREE.NotEqualStencilFunc,
      stencilFail: THREE.ReplaceStencilOp,
      stencilZFail: THREE.ReplaceStencilOp,
      stencilZPass: THREE.ReplaceStencilOp,
    });
    this.colored.push([material, 'cap']);
    this.cap = new THREE.Mesh(new THREE.PlaneBufferGeometry(4, 4), material);
    this.cap.renderOrder = -1;
    this.groups.caps.add(this.cap);
  }

  addRobot() {
    const entry = this.data.robot;
    this.robot = new THREE.Group();
    this.robotMaterial = new THREE.MeshPhongMaterial(
        {shininess: 40, specular: 0x333333, side: THREE.DoubleSide});
    this.ghostMaterial = new THREE.MeshPhongMaterial(
        {side: THREE.DoubleSide, transparent: true, opacity: 0.28,
         depthWrite: false});
    if (entry) {
      const mesh = decodeMesh(entry);
      this.robotShape = shadedGeometry(mesh);
      const lines = new THREE.LineBasicMaterial(
          {transparent: true, opacity: 0.45});
      this.colored.push([lines, 'edge']);
      this.robot.add(new THREE.LineSegments(edgeGeometry(mesh), lines));
    } else {
      this.robotShape = new THREE.SphereBufferGeometry(0.012, 24, 16);
    }
    this.robot.add(new THREE.Mesh(this.robotShape, this.robotMaterial));
    this.scene.add(this.robot);
  }

  ghost(material) {
    const mesh = new THREE.Mesh(this.robotShape, material);
    mesh.renderOrder = 20;
    return mesh;
  }

  // What the robot can follow: paths, or a motion, or poses with answers.
  makeWays() {
    const {paths, motion, answers} = this.data;
    const ways = paths.map(path => ({
      kind: 'path', name: path.name, free: path.free, raw: path.points,
      points: path.points.map(p => this.at(p)),
    }));
    if (motion) {
      ways.push({kind: 'motion', name: 'motion', free: true,
                 raw: motion.positions,
                 points: motion.positions.map(p => this.at(p))});
    }
    if (answers.length) {
      const raw = answers.map(answer => answer.position);
      ways.push({kind: 'answers', free: true, raw,
                 name: answers.length === 1 ? 'pose' : 'poses',
                 points: raw.map(p => this.at(p))});
    }
    for (const way of ways) {
      way.lengths = [0];
      for (let i = 1; i < way.points.length; ++i) {
        way.lengths.push(way.lengths[i - 1] +
                         way.points[i].distanceTo(way.points[i - 1]));
      }
    }
    return ways;
  }

  addWays() {
    this.wayMaterials = [];
    const radius = 0.0038;
    for (const way of this.ways) {
      const material = new THREE.MeshPhongMaterial(
          {shininess: 10, side: THREE.DoubleSide});
      this.wayMaterials.push(material);
      way.group = new THREE.Group();
      this.groups.paths.add(way.group);
      way.stages = new THREE.Group();
      this.groups.stages.add(way.stages);
      if (way.points.length < 2 || way.kind === 'answers') continue;
      const points = thinned(way.points, 1500);
      const pieces = way.free ? [points] : dashes(points, 0.022, 0.014);
      const r = way.kind === 'motion' ? radius * 0.5 : radius;
      way.group.add(new THREE.Mesh(tubeGeometry(pieces, r), material));
      for (let i = 0; i <= 6; ++i) {
        const ghost = this.ghost(this.ghostMaterial);
        ghost.position.copy(this.placeOn(way, i / 6).point);
        way.stages.add(ghost);
      }
    }
    const {motion, answers, probe} = this.data;
    const count = motion ? motion.traces.length : answers.length ? 1 : 0;
    this.arrows = Array.from({length: count}, () => this.makeArrow());
    this.probeArrows = probe ? kProbeMetrics.map(() => this.makeArrow()) : [];
  }

  makeArrow() {
    const group = new THREE.Group();
    const material = new THREE.MeshPhongMaterial({shininess: 10});
    const pale = this.ghostMaterial.clone();
    const shaft = new THREE.Mesh(
        new THREE.CylinderBufferGeometry(1, 1, 1, 16), material);
    const head = new THREE.Mesh(
        new THREE.ConeBufferGeometry(1, 1, 20), material);
    const ghost = this.ghost(pale);
    const ends = [0, 1].map(() => new THREE.Mesh(
        new THREE.SphereBufferGeometry(0.007, 16, 12), material));
    for (const part of [shaft, head, ...ends]) part.renderOrder = 30;
    material.depthTest = false;
    material.transparent = true;  // drawn after all else: never hidden
    group.add(shaft, head, ghost, ...ends);
    group.visible = false;
    this.groups.traces.add(group);
    return {group, shaft, head, ghost, ends, material, pale};
  }

  addMarks() {
    this.labels = [];  // {text, point, way}
    const mark = (point, shape, text) => {
      if (!point) return;
      const material = new THREE.MeshBasicMaterial();
      this.colored.push([material, 'mark']);
      const mesh = new THREE.Mesh(shape, material);
      mesh.position.copy(this.at(point));
      this.groups.marks.add(mesh);
      const ghost = this.ghost(this.ghostMaterial);
      ghost.position.copy(mesh.position);
      this.groups.marks.add(ghost);
      this.labels.push({text, point: mesh.position});
    };
    mark(this.data.start, new THREE.SphereBufferGeometry(0.008, 20, 14),
         'start');
    mark(this.data.goal, new THREE.OctahedronBufferGeometry(0.013), 'goal');
    const paths = this.ways.filter(way => way.kind === 'path');
    if (paths.length > 8) return;  // labels would cover each other
    paths.forEach((way, i) => {
      if (way.points.length === 0) return;
      const share = paths.length === 1
          ? 0.3 : 0.2 + 0.5 * i / (paths.length - 1);
      this.labels.push({text: way.name, way: i,
                        point: this.placeOn(way, share).point});
    });
  }

  // Where the robot is at t of the way, 0 to 1: along a path by length, in a
  // motion by frames, from pose to pose without between.
  placeOn(way, t) {
    const {points, lengths} = way, last = points.length - 1;
    if (last < 0) return null;
    if (way.kind !== 'path' || last === 0) {
      const frame = Math.round(t * last);
      return {point: points[frame].clone(), raw: way.raw[frame], frame};
    }
    const travelled = t * lengths[last];
    let i = 1;
    while (i < last && lengths[i] < travelled) ++i;
    const step = lengths[i] - lengths[i - 1];
    const share = step > 0 ? (travelled - lengths[i - 1]) / step : 0;
    const a = way.raw[i - 1], b = way.raw[i];
    return {point: points[i - 1].clone().lerp(points[i], share),
            raw: a.map((x, k) => x + share * (b[k] - x)), frame: i};
  }

  setArrow(arrow, from, to, width = 0.006) {
    const way = to.clone().sub(from), length = way.length();
    const isShown = length > 1e-6;
    arrow.shaft.visible = arrow.head.visible = isShown;
    arrow.ends.forEach((end, k) => end.position.copy(k ? to : from));
    if (!isShown) return;
    const direction = way.clone().divideScalar(length);
    const turn = new THREE.Quaternion().setFromUnitVectors(
        new THREE.Vector3(0, 1, 0), direction);
    const tip = Math.min(0.045, 0.45 * length);
    arrow.shaft.quaternion.copy(turn);
    arrow.head.quaternion.copy(turn);
    arrow.shaft.scale.set(width, length - tip, width);
    arrow.shaft.position.copy(from).addScaledVector(direction,
                                                    (length - tip) / 2);
    arrow.head.scale.set(tip * 0.36, tip, tip * 0.36);
    arrow.head.position.copy(to).addScaledVector(direction, -tip / 2);
  }

  // The robot at t of a way, with arrows of what is known there.
  pose(index, t) {
    const way = this.ways[index];
    const place = way ? this.placeOn(way, t) : null;
    // A robot without a way stands at the start, or where it was modelled.
    const rest = this.data.start ? this.at(this.data.start)
                                 : this.at([0, 0, 0]);
    this.robot.position.copy(place ? place.point : rest);
    this.robot.quaternion.set(0, 0, 0, 1);
    for (const arrow of [...this.arrows, ...this.probeArrows]) {
      arrow.group.visible = false;
    }
    if (!place) return null;
    const scale = this.data.scale;
    if (way.kind === 'motion') {
      this.data.motion.traces.forEach((trace, i) => {
        const arrow = this.arrows[i];
        const pd = new THREE.Vector3(...trace.pd[place.frame])
            .divideScalar(scale);
        const to = place.point.clone().add(pd);
        this.setArrow(arrow, place.point, to);
        arrow.ghost.position.copy(to);
        arrow.ghost.visible = pd.length() > 1e-6;
        arrow.ends.forEach(end => { end.visible = false; });
        arrow.group.visible = true;
      });
    } else if (way.kind === 'answers') {
      const answer = this.data.answers[place.frame], arrow = this.arrows[0];
      const [w, x, y, z] = answer.orientation;
      this.robot.quaternion.set(x, y, z, w);
      arrow.group.visible = answer.on_a !== null;
      if (answer.on_a !== null) {
        const a = this.at(answer.on_a), b = this.at(answer.on_b);
        this.setArrow(arrow, a, b);
        arrow.ghost.position.copy(place.point).add(b).sub(a);
        arrow.ghost.quaternion.copy(this.robot.quaternion);
        arrow.ghost.visible = answer.depth > 0;
      }
    }
    return place;
  }

  // Is most of the shown way behind obstacles, seen from the camera?
  isHidden(camera) {
    const solids = this.solids.filter(s => s.entry.role === 'obstacle');
    const way = this.ways.find(w => w.points.length > 0);
    const triangles = solids.reduce((n, s) => n + s.entry.shown, 0);
    if (!way || solids.length === 0 || triangles > 60000) return false;
    const ray = new THREE.Raycaster();
    const count = 12;
    let hidden = 0;
    for (let i = 0; i < count; ++i) {
      const point = this.placeOn(way, i / (count - 1)).point;
      const direction = point.clone().sub(camera.position);
      ray.far = direction.length() * 0.999;
      ray.set(camera.position, direction.normalize());
      if (ray.intersectObjects(solids.map(s => s.faces[0])).length) ++hidden;
    }
    return hidden > 0.55 * count;
  }

  setClip(clip) {
    const axis = 'xyz'.indexOf(clip.axis);
    const normal = new THREE.Vector3();
    normal.setComponent(axis, clip.flip ? 1 : -1);
    const low = this.box.min.getComponent(axis);
    const high = this.box.max.getComponent(axis);
    const level = low + (clip.at * 1.004 - 0.002) * (high - low);
    this.plane.normal.copy(normal);
    this.plane.constant = clip.on ? (clip.flip ? -level : level) : 10;
    this.cap.position.set(0, 0, 0);
    this.cap.position.setComponent(axis, level);
    this.cap.lookAt(this.cap.position.clone().add(normal));
    this.isClipped = clip.on;
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
    for (const end of [this.data.start, this.data.goal]) {
      if (end) box.expandByPoint(this.at(end));
    }
    const robot = new THREE.Box3().setFromBufferAttribute(
        this.robotShape.attributes.position);
    if (box.isEmpty()) {
      box.copy(robot).translate(this.at([0, 0, 0]));
    } else if (this.ways.length) {
      const size = robot.getSize(new THREE.Vector3()).length() / 4;
      box.expandByScalar(Math.min(size, 0.1));
    }
    return this.box_ = box;
  }

  // What the first view must hold: all, or of a motion where the robot is and
  // is pushed to.
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
