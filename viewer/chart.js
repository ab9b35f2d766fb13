// Charts of depths, and of what motions ask of their limits.

const kChartLeft = 46, kChartRight = 12;

// Lines of some series over their numbers, each in its colour, on a canvas that
// is cleared; `x` and `y` place them, in CSS pixels.  Of more numbers than
// pixels, the least and the largest of each pixel.  Returns what draws on.
function drawSeries(canvas, colors, series, x, y) {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = canvas.clientWidth * ratio;
  canvas.height = canvas.clientHeight * ratio;
  const g = canvas.getContext('2d');
  g.scale(ratio, ratio);
  g.lineWidth = 2;
  series.forEach((depths, i) => {
    g.strokeStyle = colors[i];
    g.beginPath();
    const step = Math.max(1, Math.ceil(depths.length / canvas.clientWidth));
    for (let f = 0; f < depths.length; f += step) {
      const some = depths.slice(f, f + step);
      g.lineTo(x(f), y(Math.min(...some)));
      if (step > 1) g.lineTo(x(f), y(Math.max(...some)));
    }
    g.stroke();
  });
  return g;
}

const largest = series => series.reduce(
    (most, numbers) => numbers.reduce((a, b) => Math.max(a, b), most), 0);

// What is beside the lines of a chart: lines across, a moment, words.
class ChartFrame {
  constructor(g, canvas) {
    this.g = g;
    this.width = canvas.clientWidth;
    this.height = canvas.clientHeight;
    this.style = getComputedStyle(document.body);
    g.font = '11px system-ui, sans-serif';
  }

  color(name) { return this.style.getPropertyValue(name); }

  line(color, ax, ay, bx, by, dash = []) {
    const {g} = this;
    g.strokeStyle = this.color(color);
    g.lineWidth = 1;
    g.setLineDash(dash);
    g.beginPath();
    g.moveTo(ax, ay);
    g.lineTo(bx, by);
    g.stroke();
    g.setLineDash([]);
  }

  // Returns where it ends.
  write(text, x, y, color = this.color('--soft'), align = 'left') {
    const {g} = this;
    g.fillStyle = color;
    g.textAlign = align;
    g.fillText(text, x, y);
    return x + g.measureText(text).width;
  }
}

// x of a share of the chart's width.
const acrossChart = (canvas, share) => kChartLeft + share *
    (canvas.clientWidth - kChartLeft - kChartRight);

// PD of every metric over the frames of a motion, or a motion's pace, and
// where it is now.
function drawChart(viewer) {
  const {data, pace} = viewer, canvas = byId('chart');
  canvas.hidden = !data.motion && !pace;
  if (data.motion) drawDepthChart(viewer, canvas);
  else if (pace) drawPaceChart(viewer, canvas, pace);
}

// What of PD is drawn: its length, how far it went since the frame before, or
// by how much it turned.  Where a metric has no PD, nothing has turned.
const kChartKinds = {
  angle: {text: 'turn of the way out, frame to frame', unit: '°',
          of: pd => fromFrame(pd, angleBetween)},
  change: {text: 'change of the way out, frame to frame', of: pd => fromFrame(
      pd, (a, b) => Math.hypot(...b.map((x, k) => x - a[k])))},
  size: {text: 'depth: length of the way out',
         of: pd => pd.map(p => Math.hypot(...p))},
};

// Of each frame and the one before it; 0 of the first.
const fromFrame = (pd, of) =>
    pd.map((p, f) => f === 0 ? 0 : of(pd[f - 1], p));

// Degrees; 0 where one of them is none.
function angleBetween(a, b) {
  const lengths = Math.hypot(...a) * Math.hypot(...b);
  if (!(lengths > 0)) return 0;
  const cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                 a[0] * b[1] - a[1] * b[0]];
  const dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  return Math.atan2(Math.hypot(...cross), dot) * 180 / Math.PI;
}

function drawDepthChart(viewer, canvas) {
  const {data, state, stage} = viewer, height = canvas.clientHeight;
  const kind = kChartKinds[state.chart];
  const values = data.motion.traces.map(trace => kind.of(trace.pd));
  const most = largest(values) || 1;
  const count = data.motion.positions.length;
  const x = f => acrossChart(canvas, f / Math.max(1, count - 1));
  const y = value => height - 8 - value / most * (height - 18);
  const colors = values.map((_, i) => stage.arrowColor(state.theme, i));
  const frame = new ChartFrame(drawSeries(canvas, colors, values, x, y), canvas);
  byId('chart-most').textContent = 'at most ' +
      (kind.unit ? viewer.digits(most) + kind.unit : viewer.text(most));
  frame.write(kind.unit ? viewer.digits(most) + kind.unit : viewer.number(most),
              kChartLeft - 8, 14, undefined, 'right');
  frame.write('0', kChartLeft - 8, height - 5, undefined, 'right');
  frame.line('--soft', kChartLeft, y(0), frame.width - kChartRight, y(0));
  const now = x(state.time * (count - 1));
  frame.line('--text', now, 4, now, height - 4);
}

const kPaceNames = ['velocity', 'acceleration', 'jerk'];

// Shares of the limits, of which nothing goes beyond 1, and the moment of least
// room.
function drawPaceChart(viewer, canvas, pace) {
  const {state} = viewer, height = canvas.clientHeight;
  const series = kPaceNames.map(name => pace[name]);
  const last = pace.velocity.length - 1;
  const x = f => acrossChart(canvas, f / last);
  // Where both do not fit into one line, the least room is below the names.
  const isTight = canvas.clientWidth < 420;
  const y = value => height - 8 - value * (height - (isTight ? 40 : 28));
  const frame = new ChartFrame(
      drawSeries(canvas, series.map((_, i) => wayColor(state.theme, i)),
                 series, x, y), canvas);
  let at = kChartLeft + 4;
  kPaceNames.forEach((name, i) => {
    at = 12 + frame.write(name, at, 11, wayColor(state.theme, i));
  });
  frame.write('limit', kChartLeft - 8, y(1) + 4, undefined, 'right');
  frame.write('0', kChartLeft - 8, height - 5, undefined, 'right');
  frame.line('--soft', kChartLeft, y(1), frame.width - kChartRight, y(1),
             [4, 3]);
  frame.line('--soft', kChartLeft, y(0), frame.width - kChartRight, y(0));
  const least = leastRoom(pace);
  frame.line('--soft', x(least), y(1), x(least), y(0), [2, 2]);
  frame.write('least room ' + viewer.text(pace.clearance[least]),
              frame.width - kChartRight, isTight ? 23 : 11, undefined, 'right');
  const now = x(state.time * last);
  frame.line('--text', now, 4, now, height - 4);
}

// The number of the moment.
const leastRoom = pace => pace.clearance.reduce(
    (best, room, i) => room < pace.clearance[best] ? i : best, 0);

// "1.2 of 4.5 s · of its limits 80, 30 and 100 % · room 12 mm"
function paceText(viewer, pace) {
  const {state} = viewer;
  const i = Math.round(state.time * (pace.velocity.length - 1));
  const share = name => Math.round(100 * pace[name][i]);
  return (state.time * pace.duration).toFixed(2) + ' of ' +
      pace.duration.toFixed(2) + ' s · v ' + share('velocity') + ' %, a ' +
      share('acceleration') + ' %, j ' + share('jerk') + ' % · room ' +
      viewer.text(pace.clearance[i]);
}
