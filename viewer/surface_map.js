// The contact surface coloured by what the metrics say of a robot that is pushed
// in there, by a given share of D against the facet, and asked cold; and by how
// far the Phong field leans away from the facet.

const kSurfaceMaps = {
  ...kMaps,
  lean: {text: 'angle of the Phong field to the facet', unit: '°',
         isAtSurface: true,
         of: (e, p, normal) => 180 / Math.PI * Math.acos(Math.min(
             1, normal.reduce((s, x, k) => s + x * p.direction[k], 0)))},
};
// What the shape alone tells, without asking any metric (dress.js).
const kBend = 'bend';
const kSurfaceDepths = [0.02, 0.05, 0.1, 0.2];  // shares of D
const kSurfaceSamples = 16000;  // more where the surface has more facets
const kSurfaceSlice = 40;       // milliseconds of a frame
// Off the edges, where facets meet; share of a facet.
const kSurfaceInset = 0.04;
const kThinner = [0.62, 0.62, 0.62];  // where the robot would be out again

// What the contact space is coloured by, one thing at a time: for the panel, of
// pages without a probe as well.
function surfaceColorRows(viewer) {
  const bend = {[kBend]: {text: 'curvature'}};
  return [
    ...colorRows('surface', 'colour the contact space by',
                 viewer.surface ? {...kSurfaceMaps, ...bend} : bend,
                 kind => viewer.set(() => { viewer.state.surface = kind; }),
                 'Nothing is that thick.'),
    make('div', {id: 'bend-key', class: 'key', hidden: ''},
         make('span', {}, 'valley'), make('i'), make('span', {}, 'ridge'))];
}

class SurfaceMap {
  constructor(viewer) {
    this.viewer = viewer;
    this.key = '';
    this.range = null;
    const material = new THREE.MeshPhongMaterial({
      side: THREE.DoubleSide, vertexColors: THREE.VertexColors, shininess: 0,
      specular: 0, clippingPlanes: [viewer.stage.plane],
    });
    // The colours of the scale, with a little light and shade.
    material.onBeforeCompile = shader => {
      shader.fragmentShader = shader.fragmentShader.replace(
          '#include <premultiplied_alpha_fragment>',
          'gl_FragColor.rgb = mix(vColor, gl_FragColor.rgb, 0.25);');
    };
    this.mesh = new THREE.Mesh(new THREE.BufferGeometry(), material);
    this.mesh.visible = false;
    viewer.stage.groups.contact.add(this.mesh);
  }

  // By what a metric says.
  get isOn() { return this.viewer.state.surface in kSurfaceMaps; }

  // Shows what the state wants, as far as it is known; the rest comes frame by
  // frame (advance).
  show() {
    const {surface: kind, probe} = this.viewer.state;
    const surface = this.isOn ? kind : '';
    const key = surface
        ? [surface, this.viewer.state.below, probe.smoothing].join() : '';
    for (const solid of this.viewer.stage.solids) {
      if (solid.entry.role !== 'contact') continue;
      solid.faces.forEach(faces => { faces.visible = !surface; });
    }
    this.mesh.visible = !!surface;
    if (key === this.key) return;
    this.key = key;
    this.left = null;
    this.range = null;
    if (surface) this.begin(key);
  }

  async begin(key) {
    const {viewer} = this, {probe} = viewer.probe;
    try {
      await probe.load();
    } catch (error) {
      viewer.state.surface = '';
      return viewer.probe.fail(error);
    }
    if (this.key !== key) return;
    if (!this.samples) this.split();
    this.values = new Float64Array(this.samples.length).fill(NaN);
    this.left = 0;
    this.painted = 200;
    this.paint();
  }

  // The facets in small triangles between samples.
  split() {
    const facets = [];
    this.viewer.data.probe.spaces.forEach(({positions, indices}, space) => {
      const p = new Float64Array(bytesOf(positions));
      const t = new Uint32Array(bytesOf(indices));
      for (let f = 0; f < t.length; f += 3) {
        const corners = [0, 1, 2].map(
            k => [...p.subarray(3 * t[f + k], 3 * t[f + k] + 3)]);
        const [a, b, c] = corners.map(x => new THREE.Vector3(...x));
        const cross = b.clone().sub(a).cross(c.clone().sub(a));
        if (!(cross.length() > 0)) continue;
        facets.push({
          space, corners, normal: cross.normalize().toArray(),
          size: Math.max(a.distanceTo(b), b.distanceTo(c), c.distanceTo(a)),
        });
      }
    });
    const parts = (facet, cell) => Math.max(1, Math.ceil(facet.size / cell));
    const count = cell => facets.reduce((sum, facet) => {
      const n = parts(facet, cell);
      return sum + (n + 1) * (n + 2) / 2;
    }, 0);
    let cell = this.viewer.data.scale / 100;
    while (count(cell) > kSurfaceSamples && cell < this.viewer.data.scale) {
      cell *= 1.25;
    }
    this.samples = [];
    this.triangles = [];  // by numbers of samples
    for (const facet of facets) this.splitFacet(facet, parts(facet, cell));
    // Anywhere soon: what is shown first is coarse everywhere.
    this.order = this.samples.map((_, i) => i);
    let seed = 1;
    for (let i = this.order.length - 1; i > 0; --i) {
      seed = (1103515245 * seed + 12345) % 2147483648;
      const j = seed % (i + 1);
      [this.order[i], this.order[j]] = [this.order[j], this.order[i]];
    }
  }

