// Start and goal that can be moved, and what is asked of them: by the server
// that the page came from, by the library in the page, or by whoever reads it.

// What can be asked of a scene's kind; `by`: the choices of a setting, the
// first the scene's own.
const kTasks = {
  translates: {
    plan: {text: 'a path (plan)', option: 'planner',
           by: ['contact-surface', 'rrt-connect', 'retraction-forest']},
    optimize: {text: 'a trajectory (optimize)', option: 'metric',
               by: ['phong', 'euclidean']},
    depth: {text: 'depth at the start'},
  },
  turns: {
    plan: {text: 'a path (plan)'},
    optimize: {text: 'a short path (optimize)'},
    depth: {text: 'depth at the start'},
  },
  robots: {
    optimize: {text: 'motions (optimize)', option: 'preset',
               by: ['fast', 'balanced', 'tight']},
    depth: {text: 'depth at its start'},
  },
};

class TaskPanel {
  constructor(viewer) {
    this.viewer = viewer;
    this.task = viewer.data.task;
    this.solver = viewer.data.solver ? new Solver(viewer.data) : null;
    this.tasks = kTasks[this.task.kind];
    this.what = Object.keys(this.tasks)[0];
    this.robot = 0;      // of several: whose ends the fields are of
    this.ways = {};      // numbers of those that came, by what was asked
    this.answer = null;  // a depth, where it is shown
    this.isBusy = false;
    this.done = 0;       // questions that are over
    this.drag = new EndDrag(
        viewer, key => key === this.keyOf(key.split(' ')[0]),
        key => this.take(key), (key, raw) => this.move(key, raw));
    this.rings = this.task.kind === 'turns'
        ? new TurnRings(viewer, (key, turn) => this.turn(key, turn)) : null;
  }

  get hasRobots() { return this.task.kind === 'robots'; }

  // Of the robot that the fields are of: "start", or of several "start 2".
  keyOf(name) { return this.hasRobots ? name + ' ' + this.robot : name; }
  endOf(name) { return this.viewer.stage.endAt(this.keyOf(name)); }

  section(panel) {
    const row = (name, text, field) => make(
        'div', {class: 'point'}, make('span', {}, text),
        ...[0, 1, 2].map(k => field(name, k)));
    const ends = ['start', 'goal'].flatMap(name => [
      row(name, name, (...of) => this.field(...of)),
      ...(this.rings ? [row(name, 'turn', (...of) => this.turnField(...of))]
                     : [])]);
    const choice = (id, label, options, act) => make(
        'label', {class: 'row wide'}, make('span', {}, label),
        make('select', {id, class: 'map', onchange: e => act(e.target.value)},
             ...options.map(([value, text]) => make('option', {value}, text))));
    this.by = make('div', {});
    const section = panel.section(
        'Solve', ...(this.hasRobots ? [choice(
            'task-robot', 'ends of',
            this.viewer.data.ends.map(({robot}, i) => [i, robot]),
            value => { this.take('start ' + value); })] : []),
        ...ends,
        choice('task-along', 'drag them',
               [['', 'in the picture'],
                ...Object.keys(kAxes).map(k => [k, 'along ' + k])],
               value => { this.drag.axis = value; }),
        choice('task-what', 'find', Object.entries(this.tasks).map(
            ([value, task]) => [value, task.text]),
               value => { this.choose(value); }),
        this.by,
        make('div', {class: 'bar'},
             make('button', {id: 'solve', type: 'button',
                             onclick: () => this.solve()}, 'Solve'),
             make('button', {id: 'cancel', type: 'button', hidden: true,
                             onclick: () => this.cancel()}, 'Cancel')),
        make('p', {id: 'task-says', role: 'status'}, ''),
        make('p', {class: 'soft'}, 'Drag the marks of start and goal, with ' +
             'Ctrl up and down, or type where they are.' + (this.rings
             ? ' Of the end that you took last, rings turn the robot about ' +
               'x, y and z; the fields have the axis times the angle in ' +
               'degrees.' : '')));
    section.id = 'task';
    this.choose(this.what);
    if (this.task.served || this.solver) return section;
    // Little can be asked of a page alone: it is there for who looks for it.
    const [title, ...rest] = section.childNodes;
    section.append(make('details', {}, make('summary', {}, title), ...rest));
    return section;
  }

  // A number of an end: `now` it is, and what becomes of it.
  number(id, label, name, now, act) {
    return make('input', {
      id, type: 'number', step: 'any', 'aria-label': label,
      onfocus: () => this.take(this.keyOf(name)),
      onchange: e => {
        const value = Number(e.target.value);
        if (e.target.value === '' || !Number.isFinite(value)) return this.tell();
        act(now().slice(), value);
      },
    });
  }

  field(name, k) {
    return this.number(
        name + '-' + 'xyz'[k], 'xyz'[k] + ' of the ' + name, name,
        () => this.endOf(name).place, (to, value) => {
          to[k] = value;
          this.move(this.keyOf(name), to);
        });
  }

