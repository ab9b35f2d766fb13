// The page: state, drawing, and what it keeps in its link.

const kDuration = 8;  // seconds at speed 1 of a way without time

class Viewer {
  // `context`: of the canvas, by WebGL.
  constructor(data, context) {
    this.data = data;
    this.stage = new DressedStage(data);
    this.state = this.defaults();
    this.camera = new THREE.PerspectiveCamera(
        kFieldOfView * 180 / Math.PI, 1, 0.01, 10);
    this.renderer = new THREE.WebGLRenderer(
        {canvas: byId('canvas'), context, antialias: true, alpha: true});
    this.renderer.localClippingEnabled = true;
    this.renderer.autoClear = false;
    this.isReady = false;
    this.orbit = new Orbit(byId('canvas'), () => this.changed());
    this.frame();
    this.state.way = Math.max(
        0, this.stage.ways.findIndex(way => way.points.length > 0));
    this.orbit.place(this.camera);
    // Of penetration one sees nothing but from within.
    this.isHidden = !!data.motion || data.answers.some(a => a.depth > 0) ||
        this.stage.isHidden(this.camera);
    this.state.xray = this.isHidden;
    this.readLink();
    if (this.state.still) this.frame();
    this.probe = this.data.probe ? new ProbePanel(this) : null;
    this.task = this.data.task ? new TaskPanel(this) : null;
    this.map = this.probe ? new SectionMap(this) : null;
    this.surface = this.probe ? new SurfaceMap(this) : null;
    this.panel = new Panel(this);
    this.isReady = true;
    this.frame();  // beside what the page lays over the picture
    this.apply();
    this.wake();
    window.addEventListener('resize', () => { this.frame(); this.changed(); });
    window.addEventListener('hashchange', () => {
      if (linkText() === this.hash()) return;
      this.readLink();
      this.apply();
      this.wake();
    });
    window.addEventListener('keydown', e => actOnKey(this, e));
    sleepInPages(this);
    this.last = performance.now();
    const step = now => {
      // In real time, on slow machines too; not through what was out of sight.
      this.advance(Math.min(0.5, (now - this.last) / 1000));
      this.last = now;
      if (this.isDirty) this.draw();
      requestAnimationFrame(step);
    };
    this.draw();
    document.documentElement.dataset.firstPicture =
        Math.round(performance.now());
    requestAnimationFrame(step);
  }

  defaults() {
    const isDark = matchMedia('(prefers-color-scheme: dark)').matches;
    const {data} = this;
    const t = data.motion ? this.turningPoint()
        : data.answers.length || data.paths.some(path => path.pace) ? 0 : 0.6;
    return {
      time: t, playing: false, speed: 1, way: 0,
      // Of the way's iterations; null: its answer.
      iterate: null, running: 0,
      clip: {on: false, axis: 'z', at: 0.5, flip: false},
      show: {obstacle: true, contact: true, mesh: true, robot: true,
             marks: true, movers: true, stages: false, graphs: true, planes: false,
             windows: true, regions: false,
             bounds: this.stage.areBoundsNear},
      probe: {on: false, at: null, metric: 1,
              smoothing: data.probe ? data.probe.smoothing_length : 0},
      chart: 'angle', xray: false, map: '', surface: '', below: 0.05,
      theme: isDark ? 'dark' : 'light', still: false,
    };
  }

  // Of a motion: where some metric changes most from frame to frame.
  turningPoint() {
    const {traces, positions} = this.data.motion;
    let best = 0, most = 0;
    for (const {pd} of traces) {
      for (let f = 1; f < pd.length; ++f) {
        const change = Math.hypot(...pd[f].map((x, k) => x - pd[f - 1][k]));
        if (change > most) [most, best] = [change, f];
      }
    }
    return best / Math.max(1, positions.length - 1);
  }

  // Puts all of the scene into the picture.
  frame() {
    const width = innerWidth, height = innerHeight;
    const {inner} = this.panes(width, height)[0];
    const {home} = this.orbit;
    home.target = this.stage.focus.getCenter(new THREE.Vector3()).toArray();
    const isFirst = this.orbit.distance === home.distance;
    home.distance =
        this.orbit.fit(this.stage.corners, inner.width / inner.height);
    if (!this.isReady) {
      this.orbit.reset();
    } else if (isFirst) {
      this.orbit.distance = home.distance;
    }
  }

  text(length) {
    const number = this.number(length), {unit} = this.data;
    return number + ' ' + (number === '1' && unit === 'units' ? 'unit' : unit);
  }

