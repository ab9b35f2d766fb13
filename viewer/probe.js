// The library's own queries in the page: what each metric says of a robot that
// one drags about.

// In the order, and so the colours, of motions.
const kProbeMetrics = ['Euclidean PD', 'PhongPD', 'sliding contact'];
const kProbeSliding = 2;
// As QueryStatus has them, in its order (query_status.h).
const kQueryStates =
    ['ok', 'branch ended', 'Euclidean fallback', 'invalid', 'following',
     'sliding', 'left elsewhere', 'outside'];
const kProbeNumbers = 12;  // of one metric (probe.cc)

class Probe {
  constructor(data) {
    this.data = data.probe;
    this.smoothing = null;  // that the metrics are made for
  }

  // Compiles the module and hands it the contact spaces.  Rejects with a
  // sentence.
  load() {
    if (!this.loading) this.loading = this.instantiate();
    return this.loading;
  }

  async instantiate() {
    const {calls, put} = await startModule(bytesOf(this.data.module));
    this.calls = calls;
    for (const {positions, indices} of this.data.spaces) {
      const p = new Float64Array(bytesOf(positions));
      const t = new Int32Array(bytesOf(indices));
      calls.add_space(put(p, Float64Array), p.length / 3, put(t, Int32Array),
                      t.length / 3);
    }
  }

  // Of metrics with this smoothing length, a share of D.
  smooth(share) {
    if (this.smoothing === share) return;
    this.calls.prepare(this.data.length, share);
    this.smoothing = share;
  }

  // Where the robot was does not matter any more.
  forget() { this.calls.forget(); }

  // What each metric says of the robot at a point in the user's unit, where it
  // went from the point before.
  answers(point) { return this.read(this.calls.query(...point), 3); }

  // The same of the first two, Euclidean PD and PhongPD, wherever it was.
  coldAnswers(point) { return this.read(this.calls.query_cold(...point), 2); }

  // The same of one of the contact spaces.
  coldAnswersOf(space, point) {
    return this.read(this.calls.query_cold(...point), 2, space, space + 1);
  }

  // The first metrics' answers, `rows` of them for each contact space: of
  // several, from `begin` to before `end`, that in which the robot is deepest.
  read(address, rows, begin = 0, end = this.data.spaces.length) {
    const count = this.data.spaces.length;
    const all = new Float64Array(this.calls.memory.buffer, address,
                                 count * rows * kProbeNumbers);
    return kProbeMetrics.slice(0, rows).map((name, metric) => {
      let best = null;
      for (let space = begin; space < end; ++space) {
        const at = (space * rows + metric) * kProbeNumbers;
        const row = all.slice(at, at + kProbeNumbers);
        if (!best || row[2] < best[2]) best = row;
      }
      return {
        name, status: kQueryStates[best[0]], inside: best[1] === 1,
        distance: best[2], contact: [...best.slice(3, 6)],
        direction: [...best.slice(6, 9)], gradient: [...best.slice(9, 12)],
      };
    });
  }
}
