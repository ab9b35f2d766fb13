// Legend, switches, player and help.

// Of meshes that are not all of a contact space (view.h).
const kPartNames = ['facets of free space\'s model',
    'contact space that was explored'];

class Panel {
  constructor(viewer) {
    this.viewer = viewer;
    const {data, stage} = viewer;
    byId('title').textContent = data.title;
    byId('facts').textContent = this.facts();
    this.makeTools();
    byId('panel').append(
        this.waysSection = make('div', {}, this.ways()), this.legend(),
        viewer.task ? viewer.task.section(this) : '',
        viewer.probe ? viewer.probe.section(this) : '', this.display(),
        this.notes());
    document.body.classList.toggle('wayless', stage.ways.length === 0);
    if (stage.ways.some(way => way.points.length > 1)) this.makePlayer();
    this.makeHelp();
  }

  facts() {
    const {data, stage} = this.viewer, facts = [];
    const count = (n, what) => n.toLocaleString('en') + ' ' + what +
        (n === 1 ? '' : 's');
    const triangles = data.meshes.reduce((n, m) => n + m.triangles, 0) +
        [data.robot, ...data.paths.map(path => path.robot),
         ...data.movers.map(mover => mover.body)].reduce(
             (n, body) => n + (body ? body.triangles : 0), 0);
    if (triangles) facts.push(count(triangles, 'triangle'));
    // Robots that have none yet stand where they begin.
    const paths = stage.ways.filter(
        way => way.kind === 'path' && way.points.length > (way.body ? 1 : 0));
    if (paths.length) facts.push(count(paths.length, 'path'));
    else if (data.paths.length && !data.paths[0].robot) {
      facts.push(data.paths[0].name.split(' · ').pop());
    }
    if (data.motion) facts.push(count(data.motion.positions.length, 'frame'));
    if (data.answers.length === 1) {
      facts.push(this.viewer.answerText(data.answers[0]));
    } else if (data.answers.length) {
      facts.push(count(data.answers.length, 'answer'));
    }
    return facts.join(' · ');
  }

  makeTools() {
    const viewer = this.viewer;
    const tool = (id, text, title, act) => make(
        'button', {id, title, type: 'button', onclick: act}, text);
    byId('tools').append(
        tool('menu', '☰', 'Legend and display', () => this.togglePanel()),
        tool('reset', '⟲', 'Reset the view (R)', () => viewer.reset()),
        tool('theme', '◐', 'Light or dark (T)', () => viewer.toggleTheme()),
        tool('link', linkIcon(), 'Copy a link to this view (L)',
             () => viewer.link()),
        tool('save', '⤓', 'Save as PNG (S)', () => viewer.save()),
        tool('ask', '?', 'Keyboard and mouse (?)', () => this.toggleHelp()));
  }

  togglePanel() {
    document.body.classList.toggle('open');
    this.viewer.frame();
    this.viewer.changed();
  }

  section(title, ...rows) {
    return make('section', {}, make('h2', {}, title), ...rows);
  }

  check(id, text, isOn, act, color) {
    const box = make('input', {id, type: 'checkbox',
                               onchange: e => act(e.target.checked)});
    box.checked = isOn;
    const swatch = color ? make('i', {class: 'swatch', 'data-color': color})
                         : '';
    return make('label', {class: 'row'}, box, swatch, make('span', {}, text));
  }

