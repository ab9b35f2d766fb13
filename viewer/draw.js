// Drawing: panes, labels, scale and what there is to know.

class DrawnViewer extends Viewer {
  // Are there panes, one for each metric of a motion?
  get isSplit() { return !!this.data.motion && !this.state.probe.on; }

  // A motion has one pane for each metric, side by side; all else has one.
  panes(width, height) {
    const motion = this.isSplit ? this.data.motion : null;
    const count = motion ? Math.max(1, motion.traces.length) : 1;
    const {still} = this.state, isSmall = isNarrow();
    const isColumn = width < height;
    const hasPanel = !isSmall && !document.body.classList.contains('open');
    // What the page lays over the canvas.
    const right = hasPanel && !still ? 288 : 0;
    const top = isSmall ? (motion ? 86 : 100) : count > 1 ? 120 : 60;
    const bottom = still ? 50
        : Math.max(80, height - this.floor + (isSmall ? 52 : 16));
    const panes = [];
    for (let i = 0; i < count; ++i) {
      const pane = isColumn
          ? {x: 0, y: top + i * (height - top - bottom) / count, width,
             height: (height - top - bottom) / count}
          : {x: i * (width - right) / count, y: 0,
             width: (width - right) / count, height};
      if (count === 1) Object.assign(pane, {x: 0, y: 0, width, height});
      pane.inner = isColumn && count > 1
          ? {x: 10, y: 30, width: pane.width - 20, height: pane.height - 36}
          : {x: 10, y: top, height: pane.height - top - bottom,
             width: pane.width - 20 - (count === 1 ? right : 0)};
      pane.inner.width = Math.max(40, pane.inner.width);
      pane.inner.height = Math.max(40, pane.inner.height);
      panes.push(pane);
    }
    return panes;
  }

  draw() {
    this.isDirty = false;
    const {renderer, stage, state, camera} = this;
    const canvas = byId('canvas');
    const width = canvas.clientWidth, height = canvas.clientHeight;
    // Setting it makes a new buffer, also of the same size.
    const size = [width, height, window.devicePixelRatio || 1];
    if (String(size) !== this.size) {
      this.size = String(size);
      renderer.setPixelRatio(size[2]);
      renderer.setSize(width, height, false);
    }
    this.orbit.place(camera);
    stage.key.position.copy(camera.position).sub(this.orbit.target)
        .applyAxisAngle(new THREE.Vector3(0, 0, 1), 0.5);
    stage.key.position.z += 0.6 * this.orbit.distance;
    stage.key.target.position.copy(this.orbit.target);
    stage.key.target.updateMatrixWorld();
    stage.iterates.show(state.way, state.probe.on ? null : state.iterate);
    const place = stage.pose(state.way, state.time);
    stage.overlays.show(state.show, state.probe.on ? -1 : state.way,
                        place ? place.frame : 0);
    stage.crew.show(state.show, state.time);
    if (state.probe.on) this.probe.pose();
    if (this.task) this.task.pose();
    if (!state.probe.on) this.tell(place);  // which may need more lines
    const panes = this.panes(width, height);
    renderer.setScissorTest(false);
    // Opaque: as a part of another page what is behind a canvas may be black.
    renderer.setClearColor(state.theme === 'dark' ? 0x181d24 : 0xf2f4f6, 1);
    renderer.clear();
    renderer.setScissorTest(true);
    byId('labels').textContent = '';
    stage.ways.forEach((way, i) => {
      way.stages.visible = i === state.way;
    });
    panes.forEach((pane, i) => {
      const bottom = height - pane.y - pane.height;
      renderer.setViewport(pane.x, bottom, pane.width, pane.height);
      renderer.setScissor(pane.x, bottom, pane.width, pane.height);
      const {inner} = pane;
      this.orbit.height = inner.height;
      camera.aspect = inner.width / inner.height;
      camera.setViewOffset(inner.width, inner.height, -inner.x, -inner.y,
                           pane.width, pane.height);
      this.dress(i);
      renderer.render(stage.scene, camera);
      this.label(pane, i, panes.length);
    });
    this.scaleBar(panes[0].inner.height);
    document.documentElement.dataset.ready = '1';
  }

  // The robot has the colour of what it follows.
  dress(pane) {
    const {stage, state} = this, isMotion = this.isSplit;
    stage.robot.visible = state.show.robot &&
        (!!this.data.robot || stage.ways.length > 0 || state.probe.on) &&
        (!stage.crew.isTeam || state.probe.on);
    stage.robotMaterial.color.copy(asColor(
        isMotion ? stage.arrowColor(state.theme, pane)
        : state.probe.on ? nameColor(state.theme, kProbeMetrics,
                                     state.probe.metric)
        : stage.colorOf(state.theme, state.way)));
    // Of what cannot be cut, no cap; nor where the plane has other colours.
    stage.groups.caps.visible = state.clip.on && !state.xray && !state.map &&
        (state.show.obstacle || state.show.mesh);
    if (isMotion) {
      stage.arrows.forEach((arrow, k) => { arrow.group.visible = k === pane; });
    }
  }

