// The page: state, drawing, and what it keeps in its link.

const kDuration = 8;  // seconds of a way at speed 1

class Viewer {
  // `context`: of the canvas, by WebGL.
  constructor(data, context) {
    this.data = data;
    this.state = this.defaults();
    this.stage = new DressedStage(data);
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
    this.panel = new Panel(this);
    this.isReady = true;
    this.apply();
    this.wake();
    window.addEventListener('resize', () => { this.frame(); this.changed(); });
    window.addEventListener('hashchange', () => {
      if (linkText() === this.hash()) return;
      this.readLink();
      this.apply();
      this.wake();
    });
    window.addEventListener('keydown', e => this.key(e));
    this.last = performance.now();
    const step = now => {
      this.advance(Math.min(0.1, (now - this.last) / 1000));
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
        : data.answers.length ? 0 : 0.6;
    return {
      time: t, playing: false, speed: 1, way: 0,
      clip: {on: false, axis: 'z', at: 0.5, flip: false},
      show: {obstacle: true, contact: true, mesh: true, robot: true,
             marks: true, stages: false},
      probe: {on: false, at: null, metric: 1,
              smoothing: data.probe ? data.probe.smoothing_length : 0},
      xray: false, bend: false, theme: isDark ? 'dark' : 'light', still: false,
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
    return String(isZero ? 0 : Number(value.toPrecision(3)));
  }

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
    for (const role of ['obstacle', 'contact', 'mesh', 'marks', 'stages']) {
      stage.groups[role].visible = state.show[role];
    }
    if (stage.isXray !== state.xray) stage.setXray(state.xray);
    if (!!stage.isBend !== state.bend) stage.setBend(state.bend);
    stage.setTheme(state.theme);
    stage.setClip(state.clip);
    this.dress(0);
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
    this.set(() => { this.state.way = way; });
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

  advance(seconds) {
    const {state} = this;
    if (!state.playing) return;
    state.time += seconds * state.speed / kDuration;
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

  // Are there panes, one for each metric of a motion?
  get isSplit() { return !!this.data.motion && !this.state.probe.on; }

  // A motion has one pane for each metric, side by side; all else has one.
  panes(width, height) {
    const motion = this.isSplit ? this.data.motion : null;
    const count = motion ? Math.max(1, motion.traces.length) : 1;
    const isNarrow = innerWidth <= 760, {still} = this.state;
    const isColumn = width < height;
    const hasPanel = !isNarrow && !document.body.classList.contains('open');
    // What the page lays over the canvas.
    const right = hasPanel && !still ? 288 : 0;
    const top = isNarrow ? 100 : count > 1 ? 120 : 60;
    const bottom = still ? 50 : motion ? (isNarrow ? 175 : 150)
        : isNarrow ? 120 : 80;
    const panes = [];
    for (let i = 0; i < count; ++i) {
      const pane = isColumn
          ? {x: 0, y: top + i * (height - top - bottom) / count, width,
             height: (height - top - bottom) / count}
          : {x: i * (width - right) / count, y: 0,
             width: (width - right) / count, height};
      if (count === 1) Object.assign(pane, {x: 0, y: 0, width, height});
      pane.inner = isColumn && count > 1
          ? {x: 10, y: 30, width: pane.width - 20, height: pane.height - 36}
          : {x: 10, y: top, height: pane.height - top - bottom,
             width: pane.width - 20 - (count === 1 ? right : 0)};
      pane.inner.width = Math.max(40, pane.inner.width);
      pane.inner.height = Math.max(40, pane.inner.height);
      panes.push(pane);
    }
    return panes;
  }

  draw() {
    this.isDirty = false;
    const {renderer, stage, state, camera} = this;
    const canvas = byId('canvas');
    const width = canvas.clientWidth, height = canvas.clientHeight;
    // Setting it makes a new buffer, also of the same size.
    const size = [width, height, window.devicePixelRatio || 1];
    if (String(size) !== this.size) {
      this.size = String(size);
      renderer.setPixelRatio(size[2]);
      renderer.setSize(width, height, false);
    }
    this.orbit.place(camera);
    stage.key.position.copy(camera.position).sub(this.orbit.target)
        .applyAxisAngle(new THREE.Vector3(0, 0, 1), 0.5);
    stage.key.position.z += 0.6 * this.orbit.distance;
    stage.key.target.position.copy(this.orbit.target);
    stage.key.target.updateMatrixWorld();
    const place = stage.pose(state.way, state.time);
    if (state.probe.on) this.probe.pose();
    const panes = this.panes(width, height);
    renderer.setScissorTest(false);
    // Opaque: as a part of another page what is behind a canvas may be black.
    renderer.setClearColor(state.theme === 'dark' ? 0x181d24 : 0xf2f4f6, 1);
    renderer.clear();
    renderer.setScissorTest(true);
    byId('labels').textContent = '';
    stage.ways.forEach((way, i) => {
      way.stages.visible = i === state.way;
    });
    panes.forEach((pane, i) => {
      const bottom = height - pane.y - pane.height;
      renderer.setViewport(pane.x, bottom, pane.width, pane.height);
      renderer.setScissor(pane.x, bottom, pane.width, pane.height);
      const {inner} = pane;
      this.orbit.height = inner.height;
      camera.aspect = inner.width / inner.height;
      camera.setViewOffset(inner.width, inner.height, -inner.x, -inner.y,
                           pane.width, pane.height);
      this.dress(i);
      renderer.render(stage.scene, camera);
      this.label(pane, i, panes.length);
    });
    this.scaleBar(panes[0].inner.height);
    if (!state.probe.on) this.tell(place);
    document.documentElement.dataset.ready = '1';
  }

  // The robot has the colour of what it follows.
  dress(pane) {
    const {stage, state} = this, isMotion = this.isSplit;
    const i = isMotion ? pane : state.probe.on ? state.probe.metric : state.way;
    stage.robot.visible = state.show.robot &&
        (!!this.data.robot || stage.ways.length > 0 || state.probe.on);
    stage.robotMaterial.color.copy(asColor(wayColor(state.theme, i)));
    // Of what cannot be cut, no cap.
    stage.groups.caps.visible = state.clip.on && !state.xray &&
        (state.show.obstacle || state.show.mesh);
    if (isMotion) {
      stage.arrows.forEach((arrow, k) => { arrow.group.visible = k === pane; });
    }
  }

  label(pane, index, count) {
    const {stage, state, camera} = this;
    const put = (text, left, top, color, kind) => {
      const label = make('div', {class: kind}, text);
      label.style.left = left + 'px';
      label.style.top = top + 'px';
      if (color) label.style.color = color;
      byId('labels').append(label);
    };
    if (this.isSplit) {
      const trace = this.data.motion.traces[index];
      if (index > 0 && pane.x > 0) put('', pane.x, 0, null, 'rule');
      if (trace) {
        put(trace.name, pane.x + pane.width / 2,
            pane.y + Math.max(4, pane.inner.y - 36),
            wayColor(state.theme, index), 'pane');
      }
    }
    if (!state.show.marks || index > 0) return;
    const taken = [];
    for (const {text, point, way} of stage.labels) {
      const p = point.clone().project(camera);
      if (p.z > 1 || Math.abs(p.x) > 1 || Math.abs(p.y) > 1) continue;
      const width = 8 * text.length, height = 18;
      const x = Math.min(pane.x + (p.x + 1) / 2 * pane.width,
                         innerWidth - width - 12);
      let y = pane.y + (1 - p.y) / 2 * pane.height;
      // Below what is there already.
      const isTaken = t => Math.abs(t.y - y) < height && t.x < x + width &&
          x < t.x + t.width;
      for (let i = 0; i < 8 && taken.some(isTaken); ++i) y += height;
      taken.push({x, y, width});
      put(text, x, y,
          way === undefined ? null : stage.colorOf(state.theme, way), 'name');
    }
  }

  scaleBar(height) {
    const perPixel = 2 * this.orbit.distance * Math.tan(kFieldOfView / 2) /
        height * this.data.scale;
    const wanted = perPixel * Math.min(140, innerWidth / 4);
    const ten = 10 ** Math.floor(Math.log10(wanted));
    const nice = [5, 2, 1].find(k => k * ten <= wanted) * ten;
    byId('scalebar').querySelector('i').style.width = nice / perPixel + 'px';
    byId('scalebar').querySelector('b').textContent = this.text(nice);
  }

  // What there is to know where the robot is.
  tell(place) {
    const {data, state, stage} = this, where = byId('where');
    const way = stage.ways[state.way];
    if (!place || !way) return;
    const point = '(' + place.raw.map(x => this.number(x)).join(', ') + ')';
    if (way.kind === 'path') {
      const length = way.lengths[way.lengths.length - 1] * data.scale;
      if (where) {
        where.textContent = this.number(state.time * length) + ' of ' +
            this.text(length) + ' · ' + point;
      }
    } else if (way.kind === 'motion') {
      if (where) {
        where.textContent = 'frame ' + place.frame + ' of ' +
            (way.points.length - 1) + ' · ' + point;
      }
      data.motion.traces.forEach((trace, i) => {
        const depth = Math.hypot(...trace.pd[place.frame]);
        const status = trace.status[place.frame];
        byId('trace-' + i).textContent = this.text(depth) +
            (status === 'ok' ? '' : ' · ' + status.replace(/_/g, ' '));
      });
    } else {
      const answer = data.answers[place.frame];
      const text = answer.status +
          (answer.depth > 0 ? ', depth ' + this.text(answer.depth)
           : answer.clearance > 0 ? ', ' + this.text(answer.clearance) +
               ' apart' : '');
      for (const small of document.querySelectorAll('button.way small')) {
        small.textContent = text;
      }
      if (where) {
        where.textContent = 'pose ' + (place.frame + 1) + ' of ' +
            way.points.length + ' · ' + text;
      }
    }
  }

  key(e) {
    if (e.ctrlKey || e.metaKey || e.altKey) return;
    if (e.target.tagName === 'SELECT' || e.target.type === 'number') return;
    if (this.probe && this.probe.key(e)) return;
    const {state, orbit} = this;
    const look = (yaw, pitch) => {
      orbit.yaw = yaw;
      orbit.pitch = pitch;
      this.changed();
    };
    const flip = key => this.set(() => {
      state.show[key] = !state.show[key];
    });
    const actions = {
      ' ': () => this.togglePlay(),
      ArrowLeft: () => this.step(-1), ArrowRight: () => this.step(1),
      '+': () => orbit.zoom(1 / 1.15), '=': () => orbit.zoom(1 / 1.15),
      '-': () => orbit.zoom(1.15),
      r: () => this.reset(), t: () => this.toggleTheme(),
      x: () => look(0, 0), y: () => look(-Math.PI / 2, 0),
      z: () => look(-Math.PI / 2, Math.PI / 2),
      c: () => this.set(() => { state.clip.on = !state.clip.on; }),
      o: () => this.set(() => { state.xray = !state.xray; }),
      p: () => { if (this.probe) this.probe.turn(!state.probe.on); },
      k: () => flip('contact'), g: () => flip('stages'),
      s: () => this.save(), l: () => this.link(),
      '?': () => this.panel.toggleHelp(),
      Escape: () => this.panel.toggleHelp(false),
    };
    if (/^[1-9]$/.test(e.key)) return this.follow(Number(e.key) - 1);
    const act = actions[e.key.length === 1 ? e.key.toLowerCase() : e.key];
    if (!act) return;
    e.preventDefault();
    act();
  }

  say(text) {
    const message = byId('message');
    message.textContent = text;
    message.hidden = false;
    clearTimeout(this.sayTimer);
    this.sayTimer = setTimeout(() => { message.hidden = true; }, 2500);
  }
}