  legend() {
    const {viewer} = this, {data, state, stage: {overlays}} = viewer;
    const rows = [];
    const of = role => data.meshes.filter(m => m.role === role);
    const named = (list, many) => list.length === 1
        ? list[0].name : list.length + ' ' + many;
    const row = (key, text, color) => rows.push(this.check(
        'show-' + key, text, state.show[key], isOn => {
          state.show[key] = isOn;
          viewer.apply();
        }, color));
    if (of('obstacle').length) {
      row('obstacle', of('obstacle').length === 1
          ? 'obstacle' : named(of('obstacle'), 'obstacles'), 'obstacle');
      if (of('obstacle').length > 1) {
        rows.push(...of('obstacle').slice(0, 8).map(
            entry => make('p', {class: 'row part'}, entry.name)));
      }
    }
    if (of('contact').length) {
      const names = new Set(of('contact').map(m => m.name));
      row('contact', kPartNames.find(name => names.has(name))
          || 'contact space', 'contact');
    }
    if (of('mesh').length === 1) row('mesh', of('mesh')[0].name, 'mesh');
    if (of('mesh').length > 1) {
      row('mesh', of('mesh').length + ' meshes');
      for (const entry of of('mesh').slice(0, 8)) {
        rows.push(make('p', {class: 'row part'}, make('i', {
          class: 'swatch', 'data-color': this.viewer.stage.colorName(entry),
        }), make('span', {}, entry.name)));
      }
    }
    const {crew} = this.viewer.stage;
    if (crew.isTeam) row('robot', 'robots');
    else if (data.robot) row('robot', 'robot', 'robot');
    if (crew.movers.length) {
      row('movers', crew.movers.length === 1 ? crew.movers[0].way.name
          : crew.movers.length + ' moving obstacles', 'mover');
    }
    if (data.robot && data.answers.some(a => a.depth > 0)) {
      rows.push(make('p', {class: 'row part'},
                     make('i', {class: 'swatch pale', 'data-way-swatch': 1}),
                     make('span', {}, 'robot, where it is pushed out to')));
    }
    if (crew.isTeam) row('marks', 'goals and names');
    else if (data.start || data.goal) row('marks', 'start and goal', 'mark');
    if (this.viewer.stage.ways.some(w => w.stages.children.length)) {
      row('stages', 'robot at stages', 'ghost');
    }
    for (const [key, {color}] of Object.entries(kOverlays)) {
      if (overlays.has(key)) row(key, overlays.text(key), color);
    }
    if (rows.length === 0) {
      rows.push(make('p', {class: 'empty'},
                     'There are no meshes in this view.'));
    }
    return this.section('Shown', ...rows);
  }

  ways() {
    const {data, stage} = this.viewer;
    const rows = [];
    stage.ways.forEach((way, i) => {
      if (way.kind === 'motion') return;
      const isEmpty = way.points.length === 0;
      const length = isEmpty ? 0 : lengthsOf(way.points).pop();
      const more = isEmpty ? 'no path'
          : way.kind === 'answers' || way.points.length < 2 ? ''
          : (way.free ? '' : 'collides · ') +
              this.viewer.text(length * data.scale);
      rows.push(make('button', {
        class: 'way', type: 'button', 'data-way': i, disabled: isEmpty,
        title: isEmpty ? 'This run has no path' : 'Follow it (' + (i + 1) + ')',
        onclick: () => this.viewer.follow(i),
      }, make('i', {class: 'line' + (way.free ? '' : ' dashed'),
                    'data-way-color': i}),
      make('span', {}, way.name), make('small', {}, more)));
    });
    if (data.motion) {
      data.motion.traces.forEach((trace, i) => rows.push(make(
          'p', {class: 'way'}, make('i', {class: 'line', 'data-trace': i}),
          make('span', {}, trace.name),
          make('small', {id: 'trace-' + i}, ''))));
    }
    if (!rows.length) return '';
    const title = data.motion ? 'Penetration depth'
        : data.answers.length ? 'Answers'
        : stage.crew.isTeam ? 'Robots' : 'Paths';
    const section = this.section(title, ...rows);
    section.className = data.motion ? 'ways traces' : 'ways';
    return section;
  }

