// What is asked of the server behind the page, and what becomes of its answer.

function questionOf({viewer: {data}, task: {kind}, tasks, what, robot}) {
  const isDepth = what === 'depth', question = {what};
  if (kind !== 'robots') {
    question.start = data.start;
    if (!isDepth) question.goal = data.goal;
  } else if (isDepth) {
    Object.assign(question, {robot: data.ends[robot].robot,
                             start: data.ends[robot].start});
  } else {
    question.robots = data.ends.map(
        end => ({id: end.robot, start: end.start, goal: end.goal}));
  }
  if (kind === 'turns') {
    question.start_turn = data.start_turn;
    if (!isDepth) question.goal_turn = data.goal_turn;
  }
  const by = byId('task-by');
  if (by && by.value) question.options = {[tasks[what].option]: by.value};
  return question;
}

function post(path, json) {
  return fetch(path, {
    method: 'POST', headers: {'Content-Type': 'application/json'},
    body: JSON.stringify(json),
  });
}

async function askServer(panel) {
  let reply;
  try {
    reply = await post('solve', questionOf(panel));
  } catch (error) {
    throw new Error('The server does not answer; start it again: ' +
                    panel.task.command);
  }
  const answer = await reply.json().catch(() => ({}));
  if (!reply.ok) {
    throw new Error(answer.error || 'The server refuses: ' + reply.status);
  }
  return answer;
}

// The paths that came, in place of those before; returns which is followed.
function takePaths(panel, {what, paths}) {
  const {viewer: {stage, data, state}, ways, hasRobots} = panel;
  if (hasRobots) {
    paths.forEach((path, i) => {
      path.robot = data.paths[i].robot;
      data.paths[i] = path;
      stage.putWay(path, i);
      stage.crew.robots[i].way = stage.ways[i];
    });
    return state.way;
  }
  const index = stage.putWay(paths[0], what in ways ? ways[what] : -1);
  data.paths[index] = paths[0];
  return ways[what] = index;
}

function takeAnswer(panel, answer) {
  if (answer.what === 'depth') return takeDepths(panel, answer);
  const {viewer} = panel, {row} = answer;
  if (answer.paths.some(path => path.points.length > 0)) {
    const way = takePaths(panel, answer);
    (answer.movers || []).forEach(
        ({points}, i) => viewer.stage.crew.retime(i, points));
    viewer.panel.renewWays();
    Object.assign(viewer.state, {way, time: 0, iterate: null, playing: false});
    viewer.state.probe.on = false;
  }
  panel.answer = null;
  viewer.apply();
  panel.say(sentenceOf(viewer, answer), !row.solved);
}

// "solved: room 0.05 units, 0.2 s"
function sentenceOf(viewer, {row, collision, closest}) {
  const status = (row.status_class || row.status).replace(/_/g, ' ');
  if (!row.solved) {
    return status + ': ' + (row.reason || 'no answer') +
        (collision ? '; ' + collision : '');
  }
  const told = [], {seconds, clearance} = row;
  if (row.duration) told.push(viewer.digits(row.duration) + ' s long');
  if (row.path_length) {
    told.push(viewer.text(row.path_length) + ' long' +
              (viewer.data.task.kind === 'turns' ? ' with its turns' : ''));
  }
  // Of a robot that turns, what is proved.
  const room = clearance && clearance.lower !== undefined
      ? clearance.lower : clearance;
  if (Number.isFinite(room)) told.push('room ' + viewer.text(room));
  // What is planned in the page keeps no clearance, and has to say so.
  if (room < row.wanted) {
    told.push('less than the ' + viewer.text(row.wanted) + ' that the scene asks for (' +
              viewer.data.task.command + ' keeps it where there is room)');
  }
  if (closest) told.push('closest ' + closest);
  // Of a plan, a path that was optimised, a motion in time, several motions.
  const {solve, total, plan, curve} = seconds;
  const took = [seconds, solve, total, plan + curve].find(Number.isFinite);
  told.push('found in ' + viewer.digits(took) + ' s');
  return status + ': ' + told.join(', ');
}

// Of several obstacles that in which it is deepest, or the nearest.
function takeDepths(panel, {rows, answers}) {
  const distance = a => a.clearance - a.depth;
  const best = answers.reduce(
      (k, a, i) => distance(a) < distance(answers[k]) ? i : k, 0);
  panel.show(answers[best], rows[best].obstacle);
  if (!rows[best].certified) {
    panel.say('not certified within the limit of time: at most ' +
              panel.viewer.text(answers[best].depth), true);
  }
}
