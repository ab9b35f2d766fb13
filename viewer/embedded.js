// As a part of a page that is scrolled.

// There the wheel and the finger scroll past the picture until somebody has
// clicked it; with ctrl the wheel zooms at once, as everywhere.  A page of its
// own has nothing to scroll.
function sleepInPages(viewer) {
  if (window.self === window.top) return;
  const {orbit} = viewer;
  const sleep = isAsleep => {
    orbit.isAsleep = isAsleep;
    document.body.classList.toggle('asleep', isAsleep);
  };
  orbit.onAsleep = () =>
    viewer.say('Click the picture, or hold Ctrl, to zoom with the wheel.');
  sleep(true);
  document.addEventListener('pointerdown', e => {
    if (e.pointerType !== 'touch') sleep(false);
  }, true);
  document.addEventListener('click', () => sleep(false), true);
  document.documentElement.addEventListener('pointerleave', e => {
    if (e.pointerType !== 'touch') sleep(true);
  });
  window.addEventListener('blur', () => sleep(true));
}
