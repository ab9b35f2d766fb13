// The path as it was in each iteration of the optimiser, in place of the
// answer, which stays as a shade.

const kIteratesPerSecond = 8;  // at speed 1

class Iterates {
  // `stage`: with ways; those whose page holds iterations get them.
  constructor(stage) {
    this.stage = stage;
    this.group = new THREE.Group();
    stage.groups.paths.add(this.group);
    this.material = new THREE.MeshPhongMaterial(
        {shininess: 10, side: THREE.DoubleSide});
    this.mesh = null;
    this.key = '';
    for (const some of stage.data.iterates) {
      stage.ways[some.path].iterates = {
        ...some, positions: new Float32Array(bytesOf(some.positions)),
      };
    }
  }

  // As a way of its own, which the robot can follow; null: the answer is shown.
  at(way, index) {
    const {iterates} = way;
    if (!iterates || index === null || !iterates.kept[index]) return null;
    const {center, data: {scale}} = this.stage;
    const from = 3 * iterates.points * index;
    const points = Array.from({length: iterates.points}, (_, i) =>
        new THREE.Vector3().fromArray(iterates.positions, from + 3 * i));
    const raw = points.map(
        p => p.clone().multiplyScalar(scale).add(center).toArray());
    return {...way, raw, points, lengths: lengthsOf(points),
            free: iterates.kept[index].free};
  }

  // Shows the iterate of the way with this number, which becomes what the robot
  // follows; `index` null: the answer.
  show(number, index) {
    const key = number + ',' + index;
    if (key === this.key) return;
    this.key = key;
    const way = this.stage.ways[number];
    this.shown = way ? this.at(way, index) : null;
    if (this.mesh) {
      this.group.remove(this.mesh);
      this.mesh.geometry.dispose();
      this.mesh = null;
    }
    this.stage.wayMaterials.forEach((material, i) => {
      const isShade = !!this.shown && i === number;
      material.transparent = isShade;
      material.opacity = isShade ? 0.25 : 1;
      material.needsUpdate = true;
    });
    if (!this.shown) return;
    this.mesh = new THREE.Mesh(
        pathGeometry(this.shown, kPathRadius), this.material);
    this.group.add(this.mesh);
    this.material.color.copy(this.stage.wayMaterials[number].color);
  }

  // "iteration 12 of 60 · Ipopt from the line · collides · energy 1.31 ..."
  text(viewer) {
    const {iterates} = this.stage.ways[viewer.state.way];
    const kept = iterates.kept[viewer.state.iterate];
    if (!kept) return 'the answer, after ' + (iterates.count - 1);
    return [
      kept.number + ' of ' + (iterates.count - 1), kept.stage,
      kept.restoration ? 'restoration' : '', kept.free ? 'free' : 'collides',
      'energy ' + viewer.digits(kept.objective),
      kept.violation > 1e-9
          ? 'violation ' + viewer.digits(kept.violation) + ' D' : '',
    ].filter(Boolean).join(' · ');
  }
}