  display() {
    const viewer = this.viewer, {state, data} = viewer;
    const clip = make('input', {
      id: 'clip-at', type: 'range', min: 0, max: 1000, 'aria-label': 'Plane at',
      oninput: e => viewer.set(() => {
        state.clip.at = e.target.value / 1000;
        state.clip.on = true;
      }),
    });
    const axis = make(
        'select', {id: 'clip-axis', 'aria-label': 'Axis of the plane',
                   onchange: e => viewer.set(() => {
                     state.clip.axis = e.target.value;
                     state.clip.on = true;
                   })},
        ...['x', 'y', 'z'].map(k => make('option', {value: k}, k)));
    const flip = make('button', {id: 'clip-flip', type: 'button',
                                 title: 'Show the other side',
                                 onclick: () => viewer.set(() => {
                                   state.clip.flip = !state.clip.flip;
                                   state.clip.on = true;
                                 })}, '⇄');
    const rows = [];
    if (data.meshes.length) {
      rows.push(make('div', {class: 'clip'},
                     this.check('clip-on', 'cut', state.clip.on,
                                isOn => viewer.set(
                                    () => { state.clip.on = isOn; })),
                     axis, clip, flip));
    }
    if (data.meshes.some(m => m.role !== 'contact')) {
      rows.push(this.check('xray', 'see through solids', state.xray,
                           isOn => viewer.set(() => { state.xray = isOn; })));
    }
    if (viewer.surface || data.meshes.some(m => m.role === 'contact')) {
      rows.push(...surfaceColorRows(viewer));
    }
    if (viewer.map) {
      rows.push(...viewer.surface.rows(), ...viewer.map.rows());
    }
    return rows.length ? this.section('Display', ...rows) : '';
  }

  notes() {
    const {notes} = this.viewer.data;
    return notes.length
        ? this.section('Notes', ...notes.map(n => make('p', {}, n))) : '';
  }

  makePlayer() {
    const viewer = this.viewer;
    const {state, data} = viewer;
    const scrub = make('input', {
      id: 'scrub', type: 'range', min: 0, max: 10000, 'aria-label': 'Time',
      oninput: e => {
        state.playing = false;
        viewer.set(() => { state.time = e.target.value / 10000; });
      },
    });
    const speed = make(
        'select', {id: 'speed', 'aria-label': 'Speed',
                   onchange: e => { state.speed = Number(e.target.value); }},
        ...[0.1, 0.25, 0.5, 1, 2, 4].map(
            s => make('option', {value: s}, s + '×')));
    speed.value = state.speed;
    byId('player').append(make(
        'div', {class: 'bar'},
        make('button', {id: 'play', type: 'button', title: 'Play (space)',
                        onclick: () => viewer.togglePlay()}, '▶'),
        scrub, speed, make('output', {id: 'where'})));
    if (data.iterates.length) byId('player').append(this.iterationRow());
    this.makeChart();
  }

  // Over the slider, where there is something to draw over time.
  makeChart() {
    const {data, state} = this.viewer, viewer = this.viewer;
    const hasPace = data.paths.some(path => path.pace);
    const hasTraces = data.motion && data.motion.traces.length;
    if (byId('chart') || !byId('play') || !(hasPace || hasTraces)) return;
    byId('player').prepend(make('canvas', {
      id: 'chart', 'aria-label': hasPace
          ? 'Velocity, acceleration and jerk over time, shares of the limits'
          : 'PD over the frames',
      onpointerdown: e => this.scrubChart(e),
      onpointermove: e => { if (e.buttons) this.scrubChart(e); },
    }));
    if (!hasTraces) return;
    byId('player').prepend(make(
        'div', {class: 'bar kind'},
        make('select', {id: 'chart-kind', 'aria-label': 'What the chart draws',
                        onchange: e => viewer.set(
                            () => { state.chart = e.target.value; })},
             ...Object.entries(kChartKinds).map(
                 ([value, kind]) => make('option', {value}, kind.text))),
        make('output', {id: 'chart-most'})));
  }

  // After the ways have changed.
  renewWays() {
    this.waysSection.replaceChildren(this.ways());
    byId('facts').textContent = this.facts();
    const {ways} = this.viewer.stage;
    document.body.classList.toggle('wayless', ways.length === 0);
    if (!ways.some(way => way.points.length > 1)) return;
    if (!byId('play')) this.makePlayer();
    this.makeChart();
  }

