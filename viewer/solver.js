// The library's own planner in the page, beside it in a worker: for robots that
// turn and for such as only translate.

const kSolverSeconds = 30;

// What the worker runs, with startModule; nothing else of the page is there.
function solverWorker(startModule) {
  let calls = null, text = null, put = null;

  const load = async ({module, robot, obstacles, bounds}) => {
    ({calls, text, put} = await startModule(module));
    const add = (isRobot, {positions, indices}) => calls.add_mesh(
        isRobot, put(positions, Float64Array), positions.length / 3,
        put(indices, Int32Array), indices.length / 3);
    add(1, robot);
    for (const mesh of obstacles) add(0, mesh);
    if (bounds) calls.set_bounds(put(bounds, Float64Array));
  };

  const plan = ({ends, turns, seconds, seed}) => {
    const solved = calls.plan(put(ends, Float64Array), turns ? 1 : 0,
                              seconds, seed) === 1;
    const count = calls.pose_count();
    return {
      solved, status: text(calls.status()), reason: text(calls.reason()),
      planner: text(calls.planner()), length: calls.length(),
      clearance: calls.clearance(), seconds: calls.took(),
      poses: new Float64Array(calls.memory.buffer, calls.poses(), 7 * count)
          .slice(),
    };
  };

  onmessage = async ({data}) => {
    try {
      if (!calls) await load(data.scene);
      postMessage({answer: plan(data)});
    } catch (error) {
      postMessage({error: error.message});
    }
  };
}

class Solver {
  constructor(data) {
    this.data = data;
    this.worker = null;
    this.asked = 0;  // who asks once more is given other random numbers
  }

  // What it needs once, in the form of messages.
  scene() {
    const {module, robot, obstacles} = this.data.solver, {bounds} = this.data;
    const meshOf = ({positions, indices}) => ({
      positions: new Float64Array(bytesOf(positions)),
      indices: new Int32Array(bytesOf(indices)),
    });
    return {module: bytesOf(module), robot: meshOf(robot),
            obstacles: obstacles.map(meshOf),
            bounds: bounds ? [...bounds.min, ...bounds.max] : null};
  }

  // A question as the server has it; so is the answer.  Rejects with a
  // sentence.
  plan({start, goal, start_turn: first, goal_turn: last}) {
    const turns = first !== undefined, still = [1, 0, 0, 0];
    const ends = [...start, ...(first || still), ...goal, ...(last || still)];
    const question = {ends, turns, seconds: kSolverSeconds, seed: ++this.asked};
    if (!this.worker) {
      const text = '(' + solverWorker + ')(' + startModule + ')';
      this.worker = new Worker(URL.createObjectURL(
          new Blob([text], {type: 'text/javascript'})));
      question.scene = this.scene();
    }
    return new Promise((done, fail) => {
      this.fail = why => { this.stop(); fail(new Error(why)); };
      this.worker.onerror = e => this.fail(e.message || 'no worker');
      this.worker.onmessage = ({data: {answer, error}}) =>
          error ? this.fail(error) : done(this.answerOf(answer, turns));
      this.worker.postMessage(question);
    });
  }

  answerOf(found, turns) {
    const points = [], ways = [], {poses} = found;
    for (let i = 0; i < poses.length; i += 7) {
      points.push([...poses.slice(i, i + 3)]);
      ways.push([...poses.slice(i + 3, i + 7)]);
    }
    const {solved, status, reason, planner, length, clearance} = found;
    return {
      what: 'plan',
      row: {solved, status, reason, path_length: length, clearance,
            wanted: this.data.task.clearance, seconds: found.seconds},
      paths: [{name: 'plan · ' + planner + ', in the page', free: true, points,
               turns: turns ? ways : null, pace: null, robot: null}],
    };
  }

  // The worker goes, and what it was asked with it.
  stop() {
    if (this.worker) this.worker.terminate();
    this.worker = null;
  }

  cancel() { if (this.worker && this.fail) this.fail('cancelled'); }
}
