// Colours: of solids by theme, of paths in turn, and one of each metric.

// One colour a metric, in the pages, in the figures of phongpd and in those of
// results (problems/output/metric_color.h, results/bench/step_figure.py; a test
// compares them).  Dark pages have lighter ones of the same hues.
const kMetricColors = {
  light: {phong: '#0060b0', euclidean: '#d55e00', sliding: '#009e73'},
  dark: {phong: '#4eaaf0', euclidean: '#ff8b3d', sliding: '#2fc89a'},
};

const kThemes = {
  light: {
    obstacle: 0xb4bac4, cap: 0x7d8694, edge: 0x3a424e, mesh: 0xc9c3b8,
    contact: 0x3d8fd1, mark: 0x1d232b, ghost: 0x8a929e, mesh2: 0x9fb3bd,
    mover: 0x9a86b8, graph: 0x8a5a00, plane: 0x9c2f7a, window: 0x007a5e,
    paths: ['#0072b2', '#d55e00', '#009e73', '#b8578f', '#b07800', '#2f9bd0',
            '#5b4fa3', '#6b6b00'],
  },
  dark: {
    obstacle: 0x77818f, cap: 0xa9b3c2, edge: 0xc9d2df, mesh: 0x8c8577,
    contact: 0x58aef0, mark: 0xf1f4f8, ghost: 0x98a2b0, mesh2: 0x6d8794,
    mover: 0xb3a2cf, graph: 0xf0c060, plane: 0xff9be0, window: 0x4fe0b8,
    paths: ['#4eaaf0', '#ff8b3d', '#2fc89a', '#ee9bcb', '#f2c14e', '#9fdcff',
            '#a99bff', '#d6d64a'],
  },
};

// "phong" of "PhongPD, ℓ = 0.1"; null: no metric's name.
function metricOf(name) {
  return /^phong/i.test(name) ? 'phong'
      : /^euclidean/i.test(name) ? 'euclidean'
      : /^sliding/i.test(name) ? 'sliding' : null;
}

function wayColor(theme, i) {
  const colors = kThemes[theme].paths;
  if (i < colors.length) return colors[i];
  const lightness = theme === 'light' ? 38 : 68;
  return 'hsl(' + (i * 137.5) % 360 + ',55%,' + lightness + '%)';
}

const asColor = text => {
  const color = new THREE.Color();
  color.setStyle(text);
  return color;
};

// Of the i-th of some names: its metric's, where it has one, of the next of the
// same metric a paler one each; or the i-th of the paths' colours, beside metrics
// of those that are no metric's.
function nameColor(theme, names, i) {
  const metric = names[i] === undefined ? null : metricOf(names[i]);
  if (!metric) return wayColor(theme, names.some(metricOf) ? i + 3 : i);
  const before = names.slice(0, i).filter(n => metricOf(n) === metric).length;
  const color = asColor(kMetricColors[theme][metric]);
  color.lerp(new THREE.Color(theme === 'light' ? 0x9fb4c8 : 0xffffff),
             Math.min(0.75, 0.45 * before));
  return '#' + color.getHexString();
}
