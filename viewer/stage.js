// Who acts on the stage: the robot, its ways, arrows and marks.

const kPathRadius = 0.0038;

function asTurn([w, x, y, z]) { return new THREE.Quaternion(x, y, z, w); }

// From the first point to each, along them; what turns at a reach has a way of
// that, too.
function lengthsOf(points, turns = null, reach = 0) {
  const lengths = [0];
  for (let i = 1; i < points.length; ++i) {
    const angle = turns ? turns[i].angleTo(turns[i - 1]) : 0;
    lengths.push(lengths[i - 1] + Math.hypot(
        points[i].distanceTo(points[i - 1]), angle * reach));
  }
  return lengths;
}

// Of a way; dashed where it collides.
function pathGeometry(way, radius) {
  const points = thinned(way.points, 1500);
  return tubeGeometry(way.free ? [points] : dashes(points, 0.022, 0.014),
                      radius);
}

class Stage extends Solids {
  constructor(data) {
    super(data);
    this.addCap();
    this.addRobot();
    this.ways = this.makeWays();
    this.addWays();
    this.addMarks();
    this.crew = new Crew(this);
    this.overlays = new Overlays(this);
    this.iterates = new Iterates(this);
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

  // Of what follows a way, or of the one robot.
  ghost(material, way) {
    const mesh = new THREE.Mesh((way && way.shape) || this.robotShape, material);
    mesh.renderOrder = 20;
    return mesh;
  }

  // What the robot can follow: paths, or a motion, or poses with answers.
  makeWays() {
    const {paths, motion, answers} = this.data;
    const ways = paths.map(path => this.wayOf(path));
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
    for (const way of ways) this.measure(way);
    return ways;
  }

  // Of an entry of the page's paths.
  wayOf(path) {
    return {
      kind: 'path', name: path.name, free: path.free, raw: path.points,
      pace: path.pace, body: path.robot,
      turns: path.turns ? path.turns.map(asTurn) : null,
      shape: path.robot ? shadedGeometry(decodeMesh(path.robot)) : null,
      points: path.points.map(p => this.at(p)),
    };
  }

  measure(way) {
    this.robotShape.computeBoundingSphere();
    const {center, radius} = this.robotShape.boundingSphere;
    way.lengths = lengthsOf(way.points, way.turns, center.length() + radius);
  }

  addWays() {
    this.wayMaterials = this.ways.map(way => this.drawWay(way));
    const {motion, answers, probe} = this.data;
    const count = motion ? motion.traces.length : answers.length ? 1 : 0;
    this.arrows = Array.from({length: count}, () => this.makeArrow());
    this.probeArrows = probe ? kProbeMetrics.map(() => this.makeArrow()) : [];
    this.solved = this.makeArrow();  // of a depth that the page asked for
  }

  // Returns its material.
  drawWay(way) {
    const material = new THREE.MeshPhongMaterial(
        {shininess: 10, side: THREE.DoubleSide});
    way.group = new THREE.Group();
    this.groups.paths.add(way.group);
    way.stages = new THREE.Group();
    this.groups.stages.add(way.stages);
    if (way.points.length < 2 || way.kind === 'answers') return material;
    const radius = way.kind === 'motion' ? kPathRadius / 2 : kPathRadius;
    way.group.add(new THREE.Mesh(pathGeometry(way, radius), material));
    for (let i = 0; i <= 6; ++i) {
      const ghost = this.ghost(this.ghostMaterial, way);
      const place = this.placeOn(way, i / 6);
      ghost.position.copy(place.point);
      if (place.turn) ghost.quaternion.copy(place.turn);
      way.stages.add(ghost);
    }
    return material;
  }

  // A path that comes later, in place of way `index` or, with −1, as another.
  // Returns its number.
  putWay(path, index) {
    const way = this.wayOf(path), at = index < 0 ? this.ways.length : index;
    this.measure(way);
    if (index >= 0) {
      this.groups.paths.remove(this.ways[at].group);
      this.groups.stages.remove(this.ways[at].stages);
      this.labels = this.labels.filter(label => label.way !== at);
    }
    this.ways[at] = way;
    this.wayMaterials[at] = this.drawWay(way);
    if (way.points.length > 0) {
      this.labels.push({text: way.name.split(' · ')[0], way: at,
                        point: this.placeOn(way, 0.4).point});
    }
    return at;
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

  // An end by its key: "start", "goal", of several robots "start 2".  Where its
  // place is kept, and the place and the turn there.
  endAt(key) {
    const [name, robot] = key.split(' ');
    const of = robot === undefined ? this.data : this.data.ends[robot];
    return {of, name, robot, place: of[name],
            turn: of[name + '_turn'] || [1, 0, 0, 0]};
  }

  // Of several robots each mark has the colour of its own.
  addMark(key, text) {
    const {name, robot, place, turn} = this.endAt(key);
    const material = new THREE.MeshBasicMaterial();
    if (robot === undefined) this.colored.push([material, 'mark']);
    else this.ownMarks.push({material, way: Number(robot)});
    const mesh = new THREE.Mesh(
        name === 'start' ? new THREE.SphereBufferGeometry(0.008, 20, 14)
                         : new THREE.OctahedronBufferGeometry(0.013), material);
    mesh.position.copy(this.at(place));
    const ghost = this.ghost(this.ghostMaterial, this.ways[robot]);
    ghost.position.copy(mesh.position);
    ghost.quaternion.copy(asTurn(turn));
    this.groups.marks.add(mesh, ghost);
    if (text) {
      this.labels.push({text, point: mesh.position,
                        owner: robot && Number(robot)});
    }
    this.ends[key] = [mesh, ghost];
  }

  addMarks() {
    this.labels = [];  // {text, point}, and the way that it is of or that owns it
    this.ends = {};    // of start and goal, by their keys: what is drawn there
    this.ownMarks = [];  // {material, way}
    if (this.data.start) this.addMark('start', 'start');
    if (this.data.goal) this.addMark('goal', 'goal');
    this.data.ends.forEach(({robot}, i) => {
      this.addMark('start ' + i, '');
      this.addMark('goal ' + i, 'goal of ' + robot);
    });
    const paths = this.ways.filter(way => way.kind === 'path');
    if (paths.length > 8) return;  // labels would cover each other
    paths.forEach((way, i) => {
      if (way.points.length === 0) return;
      const share = paths.length === 1
          ? 0.3 : 0.2 + 0.5 * i / (paths.length - 1);
      this.labels.push({text: this.shortName(way, paths), way: i,
                        point: this.placeOn(way, share).point});
    });
  }

  // What sets it apart from others: "PhongPD, ℓ = 0.2" of all that the legend
  // says, and "straight start" where another has that, too, and is without.
  shortName(way, paths) {
    const parts = name => name.split(' · '), [first, ...rest] = parts(way.name);
    const alike = paths.map(w => parts(w.name)).filter(p => p[0] === first);
    return [first, ...rest.filter(part => !alike.every(p => p.includes(part)))]
        .join(' · ');
  }

  // Start or goal, to a point in the user's unit.
  moveEnd(key, raw) {
    const {of, name, robot} = this.endAt(key);
    of[name] = raw;
    for (const part of this.ends[key]) part.position.copy(this.at(raw));
    const way = this.ways[robot];
    // A robot that has no path yet stands there.
    if (!way || name !== 'start' || way.points.length !== 1) return;
    way.raw[0] = raw;
    way.points[0].copy(this.at(raw));
  }

  turnEnd(key, turn) {
    const {of, name} = this.endAt(key);
    of[name + '_turn'] = turn;
    for (const part of this.ends[key]) part.quaternion.copy(asTurn(turn));
  }

  // Where the robot is at t of the way, 0 to 1: along a path by length, or by
  // its own time, in a motion by frames, from pose to pose without between.
  placeOn(way, t) {
    const {points, lengths} = way, last = points.length - 1;
    if (last < 0) return null;
    if (way.kind !== 'path' || last === 0) {
      const frame = Math.round(t * last);
      return {point: points[frame].clone(), raw: way.raw[frame], frame};
    }
    let i = 1, share = 0;
    if (way.pace) {
      i = Math.min(last, 1 + Math.floor(t * last));
      share = t * last - (i - 1);
    } else {
      const travelled = t * lengths[last];
      while (i < last && lengths[i] < travelled) ++i;
      const step = lengths[i] - lengths[i - 1];
      share = step > 0 ? (travelled - lengths[i - 1]) / step : 0;
    }
    const a = way.raw[i - 1], b = way.raw[i];
    const turn = way.turns
        ? way.turns[i - 1].clone().slerp(way.turns[i], share) : null;
    return {turn, point: points[i - 1].clone().lerp(points[i], share),
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
    const way = this.iterates.shown || this.ways[index];
    const place = way ? this.placeOn(way, t) : null;
    // A robot without a way stands at the start, or where it was modelled.
    const rest = this.data.start ? this.at(this.data.start)
                                 : this.at([0, 0, 0]);
    this.robot.position.copy(place ? place.point : rest);
    this.robot.quaternion.copy(asTurn(place ? [1, 0, 0, 0]
                                            : this.data.start_turn));
    for (const arrow of [...this.arrows, ...this.probeArrows]) {
      arrow.group.visible = false;
    }
    if (!place) return null;
    if (place.turn) this.robot.quaternion.copy(place.turn);
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
}
