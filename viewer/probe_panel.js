// The probe's controls: taking hold of the robot, its keys, what it reads.

const kProbeSmoothing = [0, 0.05, 0.1, 0.2];
const kProbeHistory = 400;  // answers that are drawn

class ProbePanel {
  constructor(viewer) {
    this.viewer = viewer;
    this.probe = new Probe(viewer.data);
    this.history = [];  // depths by each metric, newest last
    viewer.orbit.grabs.push(e => this.grab(e));
  }

  get state() { return this.viewer.state.probe; }

  get colors() {
    return kProbeMetrics.map(
        (_, i) => nameColor(this.viewer.state.theme, kProbeMetrics, i));
  }

  section(panel) {
    const {viewer, state} = this;
    const box = make('input', {
      id: 'probe-on', type: 'checkbox',
      onchange: e => this.turn(e.target.checked),
    });
    const field = k => make('input', {
      id: 'probe-' + 'xyz'[k], type: 'number', step: 'any',
      'aria-label': 'xyz'[k] + ' of the robot',
      onchange: e => {
        const value = Number(e.target.value);
        if (e.target.value === '' || !Number.isFinite(value)) return;
        const to = state.at.slice();
        to[k] = value;
        this.move(to);
      },
    });
    const smoothing = make(
        'select', {id: 'probe-smoothing', onchange: e => {
          state.smoothing = Number(e.target.value);
          this.begin();
        }},
        ...kProbeSmoothing.map(s => make('option', {value: s}, String(s))));
    const rows = kProbeMetrics.map((name, i) => make(
        'button', {class: 'way', type: 'button', 'data-probe': i,
                   title: 'Show where it sends the robot',
                   onclick: () => viewer.set(() => { state.metric = i; })},
        make('i', {class: 'line', 'data-probe-color': i}),
        make('span', {}, name),
        make('small', {id: 'probe-answer-' + i}, '')));
    this.body = make(
        'div', {id: 'probe', hidden: ''},
        make('div', {class: 'point'}, field(0), field(1), field(2)),
        make('label', {class: 'row'},
             make('span', {}, 'smoothing ℓ / D'), smoothing),
        ...rows,
        make('canvas', {id: 'probe-chart',
                        'aria-label': 'Depth by each metric, as it was'}),
        make('p', {id: 'probe-gradient'}, ''),
        make('p', {class: 'soft'}, 'Drag the robot, or arrow keys, Page Up ' +
             'and Down; with shift finer. Computed in this page, by the ' +
             'library itself.'));
    // Below the picture where the panel hides it, on a phone.
    byId('reading').append(...kProbeMetrics.flatMap((name, i) => [
      make('i', {class: 'line', 'data-probe-color': i}),
      make('span', {}, name), make('b', {id: 'reading-' + i}, ''),
    ]));
    return panel.section(
        'Probe',
        make('label', {class: 'row'}, box,
             make('span', {}, 'drag the robot, read its depth (P)')),
        this.body);
  }

  // Where the robot is when the probe takes it over.
  here() {
    const {viewer} = this, {data, stage} = viewer;
    const way = stage.ways[viewer.state.way];
    const place = way && stage.placeOn(way, viewer.state.time);
    return [...(place ? place.raw : data.start || data.center)];
  }

  async turn(isOn) {
    const {viewer, state} = this;
    if (!isOn) return viewer.set(() => { state.on = false; });
    if (!state.at) state.at = this.here();
    try {
      await this.probe.load();
      this.begin();
    } catch (error) {
      this.fail(error);
    }
  }

  fail(error) {
    this.viewer.state.probe.on = false;
    this.viewer.apply();
    this.viewer.say('The live probe has stopped: ' + error.message);
  }

  // Cold, with the wanted smoothing length.
  begin() {
    const {viewer, state} = this;
    this.probe.smooth(state.smoothing);
    this.probe.forget();
    this.history = [];
    this.ask();
    viewer.set(() => {
      state.on = true;
      viewer.state.playing = false;
    });
    // There the panel covers what one wants to take hold of.
    if (isNarrow()) document.body.classList.remove('open');
  }

  ask() {
    this.answers = this.probe.answers(this.state.at);
    this.history.push(this.answers.map(a => Math.max(0, -a.distance)));
    if (this.history.length > kProbeHistory) this.history.shift();
  }

  move(to) {
    this.state.at = to;
    try {
      this.ask();
    } catch (error) {
      return this.fail(error);
    }
    this.tell();
    this.viewer.changed();
  }

  // By a way in the stage's lengths.
  moveBy(way) {
    const {scale} = this.viewer.data;
    const step = way.toArray();
    this.move(this.state.at.map((x, k) => x + scale * step[k]));
  }