  splitFacet({space, corners: [a, b, c], normal}, n) {
    const first = this.samples.length;
    const number = (i, j) => first + i * (n + 1) - i * (i - 1) / 2 + j;
    const mix = (u, v) => a.map(
        (x, k) => x + u * (b[k] - x) + v * (c[k] - x));
    for (let i = 0; i <= n; ++i) {
      for (let j = 0; i + j <= n; ++j) {
        const s = 1 - kSurfaceInset, third = kSurfaceInset / 3;
        this.samples.push({space, normal, at: mix(i / n, j / n),
                           asked: mix(s * i / n + third, s * j / n + third)});
        if (i + j === n) continue;
        this.triangles.push(number(i, j), number(i + 1, j), number(i, j + 1));
        if (i + j + 1 === n) continue;
        this.triangles.push(number(i + 1, j), number(i + 1, j + 1),
                            number(i, j + 1));
      }
    }
  }

  // The value below a sample; infinite: it is outside.
  ask({space, asked, normal}) {
    const {state, data, probe: {probe}} = this.viewer;
    const map = kSurfaceMaps[state.surface];
    const step = data.probe.length * (map.isAtSurface ? 1e-6 : state.below);
    const q = asked.map((x, k) => x - step * normal[k]);
    const [e, p] = probe.coldAnswersOf(space, q);
    return e.inside ? map.of(e, p, normal) : Infinity;
  }

  // Some milliseconds of work, if there is any.
  advance() {
    if (this.left === null || !this.isOn) return;
    const {viewer} = this, {probe} = viewer.probe;
    const end = performance.now() + kSurfaceSlice;
    try {
      probe.smooth(viewer.state.probe.smoothing);
      while (this.left < this.order.length && performance.now() < end) {
        const i = this.order[this.left++];
        this.values[i] = this.ask(this.samples[i]);
      }
    } catch (error) {
      viewer.state.surface = '';
      this.left = null;
      return viewer.probe.fail(error);
    }
    const isDone = this.left === this.order.length;
    // A picture may take longer than its answers: few are drawn on the way.
    if (!isDone && this.left < 3 * this.painted) return;
    this.painted = this.left;
    if (isDone) this.left = null;
    this.paint();
  }

  paint() {
    this.range = scaleOf(
        this.values, kSurfaceMaps[this.viewer.state.surface], true);
    const {low, high} = this.range;
    const colors = Array.from(this.values, value => Number.isFinite(value)
        ? mapColor(high > low ? (value - low) / (high - low) : 0)
            .map(x => x / 255) : kThinner);
    const {geometry} = this.mesh, flat = this.triangles;
    if (!geometry.attributes.position) {
      const corners = flat.flatMap(
          i => this.viewer.stage.at(this.samples[i].at).toArray());
      geometry.setAttribute('position',
                            new THREE.Float32BufferAttribute(corners, 3));
      geometry.setAttribute('normal', new THREE.Float32BufferAttribute(
          flat.flatMap(i => this.samples[i].normal), 3));
    }
    geometry.setAttribute('color', new THREE.Float32BufferAttribute(
        flat.flatMap(i => colors[i]), 3));
    this.viewer.panel.show();
    this.viewer.changed();
  }

  // How it is asked, for the panel.
  rows() {
    const {viewer} = this, {state} = viewer;
    const below = make(
        'select', {id: 'below', 'aria-label': 'How far below the surface',
                   onchange: e => viewer.set(
                       () => { state.below = Number(e.target.value); })},
        ...kSurfaceDepths.map(d => make('option', {value: d}, d + ' D')));
    return [make('label', {id: 'surface-below', class: 'row'},
                 make('span', {}, 'asked below it, by'), below),
            make('p', {id: 'surface-left', class: 'soft'})];
  }

  tell() {
    const {state} = this.viewer, map = kSurfaceMaps[state.surface];
    tellColors(this.viewer, 'surface', state.surface,
               this.isOn ? this.range : null, map);
    byId('surface-below').hidden = !this.isOn || !!map.isAtSurface;
    byId('below').value = state.below;
    byId('surface-left').textContent = !this.isOn ? ''
        : this.left !== null ? 'asking …'
        : this.values && this.values.includes(Infinity)
        ? 'Grey: thinner than that.' : '';
  }
}