  turnField(name, k) {
    return this.number(
        name + '-turn-' + 'xyz'[k],
        'turn about ' + 'xyz'[k] + ' at the ' + name + ', degrees', name,
        () => vectorOfTurn(this.endOf(name).turn), (to, value) => {
          to[k] = value;
          this.turn(this.keyOf(name), turnOfVector(to));
        });
  }

  choose(what) {
    this.what = what;
    const {option, by} = this.tasks[what];
    this.by.replaceChildren(...(option && this.task.served ? [make(
        'label', {class: 'row wide'}, make('span', {}, 'by ' + option),
        make('select', {id: 'task-by', class: 'map'},
             make('option', {value: ''}, 'scene\'s own'),
             ...by.map(value => make('option', {value}, value))))] : []));
  }

  // Somebody takes hold of an end.
  take(key) {
    if (this.rings) this.rings.around(key);
    if (this.hasRobots) this.robot = Number(key.split(' ')[1]);
    this.tell();
    this.viewer.changed();
  }

  // What was found belongs to other places from here on.
  move(key, raw) {
    this.viewer.stage.moveEnd(key, raw);
    if (this.rings) this.rings.place();
    this.moved();
  }

  turn(key, turn) {
    this.viewer.stage.turnEnd(key, turn);
    this.moved();
  }

  moved() {
    this.answer = null;
    this.say(this.isBusy ? 'solving …' : 'Moved; press Solve.');
    this.tell();
    this.viewer.changed();
  }

  say(text, isError = false) {
    byId('task-says').textContent = text;
    byId('task-says').classList.toggle('error', isError);
  }

  // Puts the ends into the fields.
  tell() {
    const fill = (id, x) => {
      const field = byId(id);
      if (document.activeElement === field) return;
      field.value = Number(x.toPrecision(6));
    };
    for (const name of ['start', 'goal']) {
      const {place, turn} = this.endOf(name);
      place.forEach((x, k) => fill(name + '-' + 'xyz'[k], x));
      if (!this.rings) continue;
      vectorOfTurn(turn).forEach((x, k) => fill(
          name + '-turn-' + 'xyz'[k], Math.abs(x) < 1e-9 ? 0 : x));
    }
    if (this.hasRobots) byId('task-robot').value = this.robot;
    byId('solve').disabled = this.isBusy;
    byId('cancel').hidden = !this.isBusy || !(this.task.served || this.solver);
  }

  async solve() {
    if (this.isBusy) return;
    const {viewer, what} = this;
    this.isBusy = true;
    this.say('solving …');
    this.tell();
    try {
      if (this.task.served) {
        takeAnswer(this, await askServer(this));
      } else if (what === 'plan' && this.solver) {
        takeAnswer(this, await this.solver.plan(questionOf(this)));
      } else if (what === 'depth' && viewer.probe) {
        await this.probeStart();
      } else {
        this.say(this.whatSolves());
      }
    } catch (error) {
      this.say(error.message, true);
    }
    this.isBusy = false;
    ++this.done;
    this.tell();
  }

  whatSolves() {
    return (this.solver ? 'This page by itself finds paths' +
                          (this.viewer.probe ? ' and depths' : '') + ' only'
                        : 'This page has no solver behind it') +
        '. Run: ' + this.task.command;
  }

  // The answer to the question says so, too.
  async cancel() {
    this.say('cancelling …');
    if (!this.task.served) return this.solver.cancel();
    await post('cancel', {}).catch(() => {});
  }

  show(answer, obstacle) {
    const {viewer} = this;
    this.answer = answer;
    viewer.set(() => {
      viewer.state.xray = viewer.state.xray || answer.depth > 0;
      viewer.state.probe.on = false;
    });
    this.say(viewer.answerText(answer) +
             (obstacle ? ' (' + obstacle + ')' : ''));
  }

  // By the library in the page, of all obstacles together.
  async probeStart() {
    const {viewer} = this, {probe} = viewer.probe, {start} = viewer.data;
    await probe.load();
    probe.smooth(viewer.state.probe.smoothing);
    const [euclidean, phong] = probe.coldAnswers(start);
    const {inside, contact, direction, distance} = euclidean;
    this.show({
      status: inside ? 'penetrating' : 'separate', position: start,
      depth: Math.max(0, -distance), clearance: Math.max(0, distance),
      direction, on_a: start, on_b: contact,
    });
    if (inside) {
      byId('task-says').textContent +=
          '; PhongPD ' + viewer.text(-phong.distance);
    }
  }

  // The arrow of a depth, and the robot where it is pushed to.
  pose() {
    const {stage} = this.viewer, {solved} = stage, {answer} = this;
    solved.group.visible = answer !== null && answer.on_a !== null;
    if (!solved.group.visible) return;
    const a = stage.at(answer.on_a), b = stage.at(answer.on_b);
    stage.setArrow(solved, a, b);
    const {ghost} = solved;
    if (this.hasRobots) ghost.geometry = stage.ways[this.robot].shape;
    ghost.position.copy(stage.at(answer.position)).add(b).sub(a);
    ghost.quaternion.copy(asTurn(answer.orientation || [1, 0, 0, 0]));
    ghost.visible = answer.depth > 0;
  }
}