  // Beside time: iterations, where the page holds them.
  iterationRow() {
    const viewer = this.viewer;
    return make(
        'div', {id: 'iterations', class: 'bar'},
        make('button', {id: 'play-iterate', type: 'button',
                        title: 'Play the iterations',
                        onclick: () => viewer.toggleIterations()}, '▶'),
        make('label', {for: 'scrub-iterate'}, 'iteration'),
        make('input', {id: 'scrub-iterate', type: 'range', min: 0,
                       oninput: e => {
                         viewer.state.running = 0;
                         viewer.iterateTo(Number(e.target.value));
                       }}),
        make('output', {id: 'which-iterate'}));
  }

  showIterations() {
    const {viewer} = this, {state, stage} = viewer;
    const row = byId('iterations');
    if (!row) return;
    const count = viewer.iterations;
    row.hidden = count === 0;
    if (row.hidden) return;
    byId('scrub-iterate').max = count - 1;
    byId('scrub-iterate').value =
        state.iterate === null ? count - 1 : state.iterate;
    byId('play-iterate').textContent = state.running ? '❚❚' : '▶';
    byId('which-iterate').textContent = stage.iterates.text(viewer);
  }

  scrubChart(e) {
    const box = e.target.getBoundingClientRect();
    const share = (e.clientX - box.left - kChartLeft) /
        (box.width - kChartLeft - kChartRight);
    this.viewer.state.playing = false;
    this.viewer.set(() => {
      this.viewer.state.time = Math.min(1, Math.max(0, share));
    });
  }

  makeHelp() {
    byId('help').append(
        make('h2', {}, 'Keyboard and mouse'),
        make('dl', {}, ...kKeys.flatMap(
            ([key, what]) => [make('dt', {}, key), make('dd', {}, what)])),
        make('button', {type: 'button', onclick: () => this.toggleHelp()},
             'Close'));
  }

  toggleHelp(isShown = byId('help').hidden) {
    byId('help').hidden = !isShown;
  }

  // Puts the state into the controls.
  show() {
    const {state, stage, data} = this.viewer;
    const check = (id, isOn) => { if (byId(id)) byId(id).checked = isOn; };
    for (const key of Object.keys(state.show)) {
      check('show-' + key, state.show[key]);
    }
    check('clip-on', state.clip.on);
    check('xray', state.xray);
    if (byId('surface')) {
      byId('surface').value = state.surface;
      byId('bend-key').hidden = state.surface !== kBend;
    }
    if (byId('clip-at')) {
      byId('clip-at').value = 1000 * state.clip.at;
      byId('clip-axis').value = state.clip.axis;
    }
    const theme = kThemes[state.theme];
    const css = color => '#' + color.toString(16).padStart(6, '0');
    for (const i of document.querySelectorAll('[data-color]')) {
      const name = i.dataset.color;
      i.style.background = name === 'robot'
          ? '#' + stage.robotMaterial.color.getHexString() : css(theme[name]);
      i.style.opacity = name === 'contact' ? 0.55 : 1;
    }
    for (const i of document.querySelectorAll('[data-way-color]')) {
      i.style.color = stage.colorOf(state.theme, Number(i.dataset.wayColor));
    }
    for (const i of document.querySelectorAll('[data-way-swatch]')) {
      i.style.background = kMetricColors[state.theme].euclidean;
    }
    for (const i of document.querySelectorAll('[data-trace]')) {
      i.style.color = stage.arrowColor(state.theme, Number(i.dataset.trace));
    }
    for (const button of document.querySelectorAll('button.way')) {
      button.setAttribute('aria-pressed',
                          Number(button.dataset.way) === state.way);
    }
    if (this.viewer.probe) this.viewer.probe.tell();
    if (this.viewer.task) this.viewer.task.tell();
    if (this.viewer.map) this.viewer.map.tell();
    if (this.viewer.surface) this.viewer.surface.tell();
    this.showIterations();
    if (!byId('scrub')) return;
    byId('scrub').value = Math.round(10000 * state.time);
    byId('speed').value = state.speed;
    byId('play').textContent = state.playing ? '❚❚' : '▶';
    if (byId('chart-kind')) byId('chart-kind').value = state.chart;
    if (byId('chart')) drawChart(this.viewer);
  }
}
