// What the page keeps in its link and saves as a picture; and how it starts.

// What follows # in the address; nothing if somebody has cut it in pieces.
function linkText() {
  try {
    return decodeURIComponent(location.hash.slice(1));
  } catch (error) {
    return '';
  }
}

class LinkedViewer extends DrawnViewer {
  // The view as text: only what differs from the first one.
  hash() {
    const {state, orbit} = this, first = this.defaults();
    const short = x => Number(x.toFixed(4));
    const parts = {
      eye: [orbit.yaw, orbit.pitch, orbit.distance, ...orbit.target.toArray()]
          .map(short).join(','),
      t: short(state.time), way: state.way,
    };
    if (state.clip.on) {
      parts.cut = [state.clip.axis, short(state.clip.at),
                   state.clip.flip ? 1 : 0].join(',');
    }
    const shown = Object.keys(state.show).filter(
        key => state.show[key] !== first.show[key]);
    if (shown.length) parts.toggled = shown.join(',');
    parts.xray = state.xray ? 1 : 0;
    if (state.map) parts.map = state.map;
    if (state.surface) parts.surface = state.surface;
    if (state.surface in kSurfaceMaps) parts.below = state.below;
    if (state.chart !== first.chart) parts.chart = state.chart;
    if (state.theme !== first.theme) parts.theme = state.theme;
    if (state.iterate !== null) parts.iter = state.iterate;
    if (state.speed !== 1) parts.speed = state.speed;
    if (state.probe.on) {
      parts.probe = [...state.probe.at, state.probe.smoothing,
                     state.probe.metric].join(',');
    }
    return Object.entries(parts).map(([k, v]) => k + '=' + v).join('&');
  }

  readLink() {
    const {state, orbit} = this;
    const link = new URLSearchParams(linkText());
    const numbers = key => (link.get(key) || '').split(',').map(Number);
    const eye = numbers('eye');
    if (eye.length === 6 && eye.every(Number.isFinite) && eye[2] > 0) {
      [orbit.yaw, orbit.pitch, orbit.distance] = eye;
      orbit.target.set(eye[3], eye[4], eye[5]);
    }
    const t = parseFloat(link.get('t'));
    if (t >= 0 && t <= 1) state.time = t;
    const way = parseInt(link.get('way'), 10);
    if (this.stage.ways[way] && this.stage.ways[way].points.length) {
      state.way = way;
    }
    const iterate = parseInt(link.get('iter'), 10);
    state.iterate = iterate >= 0 && iterate < this.iterations - 1
        ? iterate : null;
    if (link.has('cut')) {
      const [axis, at, flip] = link.get('cut').split(',');
      if (['x', 'y', 'z'].includes(axis) && at >= 0 && at <= 1) {
        state.clip = {on: true, axis, at: Number(at), flip: flip === '1'};
      }
    }
    const first = this.defaults();
    for (const key of (link.get('toggled') || '').split(',')) {
      if (key in state.show) state.show[key] = !first.show[key];
    }
    if (link.has('xray')) state.xray = link.get('xray') === '1';
    if (this.data.probe && link.get('map') in kMaps) {
      state.map = link.get('map');
    }
    if (link.get('surface') === kBend) state.surface = kBend;
    if (this.data.probe && link.get('surface') in kSurfaceMaps) {
      state.surface = link.get('surface');
      const below = parseFloat(link.get('below'));
      if (kSurfaceDepths.includes(below)) state.below = below;
    }
    if (link.get('theme') in kThemes) state.theme = link.get('theme');
    if (link.get('chart') in kChartKinds) state.chart = link.get('chart');
    const speed = parseFloat(link.get('speed'));
    if (speed > 0) state.speed = speed;
    const probe = numbers('probe');
    if (this.data.probe && probe.length === 5 &&
        probe.every(Number.isFinite) && kProbeSmoothing.includes(probe[3]) &&
        kProbeMetrics[probe[4]]) {
      Object.assign(state.probe, {at: probe.slice(0, 3), smoothing: probe[3],
                                  metric: probe[4], wanted: true});
    }
    // For pictures: nothing but the scene, the robot at stages, or at one moment.
    if (link.get('still') === '1') {
      state.still = true;
      state.show.stages = !link.has('t');
    }
  }

  keepLink() {
    if (this.state.still) return;
    history.replaceState(null, '', '#' + this.hash());
  }

  link() {
    this.keepLink();
    const done = text => this.say(text);
    if (navigator.clipboard) {
      navigator.clipboard.writeText(location.href).then(
          () => done('The link to this view is copied.'),
          () => done('The address bar has the link to this view.'));
    } else {
      done('The address bar has the link to this view.');
    }
  }

  // The scene with its title, labels and scale, on the page's ground.
  picture() {
    this.draw();
    const source = byId('canvas'), ratio = window.devicePixelRatio || 1;
    const target = make('canvas', {width: source.width, height: source.height});
    const g = target.getContext('2d');
    const style = getComputedStyle(document.body);
    g.fillStyle = style.getPropertyValue('--halo');
    g.fillRect(0, 0, target.width, target.height);
    g.drawImage(source, 0, 0);
    g.scale(ratio, ratio);
    const write = (text, x, y, font, color) => {
      g.font = font + ' system-ui, sans-serif';
      g.fillStyle = color;
      g.fillText(text, x, y);
    };
    const color = style.color;
    write(this.data.title, 20, 34, 'bold 20px', color);
    for (const label of byId('labels').children) {
      const box = label.getBoundingClientRect();
      const own = getComputedStyle(label);
      write(label.textContent, box.left, box.bottom - 4,
            'bold ' + own.fontSize, own.color);
    }
    const bar = byId('scalebar').querySelector('i').getBoundingClientRect();
    g.strokeStyle = color;
    g.lineWidth = 2;
    g.strokeRect(bar.left, bar.bottom, bar.width, 0);
    write(byId('scalebar').textContent, bar.left, bar.bottom + 16, 'bold 12px',
          color);
    return target;
  }

  save() {
    this.picture().toBlob(blob => {
      const a = make('a', {download: (this.data.title || 'view')
          .replace(/[^\w.-]+/g, '_') + '.png'});
      a.href = URL.createObjectURL(blob);
      a.click();
      setTimeout(() => URL.revokeObjectURL(a.href), 1000);
    });
  }
}

// In words what cannot be shown.
function tellInstead(text) {
  const message = byId('message');
  message.className = 'instead';
  message.textContent = text;
  message.hidden = false;
}

// What draws; null where the browser has it not.
function contextOf(canvas) {
  return canvas.getContext(
      'webgl', {alpha: true, antialias: true, depth: true, stencil: true});
}

function start() {
  const data = JSON.parse(byId('view-data').textContent);
  byId('title').textContent = data.title;
  const isEmpty = !data.meshes.some(m => m.shown) && !data.robot &&
      !data.motion && !data.answers.length && !data.start && !data.goal &&
      !data.paths.some(p => p.points.length);
  const context = contextOf(byId('canvas'));
  if (!context) {
    document.body.classList.add('bare');
    tellInstead('This browser draws no WebGL, so there is no picture. It ' +
                'would show ' + data.meshes.length + ' meshes and ' +
                data.paths.length + ' paths' + (data.paths.length
                ? ': ' + data.paths.map(p => p.name).join('; ') : '') +
                '. Switch hardware acceleration on, or take another browser.');
    return;
  }
  window.viewer = new LinkedViewer(data, context);
  if (isEmpty) {
    tellInstead('There is nothing to show: no mesh, no path, no answer.');
  }
}

start();
