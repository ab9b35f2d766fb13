// The keyboard: what the keys do, and what the help says of them.

const kKeys = [
  ['drag · one finger', 'turn'],
  ['shift or right drag · two fingers', 'move'],
  ['wheel · pinch, + −', 'zoom'],
  ['space', 'play, pause'],
  ['← →', 'robot back, on'],
  [', .', 'an iteration of the optimiser back, on'],
  ['1 … 9', 'follow that path'],
  ['R', 'reset the view'],
  ['X Y Z', 'look along an axis'],
  ['C', 'clipping plane'],
  ['O', 'see through solids'],
  ['K', 'contact space'],
  ['P', 'probe: drag the robot, read its depth'],
  ['G', 'robot at stages'],
  ['T', 'light or dark'],
  ['S', 'save as PNG'],
  ['L', 'link to this view'],
  ['? · Esc', 'this help'],
];

// Does what a key means; leaves all others to the browser.
function actOnKey(viewer, e) {
  if (e.ctrlKey || e.metaKey || e.altKey) return;
  if (e.target.tagName === 'SELECT' || e.target.type === 'number') return;
  if (viewer.probe && viewer.probe.key(e)) return;
  const {state, orbit} = viewer;
  const look = (yaw, pitch) => {
    orbit.yaw = yaw;
    orbit.pitch = pitch;
    viewer.changed();
  };
  const flip = key => viewer.set(() => {
    state.show[key] = !state.show[key];
  });
  const actions = {
    ' ': () => viewer.togglePlay(),
    ArrowLeft: () => viewer.step(-1), ArrowRight: () => viewer.step(1),
    ',': () => viewer.stepIterate(-1), '.': () => viewer.stepIterate(1),
    '+': () => orbit.zoom(1 / 1.15), '=': () => orbit.zoom(1 / 1.15),
    '-': () => orbit.zoom(1.15),
    r: () => viewer.reset(), t: () => viewer.toggleTheme(),
    x: () => look(0, 0), y: () => look(-Math.PI / 2, 0),
    z: () => look(-Math.PI / 2, Math.PI / 2),
    c: () => viewer.set(() => { state.clip.on = !state.clip.on; }),
    o: () => viewer.set(() => { state.xray = !state.xray; }),
    p: () => { if (viewer.probe) viewer.probe.turn(!state.probe.on); },
    k: () => flip('contact'), g: () => flip('stages'),
    s: () => viewer.save(), l: () => viewer.link(),
    '?': () => viewer.panel.toggleHelp(),
    Escape: () => viewer.panel.toggleHelp(false),
  };
  if (/^[1-9]$/.test(e.key)) return viewer.follow(Number(e.key) - 1);
  const act = actions[e.key.length === 1 ? e.key.toLowerCase() : e.key];
  if (!act) return;
  e.preventDefault();
  act();
}