  // Three digits; what is rounding beside the scene's size is zero.
  number(value) {
    const isZero = Math.abs(value) < 1e-6 * this.data.scale;
    return isZero ? '0' : this.digits(value);
  }

  // Three of them.
  digits(value) { return String(Number(value.toPrecision(3))); }

  changed() {
    this.isDirty = true;
    if (!this.isReady) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.keepLink(), 250);
  }

  // Begins what the link asks for and takes its time.
  wake() {
    const {probe} = this.state;
    if (!probe.wanted) return;
    probe.wanted = false;
    this.probe.turn(true);
  }

  set(change) {
    change();
    this.apply();
  }

  apply() {
    const {state, stage} = this;
    document.documentElement.dataset.theme = state.theme;
    document.body.classList.toggle('still', state.still);
    document.body.classList.toggle('motion', this.isSplit);
    document.body.classList.toggle('probing', state.probe.on);
    byId('reading').hidden = !state.probe.on;
    for (const role of ['obstacle', 'contact', 'mesh', 'marks', 'stages']) {
      stage.groups[role].visible = state.show[role];
    }
    if (stage.isXray !== state.xray) stage.setXray(state.xray);
    const isBend = state.surface === kBend;
    if (!!stage.isBend !== isBend) stage.setBend(isBend);
    stage.setTheme(state.theme);
    stage.setClip(state.clip);
    this.dress(0);
    if (this.map) this.map.show();
    if (this.surface) this.surface.show();
    this.panel.show();
    this.changed();
  }

  reset() {
    Object.assign(this.state, this.defaults(),
                  {theme: this.state.theme, way: this.state.way,
                   xray: this.isHidden});
    this.orbit.reset();
    this.apply();
  }

  follow(way) {
    const found = this.stage.ways[way];
    if (!found || found.points.length === 0) return;
    this.set(() => {
      Object.assign(this.state, {way, iterate: null, running: 0});
    });
  }

  togglePlay() {
    if (!byId('play')) return;
    const {state} = this;
    if (!state.playing && state.time >= 1) state.time = 0;
    this.set(() => { state.playing = !state.playing; });
  }

  toggleTheme() {
    this.set(() => {
      this.state.theme = this.state.theme === 'dark' ? 'light' : 'dark';
    });
  }

  // What the way that is followed asks of the machine; null: it has no time.
  get pace() {
    const way = this.stage.ways[this.state.way];
    return (way && way.pace) || null;
  }

  // The iterations of the way that is followed, one more for its answer; 0:
  // there are none.
  get iterations() {
    const {iterates} = this.stage.ways[this.state.way] || {};
    return iterates ? iterates.kept.length + 1 : 0;
  }

  // To an iteration by its number among those kept; beyond the last: the
  // answer.
  iterateTo(index) {
    const last = this.iterations - 1;
    if (last < 0) return;
    const at = Math.min(last, Math.max(0, Math.floor(index)));
    this.set(() => { this.state.iterate = at === last ? null : at; });
  }

  stepIterate(direction) {
    const {iterate} = this.state;
    this.state.running = 0;
    this.iterateTo((iterate === null ? this.iterations - 1 : iterate) +
                   direction);
  }

  // From the first iteration where the answer is shown, or on.
  toggleIterations() {
    const {state} = this;
    if (state.running) return this.set(() => { state.running = 0; });
    state.running = 1 + (state.iterate || 0);
    this.iterateTo(state.running - 1);
  }

  advanceIterations(seconds) {
    const {state} = this;
    state.running += seconds * state.speed * kIteratesPerSecond;
    if (state.running - 1 >= this.iterations - 1) state.running = 0;
    this.iterateTo(state.running ? state.running - 1 : this.iterations - 1);
  }

  advance(seconds) {
    const {state} = this;
    if (state.running) this.advanceIterations(seconds);
    if (this.surface) this.surface.advance();
    if (!state.playing) return;
    const pace = this.pace;
    state.time += seconds * state.speed / (pace ? pace.duration : kDuration);
    if (state.time >= 1) {
      state.time = 1;
      state.playing = false;
    }
    this.panel.show();
    this.changed();
  }

  step(direction) {
    const way = this.stage.ways[this.state.way];
    if (!way) return;
    const count = way.kind === 'path' ? 100 : way.points.length - 1;
    this.state.playing = false;
    this.set(() => {
      this.state.time = Math.min(1, Math.max(
          0, this.state.time + direction / Math.max(1, count)));
    });
  }

  say(text) {
    const message = byId('message');
    message.textContent = text;
    message.hidden = false;
    clearTimeout(this.sayTimer);
    this.sayTimer = setTimeout(() => { message.hidden = true; }, 2500);
  }
}
