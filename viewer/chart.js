// Charts of depths.

const kChartLeft = 46, kChartRight = 12;

// Lines of depths over their numbers, in the metrics' colours, on a canvas that
// is cleared; `x` and `y` place them, in CSS pixels.  Of more numbers than
// pixels, the least and the largest of each pixel.  Returns what draws on.
function drawDepths(canvas, theme, series, x, y) {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = canvas.clientWidth * ratio;
  canvas.height = canvas.clientHeight * ratio;
  const g = canvas.getContext('2d');
  g.scale(ratio, ratio);
  g.lineWidth = 2;
  series.forEach((depths, i) => {
    g.strokeStyle = wayColor(theme, i);
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

// |PD| of every metric over the frames of a motion, and where it is now.
function drawChart(viewer) {
  const {data, state} = viewer, canvas = byId('chart');
  const width = canvas.clientWidth, height = canvas.clientHeight;
  const depths = data.motion.traces.map(
      trace => trace.pd.map(p => Math.hypot(...p)));
  const most = largest(depths) || 1;
  const count = data.motion.positions.length;
  const x = f => kChartLeft + f / Math.max(1, count - 1) *
      (width - kChartLeft - kChartRight);
  const y = value => height - 8 - value / most * (height - 18);
  const g = drawDepths(canvas, state.theme, depths, x, y);
  const style = getComputedStyle(document.body);
  const line = (color, ax, ay, bx, by) => {
    g.strokeStyle = style.getPropertyValue(color);
    g.lineWidth = 1;
    g.beginPath();
    g.moveTo(ax, ay);
    g.lineTo(bx, by);
    g.stroke();
  };
  g.font = '11px system-ui, sans-serif';
  g.fillStyle = style.getPropertyValue('--soft');
  g.fillText('|PD|, ' + data.unit, kChartLeft + 4, 14);
  g.textAlign = 'right';
  g.fillText(viewer.number(most), kChartLeft - 8, 14);
  g.fillText('0', kChartLeft - 8, height - 5);
  line('--soft', kChartLeft, y(0), width - kChartRight, y(0));
  const now = x(state.time * (count - 1));
  line('--text', now, 4, now, height - 4);
}
