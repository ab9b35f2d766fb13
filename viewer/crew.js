// Who moves beside the robot that is followed: robots with solids of their own,
// all at once, and obstacles that move.

class Crew {
  // `stage`: with its ways.
  constructor(stage) {
    this.stage = stage;
    this.robots = [];  // {way, group, material}
    this.movers = [];  // {way, group}: of its points
    for (const way of stage.ways) {
      if (way.body) this.addRobot(way);
    }
    for (const mover of stage.data.movers) this.addMover(mover);
  }

  // Are there robots with solids of their own?
  get isTeam() { return this.robots.length > 0; }

  addBody(entry, material) {
    const mesh = decodeMesh(entry);
    const lines = new THREE.LineBasicMaterial({transparent: true, opacity: 0.45});
    this.stage.colored.push([lines, 'edge']);
    const group = new THREE.Group();
    const isWhole = entry.shown === entry.triangles;
    group.add(new THREE.Mesh(shadedGeometry(mesh), material),
              new THREE.LineSegments(
                  edgeGeometry(isWhole ? mesh : {positions: [], indices: []}),
                  lines));
    this.stage.scene.add(group);
    return group;
  }

  addRobot(way) {
    const material = new THREE.MeshPhongMaterial(
        {shininess: 40, specular: 0x333333, side: THREE.DoubleSide});
    this.robots.push({way, material, group: this.addBody(way.body, material)});
  }

  addMover({name, body, points}) {
    if (!body) return;
    const way = {kind: 'path', name, raw: points, pace: true,
                 points: points.map(p => this.stage.at(p))};
    this.movers.push({way, group: this.addBody(body,
                                               this.stage.solid('mover'))});
  }

  // Where the robot that follows a way is; null: it is none of these.
  placeOf(way) {
    const robot = way === undefined ? null
        : this.robots.find(r => r.way === this.stage.ways[way]);
    return robot && robot.group.visible ? robot.group.position : null;
  }

  // Of a mover: where it is while a motion that came later is played.
  retime(index, points) {
    const {way} = this.movers[index];
    way.raw = points;
    way.points = points.map(p => this.stage.at(p));
  }

  // All of them at t, 0 to 1, of the time of the way that is followed.
  show(shown, t) {
    const place = ({way, group}, isShown, time) => {
      group.visible = isShown && way.points.length > 0;
      if (group.visible) {
        group.position.copy(this.stage.placeOn(way, time).point);
      }
    };
    const isTimed = this.stage.ways.some(way => way.pace);
    for (const robot of this.robots) place(robot, shown.robot, isTimed ? t : 0);
    for (const mover of this.movers) place(mover, shown.movers, isTimed ? t : 0);
  }

  setTheme(name) {
    for (const {way, material} of this.robots) {
      material.color.copy(asColor(
          this.stage.colorOf(name, this.stage.ways.indexOf(way))));
    }
  }
}
