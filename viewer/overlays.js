// What lies behind an answer: what a planner grew, the planes around an
// optimised path, the windows that a depth was found in.  Each belongs to a path
// or an answer, and is drawn while that is followed; the bounds always are.

const kOverlays = {
  graphs: {color: 'graph'},  // named by itself
  planes: {text: 'planes of the corridor', color: 'plane'},
  windows: {text: 'windows that were built', color: 'window'},
  regions: {text: 'box that was searched', color: 'window'},
  bounds: {text: 'bounds of the position', color: 'window'},
};

class Overlays {
  // `stage`: that they stand on, with its ways.
  constructor(stage) {
    this.stage = stage;
    this.parts = [];  // {kind, way, frame, object}
    const {bounds, graphs, planes, regions, windows} = stage.data;
    for (const graph of graphs) this.addGraph(graph);
    for (const some of planes) this.addPlanes(some);
    for (const region of regions) this.addRegion(region);
    if (bounds) this.add({kind: 'bounds', object: this.box(bounds)});
    windows.forEach((window, i) => { if (window) this.addWindows(window, i); });
  }

  has(kind) { return this.parts.some(part => part.kind === kind); }

  // "retraction tree", "planes of the corridor"
  text(kind) {
    if (kind !== 'graphs') return kOverlays[kind].text;
    const names = new Set(this.stage.data.graphs.map(graph => graph.name));
    return [...names].slice(0, 3).join(', ');
  }

  // Those of the way that is followed, at its frame.
  show(shown, way, frame) {
    for (const part of this.parts) {
      part.object.visible = shown[part.kind] && (part.way === undefined || part.way === way) &&
          (part.frame === undefined || part.frame === frame);
    }
  }

  add(part) {
    this.stage.groups.behind.add(part.object);
    this.parts.push(part);
  }

  lines(color, positions, opacity) {
    const material = new THREE.LineBasicMaterial({transparent: true, opacity});
    this.stage.colored.push([material, color]);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position',
                          new THREE.Float32BufferAttribute(positions, 3));
    const lines = new THREE.LineSegments(geometry, material);
    lines.renderOrder = 12;
    return lines;
  }

  addGraph(graph) {
    const {positions, indices} = decodeMesh(graph);
    const ends = new Float32Array(3 * indices.length);
    indices.forEach((v, i) => ends.set(positions.subarray(3 * v, 3 * v + 3),
                                       3 * i));
    const object = new THREE.Group();
    // Of thousands each is faint, or they hide the path that came of them.
    const opacity = 0.75 * Math.max(0.1, Math.min(
        1, Math.sqrt(300 / Math.max(1, indices.length / 2))));
    object.add(this.lines('graph', ends, opacity));
    const material = new THREE.PointsMaterial(
        {size: 3, sizeAttenuation: false, transparent: true,
         opacity: Math.min(0.9, 1.2 * opacity)});
    this.stage.colored.push([material, 'graph']);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
    const points = new THREE.Points(geometry, material);
    points.renderOrder = 12;
    object.add(points);
    this.add({kind: 'graphs', way: graph.path, object});
  }

  // A square each, as wide as its segment is long, where it is lowest.
  addPlanes({path, planes}) {
    const corners = [], borders = [];
    for (const {point, normal, size} of planes) {
      const n = new THREE.Vector3(...normal);
      const u = new THREE.Vector3(Math.abs(n.z) < 0.9 ? 0 : 1, 0,
                                  Math.abs(n.z) < 0.9 ? 1 : 0)
          .cross(n).setLength(size / 2 / this.stage.data.scale);
      const v = n.clone().cross(u);
      const at = this.stage.at(point);
      const square = [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(
          ([a, b]) => at.clone().addScaledVector(u, a).addScaledVector(v, b));
      for (const k of [0, 1, 2, 0, 2, 3]) corners.push(...square[k].toArray());
      for (const k of [0, 1, 1, 2, 2, 3, 3, 0]) {
        borders.push(...square[k].toArray());
      }
    }
    const material = new THREE.MeshBasicMaterial(
        {side: THREE.DoubleSide, transparent: true, opacity: 0.16,
         depthWrite: false});
    this.stage.colored.push([material, 'plane']);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position',
                          new THREE.Float32BufferAttribute(corners, 3));
    const faces = new THREE.Mesh(geometry, material);
    faces.renderOrder = 12;
    const object = new THREE.Group();
    object.add(faces, this.lines('plane', borders, 0.5));
    this.add({kind: 'planes', way: path, object});
  }

  // The edges of a box whose middle and half sides (three vectors) are given.
  boxEnds(center, sides) {
    const corner = k => sides.reduce(
        (p, side, d) => p.addScaledVector(side, k >> d & 1 ? 1 : -1),
        center.clone());
    const ends = [];
    for (let k = 0; k < 8; ++k) {
      for (let d = 0; d < 3; ++d) {
        if (k >> d & 1) continue;
        ends.push(...corner(k).toArray(), ...corner(k | 1 << d).toArray());
      }
    }
    return ends;
  }

  box({min, max}) {
    const half = max.map((x, k) => (x - min[k]) / 2 / this.stage.data.scale);
    const sides = half.map((x, k) => new THREE.Vector3().setComponent(k, x));
    const ends = this.boxEnds(
        this.stage.at(max.map((x, k) => (x + min[k]) / 2)), sides);
    return this.lines('window', ends, 0.6);
  }

  addRegion(region) {
    this.add({kind: 'regions', way: region.path, object: this.box(region)});
  }

  // Cubes around the position that was asked about.
  addWindows({reaches, axes}, frame) {
    const {stage} = this;
    const way = stage.ways.findIndex(w => w.kind === 'answers');
    const center = stage.ways[way].points[frame];
    const sides = axes.map(axis => new THREE.Vector3(...axis));
    const ends = reaches.flatMap(reach => this.boxEnds(
        center, sides.map(side => side.clone().multiplyScalar(
            reach / stage.data.scale))));
    this.add({kind: 'windows', way, frame,
              object: this.lines('window', ends, 0.9)});
  }
}
