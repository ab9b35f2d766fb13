// Start and goal that can be moved, and what is asked of them: by the server
// that the page came from, by the probe in the page, or by whoever reads it.

// What can be asked; `by`: the choices of a setting, the first the scene's own.
const kTasks = {
  plan: {text: 'a path (plan)', option: 'planner',
         by: ['contact-surface', 'rrt-connect', 'retraction-forest']},
  optimize: {text: 'a trajectory (optimize)', option: 'metric',
             by: ['phong', 'euclidean']},
  depth: {text: 'how deep the start is (depth)', option: null, by: []},
};

class TaskPanel {
  constructor(viewer) {
    this.viewer = viewer;
    this.task = viewer.data.task;
    this.what = 'plan';
    this.ways = {};      // numbers of those that came, by what was asked
    this.answer = null;  // a depth, where it is shown
    this.isBusy = false;
    this.done = 0;       // questions that are over
    this.drag = new EndDrag(viewer, (name, raw) => this.move(name, raw));
  }

  section(panel) {
    const row = name => make(
        'div', {class: 'point'}, make('span', {}, name),
        ...[0, 1, 2].map(k => this.field(name, k)));
    const choice = (id, label, options, act) => make(
        'label', {class: 'row wide'}, make('span', {}, label),
        make('select', {id, class: 'map', onchange: e => act(e.target.value)},
             ...options.map(([value, text]) => make('option', {value}, text))));
    this.by = make('div', {});
    const section = panel.section(
        'Solve', row('start'), row('goal'),
        choice('task-along', 'drag them',
               [['', 'in the picture'],
                ...Object.keys(kAxes).map(k => [k, 'along ' + k])],
               value => { this.drag.axis = value; }),
        choice('task-what', 'find', Object.entries(kTasks).map(
            ([value, task]) => [value, task.text]),
               value => { this.choose(value); }),
        this.by,
        make('button', {id: 'solve', type: 'button',
                        onclick: () => this.solve()}, 'Solve'),
        make('p', {id: 'task-says', role: 'status'}, ''),
        make('p', {class: 'soft'}, 'Drag the marks of start and goal, with ' +
             'Ctrl up and down, or type where they are.'));
    section.id = 'task';
    this.choose(this.what);
    return section;
  }

  field(name, k) {
    return make('input', {
      id: name + '-' + 'xyz'[k], type: 'number', step: 'any',
      'aria-label': 'xyz'[k] + ' of the ' + name,
      onchange: e => {
        const value = Number(e.target.value);
        if (e.target.value === '' || !Number.isFinite(value)) return this.tell();
        const to = this.viewer.data[name].slice();
        to[k] = value;
        this.move(name, to);
      },
    });
  }

  choose(what) {
    this.what = what;
    const {option, by} = kTasks[what];
    this.by.replaceChildren(...(option ? [make(
        'label', {class: 'row wide'}, make('span', {}, 'by ' + option),
        make('select', {id: 'task-by', class: 'map'},
             make('option', {value: ''}, 'as the scene says'),
             ...by.map(value => make('option', {value}, value))))] : []));
  }

  // What was found belongs to other places from here on.
  move(name, raw) {
    const {viewer} = this;
    this.answer = null;
    viewer.stage.moveEnd(name, raw);
    this.say(this.isBusy ? 'solving …' : 'Moved; press Solve.');
    this.tell();
    viewer.changed();
  }

  say(text, isError = false) {
    byId('task-says').textContent = text;
    byId('task-says').classList.toggle('error', isError);
  }

  // Puts the ends into the fields.
  tell() {
    for (const name of ['start', 'goal']) {
      this.viewer.data[name].forEach((x, k) => {
        const field = byId(name + '-' + 'xyz'[k]);
        if (document.activeElement !== field) {
          field.value = Number(x.toPrecision(6));
        }
      });
    }
    byId('solve').disabled = this.isBusy;
  }

  async solve() {
    if (this.isBusy) return;
    const {viewer, what} = this;
    this.isBusy = true;
    this.say('solving …');
    this.tell();
    try {
      if (this.task.served) {
        this.take(await this.ask());
      } else if (what === 'depth' && viewer.probe) {
        await this.probeStart();
      } else {
        this.say('This page has no solver behind it. Run: ' +
                 this.task.command);
      }
    } catch (error) {
      this.say(error.message, true);
    }
    this.isBusy = false;
    ++this.done;
    this.tell();
  }

  question() {
    const {data} = this.viewer, {what} = this;
    const question = {what, start: data.start};
    if (what !== 'depth') question.goal = data.goal;
    const by = byId('task-by');
    if (by && by.value) {
      question.options = {[kTasks[what].option]: by.value};
    }
    return question;
  }

  async ask() {
    let reply;
    try {
      reply = await fetch('solve', {
        method: 'POST', headers: {'Content-Type': 'application/json'},
        body: JSON.stringify(this.question()),
      });
    } catch (error) {
      throw new Error('The server does not answer; start it again: ' +
                      this.task.command);
    }
    const answer = await reply.json().catch(() => ({}));
    if (!reply.ok) {
      throw new Error(answer.error || 'The server refuses: ' + reply.status);
    }
    return answer;
  }

  take(answer) {
    if (answer.what === 'depth') return this.takeDepths(answer);
    const {viewer} = this, {stage, data, state} = viewer;
    const path = answer.paths[0], {row} = answer;
    const before = answer.what in this.ways ? this.ways[answer.what] : -1;
    if (path.points.length > 0) {
      const index = stage.putWay(path, before);
      this.ways[answer.what] = index;
      data.paths[index] = path;
      viewer.panel.renewWays();
      Object.assign(state, {way: index, time: 0, iterate: null,
                            playing: false});
      state.probe.on = false;
    }
    this.answer = null;
    viewer.apply();
    this.say(this.sentence(row), !row.solved);
  }

  // "solved: room 0.05 units, 0.2 s"
  sentence(row) {
    const {viewer} = this;
    const status = (row.status_class || row.status).replace(/_/g, ' ');
    const told = [];
    if (row.duration) told.push(viewer.digits(row.duration) + ' s long');
    if (row.path_length) told.push(viewer.text(row.path_length) + ' long');
    if (row.solved) told.push('room ' + viewer.text(row.clearance));
    // Of a plan, a path that was optimised, and a motion in time.
    const {solve, total, plan, curve} = row.seconds;
    const took = [solve, total, plan + curve].find(Number.isFinite);
    told.push('found in ' + viewer.digits(took) + ' s');
    return status + ': ' + (row.solved ? told.join(', ')
        : row.reason || 'no answer');
  }

  // Of several obstacles that in which it is deepest, or the nearest.
  takeDepths({rows, answers}) {
    const {viewer} = this;
    const distance = a => a.clearance - a.depth;
    const best = answers.reduce(
        (k, a, i) => distance(a) < distance(answers[k]) ? i : k, 0);
    this.show(answers[best], rows[best].obstacle);
    if (!rows[best].certified) {
      this.say('not certified within the limit of time: at most ' +
               viewer.text(answers[best].depth), true);
    }
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
    const {solved} = this.viewer.stage, {answer} = this;
    solved.group.visible = answer !== null && answer.on_a !== null;
    if (!solved.group.visible) return;
    const {stage} = this.viewer;
    const a = stage.at(answer.on_a), b = stage.at(answer.on_b);
    stage.setArrow(solved, a, b);
    solved.ghost.position.copy(stage.at(answer.position)).add(b).sub(a);
    solved.ghost.visible = answer.depth > 0;
  }
}