  label(pane, index, count) {
    const {stage, state, camera} = this;
    const put = (text, left, top, color, kind) => {
      const label = make('div', {class: kind}, text);
      label.style.left = left + 'px';
      label.style.top = top + 'px';
      if (color) label.style.color = color;
      byId('labels').append(label);
    };
    if (this.isSplit) {
      const trace = this.data.motion.traces[index];
      if (index > 0 && pane.x > 0) {
        put('', pane.x, Math.max(0, pane.inner.y - 50), null, 'rule');
      }
      if (trace) {
        put(trace.name, pane.x + pane.width / 2,
            pane.y + Math.max(4, pane.inner.y - 36),
            stage.arrowColor(state.theme, index), 'pane');
      }
    }
    if (!state.show.marks || index > 0) return;
    const boxes = this.covers();
    const taken = [];
    for (const {text, point, way, owner} of stage.labels) {
      // A robot of several has its name where it is.
      const p = (stage.crew.placeOf(way) || point).clone().project(camera);
      if (p.z > 1 || Math.abs(p.x) > 1 || Math.abs(p.y) > 1) continue;
      const width = 8 * text.length + 10, height = 19;
      let x = Math.min(pane.x + (p.x + 1) / 2 * pane.width,
                       innerWidth - width - 12);
      let y = pane.y + (1 - p.y) / 2 * pane.height;
      // None of what is below what the page lays over the picture; of what is
      // beside that, to its left.  A label is above its point.
      const below = b => b.left < x && x < b.right && b.top < y && y < b.bottom;
      const hidesIt = b => b.left < x + width + 10 && x < b.right &&
          b.top < y && y - 1.3 * height < b.bottom;
      if (boxes.some(below)) continue;
      const over = boxes.find(hidesIt);
      if (over) x = over.left - width - 12;
      if (x < 4 || boxes.some(hidesIt)) continue;
      // Below what is there already.
      const isTaken = t => Math.abs(t.y - y) < height && t.x < x + width &&
          x < t.x + t.width;
      for (let i = 0; i < 8 && taken.some(isTaken); ++i) y += height;
      taken.push({x, y, width});
      const of = way === undefined ? owner : way;
      put(text, x, y,
          of === undefined ? null : stage.colorOf(state.theme, of), 'name');
    }
  }

  // Where the page lays something over the picture.
  covers() {
    return ['panel', 'tools', 'player', 'reading']
        .map(id => byId(id).getBoundingClientRect())
        .filter(box => box.width > 0);
  }

  // Where begins what is laid over the picture's lower end.
  get floor() {
    return ['player', 'reading'].map(id => byId(id).getBoundingClientRect())
        .reduce((top, box) => box.height > 0 ? Math.min(top, box.top) : top,
                innerHeight);
  }

  scaleBar(height) {
    const perPixel = 2 * this.orbit.distance * Math.tan(kFieldOfView / 2) /
        height * this.data.scale;
    const wanted = perPixel * Math.min(140, innerWidth / 4);
    const ten = 10 ** Math.floor(Math.log10(wanted));
    const nice = [5, 2, 1].find(k => k * ten <= wanted) * ten;
    // On a phone above what is there, however high that is.
    byId('scalebar').style.bottom = isNarrow() && this.floor < innerHeight
        ? innerHeight - this.floor + 10 + 'px' : '';
    byId('scalebar').querySelector('i').style.width = nice / perPixel + 'px';
    byId('scalebar').querySelector('b').textContent = this.text(nice);
  }

  // "penetrating, depth 0.3 units"
  answerText(answer) {
    return answer.status +
        (answer.depth > 0 ? ', depth ' + this.text(answer.depth)
         : answer.clearance > 0 ? ', ' + this.text(answer.clearance) + ' apart'
         : '');
  }

  // What there is to know where the robot is.
  tell(place) {
    const {data, state, stage} = this, where = byId('where');
    const way = stage.iterates.shown || stage.ways[state.way];
    if (!place || !way) return;
    const point = '(' + place.raw.map(x => this.number(x)).join(', ') + ')';
    if (way.kind === 'path') {
      const length = way.lengths[way.lengths.length - 1] * data.scale;
      if (where && way.pace) {
        where.textContent = paceText(this, way.pace);
      } else if (where && way.turns) {
        where.textContent = Math.round(100 * state.time) + ' % · ' + point;
      } else if (where) {
        where.textContent = this.number(state.time * length) + ' of ' +
            this.text(length) + ' · ' + point;
      }
    } else if (way.kind === 'motion') {
      if (where) {
        where.textContent = 'frame ' + place.frame + ' of ' +
            (way.points.length - 1) + ' · ' + point;
      }
      data.motion.traces.forEach((trace, i) => {
        const depth = Math.hypot(...trace.pd[place.frame]);
        const status = trace.status[place.frame];
        byId('trace-' + i).textContent = this.text(depth) +
            (status === 'ok' ? '' : ' · ' + status.replace(/_/g, ' '));
      });
    } else {
      const answer = data.answers[place.frame];
      const text = this.answerText(answer);
      for (const small of document.querySelectorAll('button.way small')) {
        small.textContent = text;
      }
      if (where) {
        where.textContent = 'pose ' + (place.frame + 1) + ' of ' +
            way.points.length + ' · ' + text;
      }
    }
  }
}
