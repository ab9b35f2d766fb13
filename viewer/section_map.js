// The cutting plane coloured by what the metrics say there, within the contact
// space: each point a position of the robot, asked cold (probe.js).

const kMaps = {
  euclidean: {text: 'Euclidean depth', of: e => -e.distance, isLength: true},
  phong: {text: 'PhongPD depth', of: (e, p) => -p.distance, isLength: true},
  ratio: {text: 'PhongPD / Euclidean depth', least: 1, unit: '×',
          of: (e, p) => p.distance / e.distance},
  angle: {text: 'angle between ways out', unit: '°',
          of: (e, p) => 180 / Math.PI * Math.acos(Math.max(-1, Math.min(
              1, e.direction.reduce((s, x, k) => s + x * p.direction[k], 0))))},
};
const kMapCells = 128;       // along the longer side
const kMapCellsInHand = 40;  // while the plane moves
class SectionMap {
  constructor(viewer) {
    this.viewer = viewer;
    this.key = '';   // of what is shown or on its way
    this.range = null;
    this.box = new THREE.Box3();
    for (const solid of viewer.stage.solids) {
      if (solid.entry.role !== 'contact') continue;
      this.box.union(new THREE.Box3().setFromBufferAttribute(
          solid.geometry.attributes.position));
    }
    this.mesh = new THREE.Mesh(
        new THREE.BufferGeometry(),
        new THREE.MeshBasicMaterial({side: THREE.DoubleSide, alphaTest: 0.5}));
    // What is not left out is opaque, for the page behind the canvas, too.
    this.mesh.material.onBeforeCompile = shader => {
      shader.fragmentShader = shader.fragmentShader.replace(
          '#include <premultiplied_alpha_fragment>', 'gl_FragColor.a = 1.0;');
    };
    this.mesh.visible = false;
    viewer.stage.scene.add(this.mesh);
  }

  // Shows what the state wants; what takes long comes later.
  show() {
    const {clip, map, probe} = this.viewer.state;
    const key = map && clip.on
        ? [map, clip.axis, clip.at, probe.smoothing].join() : '';
    if (key === this.key) return;
    this.key = key;
    clearTimeout(this.timer);
    if (!key) {
      this.mesh.visible = false;
      return;
    }
    this.make(key, kMapCellsInHand);
    this.timer = setTimeout(() => this.make(key, kMapCells), 200);
  }

  async make(key, cells) {
    const {viewer} = this, {probe} = viewer.probe;
    try {
      await probe.load();
      if (this.key !== key) return;
      probe.smooth(viewer.state.probe.smoothing);
      this.paint(cells);
    } catch (error) {
      viewer.state.map = '';
      return viewer.probe.fail(error);
    }
    this.mesh.visible = true;
    this.cells = cells;
    viewer.panel.show();
    viewer.changed();
  }

  paint(cells) {
    const {stage, state} = this.viewer, {min, max} = this.box;
    const c = 'xyz'.indexOf(state.clip.axis), a = (c + 1) % 3, b = (c + 2) % 3;
    const size = [0, 1, 2].map(
        k => max.getComponent(k) - min.getComponent(k));
    const cell = Math.max(size[a], size[b]) / cells;
    const columns = Math.max(2, Math.ceil(size[a] / cell));
    const rows = Math.max(2, Math.ceil(size[b] / cell));
    const level = stage.clipLevel(state.clip);
    const point = (u, v) => {
      const p = [0, 0, 0];
      p[a] = min.getComponent(a) + u * size[a];
      p[b] = min.getComponent(b) + v * size[b];
      p[c] = level;
      return p;
    };
    const samples = [];
    for (let j = 0; j < rows; ++j) {
      for (let i = 0; i < columns; ++i) {
        samples.push(this.sample(point((i + 0.5) / columns, (j + 0.5) / rows)));
      }
    }
    this.setTexture(samples, columns, rows, cell);
    const corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(
        corners.flatMap(([u, v]) => point(u, v)), 3));
    geometry.setAttribute(
        'uv', new THREE.Float32BufferAttribute(corners.flat(), 2));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    this.mesh.geometry.dispose();
    this.mesh.geometry = geometry;
  }

  // Of a point of the stage: the value, NaN outside, and its signed distance
  // from the contact space.
  sample(point) {
    const {data, stage, state, probe} = this.viewer;
    const q = point.map(
        (x, k) => x * data.scale + stage.center.getComponent(k));
    const [e, p] = probe.probe.coldAnswers(q);
    return {value: e.inside ? kMaps[state.map].of(e, p) : NaN,
            distance: e.distance / data.scale};
  }

  setTexture(samples, columns, rows, cell) {
    const values = samples.map(sample => sample.value);
    const map = kMaps[this.viewer.state.map];
    this.range = scaleOf(values, map, !map.isLength);
    const {low, high} = this.range;
    const pixels = new Uint8Array(4 * values.length);
    values.forEach((value, i) => {
      const share = high > low ? (value - low) / (high - low) : 0;
      // The plane ends where the distance is 0, between the points, too; what is
      // outside has the colour of the border.
      const alpha = 0.5 - samples[i].distance / cell / 2;
      pixels.set([...mapColor(Number.isFinite(value) ? share : 0),
                  Math.round(255 * Math.min(1, Math.max(0, alpha)))], 4 * i);
    });
    const texture = new THREE.DataTexture(pixels, columns, rows,
                                          THREE.RGBAFormat);
    texture.magFilter = texture.minFilter = THREE.LinearFilter;
    const {material} = this.mesh;
    if (material.map) material.map.dispose();
    material.map = texture;
    material.needsUpdate = true;
  }

  // Its controls, for the panel.
  rows() {
    const {viewer} = this, {state} = viewer;
    return colorRows('map', 'colour the cut by', kMaps,
                     kind => viewer.set(() => {
                       state.map = kind;
                       if (kind) state.clip.on = true;
                     }), 'Nothing penetrates at this plane.');
  }

  // Puts the state into them.
  tell() {
    const {state} = this.viewer;
    const isShown = !!state.map && state.clip.on;
    tellColors(this.viewer, 'map', state.map, isShown ? this.range : null,
               kMaps[state.map]);
  }
}