  // If the pointer is on the robot: what follows it, in the plane across the
  // view.
  grab(e) {
    const {viewer, state} = this, {camera, stage} = viewer;
    if (!state.on || e.button !== 0 || e.shiftKey) return null;
    const ray = new THREE.Raycaster();
    const aim = event => {
      const box = byId('canvas').getBoundingClientRect();
      ray.setFromCamera(new THREE.Vector2(
          (event.clientX - box.left) / box.width * 2 - 1,
          1 - (event.clientY - box.top) / box.height * 2), camera);
      return ray.ray;
    };
    aim(e);
    const isHit = ray.intersectObjects(stage.robot.children
        .filter(part => part.isMesh)).length > 0;
    if (!isHit) return null;
    const across = new THREE.Plane().setFromNormalAndCoplanarPoint(
        camera.getWorldDirection(new THREE.Vector3()), stage.robot.position);
    const last = aim(e).intersectPlane(across, new THREE.Vector3());
    if (!last) return null;
    return event => {
      const now = aim(event).intersectPlane(across, new THREE.Vector3());
      if (!now) return;
      this.moveBy(now.clone().sub(last));
      last.copy(now);
    };
  }

  // Did the probe take the key?
  key(e) {
    if (!this.state.on) return false;
    const step = e.shiftKey ? 0.001 : 0.01;
    const axis = (x, y, z) => new THREE.Vector3(x, y, z)
        .applyQuaternion(this.viewer.camera.quaternion).multiplyScalar(step);
    const ways = {
      ArrowLeft: [-1, 0, 0], ArrowRight: [1, 0, 0], ArrowUp: [0, 1, 0],
      ArrowDown: [0, -1, 0], PageUp: [0, 0, -1], PageDown: [0, 0, 1],
    };
    const way = ways[e.key];
    if (!way) return false;
    e.preventDefault();
    this.moveBy(axis(...way));
    return true;
  }

  // Puts the robot and the arrows where the probe has them.
  pose() {
    const {stage} = this.viewer;
    const from = stage.at(this.state.at);
    stage.robot.position.copy(from);
    stage.robot.quaternion.set(0, 0, 0, 1);
    for (const arrow of stage.arrows) arrow.group.visible = false;
    this.answers.forEach((answer, i) => {
      const arrow = stage.probeArrows[i];
      const to = answer.inside ? stage.at(answer.contact) : from;
      // Each shows where they are one.
      stage.setArrow(arrow, from, to, [0.009, 0.006, 0.004][i]);
      arrow.group.visible = answer.inside;
      arrow.ends.forEach(end => { end.visible = false; });
      arrow.ghost.position.copy(to);
      arrow.ghost.visible = i === this.state.metric &&
          to.distanceTo(from) > 1e-6;
    });
  }

  // The readings.
  tell() {
    const {viewer, state} = this;
    this.body.hidden = !state.on;
    byId('probe-on').checked = state.on;
    if (!state.on) return;
    state.at.forEach((x, k) => {
      const field = byId('probe-' + 'xyz'[k]);
      if (document.activeElement !== field) {
        field.value = Number(x.toPrecision(4));
      }
    });
    byId('probe-smoothing').value = String(state.smoothing);
    this.answers.forEach((answer, i) => {
      const depth = Math.abs(answer.distance);
      const text = (answer.inside ? viewer.text(depth) + ' deep'
          : i === kProbeSliding ? 'outside'
          : viewer.text(depth) + ' apart') +
          (['ok', 'following', 'outside'].includes(answer.status)
           ? '' : ' · ' + answer.status);
      byId('probe-answer-' + i).textContent = text;
      byId('reading-' + i).textContent = text;
    });
    for (const row of document.querySelectorAll('[data-probe]')) {
      row.setAttribute('aria-pressed',
                       Number(row.dataset.probe) === state.metric);
    }
    for (const line of document.querySelectorAll('[data-probe-color]')) {
      line.style.color =
          this.colors[Number(line.dataset.probeColor)];
    }
    const shown = this.answers[state.metric];
    const vector = v => '(' + v.map(x => x.toFixed(3)).join(', ') + ')';
    byId('probe-gradient').textContent =
        'direction ' + vector(shown.direction) +
        (state.metric === kProbeSliding ? '; it has no gradient'
         : ', gradient ' + vector(shown.gradient));
    this.chart();
  }

  chart() {
    const {viewer, history} = this, canvas = byId('probe-chart');
    canvas.hidden = history.length < 2;
    if (canvas.hidden) return;
    const series = kProbeMetrics.map((name, i) => history.map(h => h[i]));
    const most = largest(series) || 1;
    const step = canvas.clientWidth / kProbeHistory;
    drawSeries(canvas, this.colors, series, f => f * step,
               y => canvas.clientHeight - 4 -
                   y / most * (canvas.clientHeight - 8));
  }
}
