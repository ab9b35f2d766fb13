// The solids of the scene, in lengths of its size around its centre: shaded,
// cut, or like glass.

class Solids {
  constructor(data) {
    this.data = data;
    this.scene = new THREE.Scene();
    this.plane = new THREE.Plane(new THREE.Vector3(-1, 0, 0), 10);
    this.center = new THREE.Vector3(...data.center);
    this.groups = {};
    for (const name of ['obstacle', 'contact', 'mesh', 'caps', 'paths', 'marks',
                        'stages', 'traces', 'behind']) {
      this.groups[name] = new THREE.Group();
      this.scene.add(this.groups[name]);
    }
    this.solids = [];    // {mesh, edges, role}
    this.glass = [];     // materials whose rims are denser
    this.colored = [];   // [material, name of its colour in the theme]
    // Nothing to see behind a contact space that is alone.
    this.glassOpacity = data.meshes.every(m => m.role === 'contact') &&
        !data.paths.length && !data.motion && !data.answers.length ? 0.42 : 0.2;
    this.light();
    for (const entry of data.meshes) this.addMesh(entry);
  }

  // The user's coordinates to the stage's.
  at(point) {
    return new THREE.Vector3(...point).sub(this.center)
        .divideScalar(this.data.scale);
  }

  light() {
    const sky = new THREE.HemisphereLight(0xffffff, 0x9a958e, 0.66);
    sky.position.set(0, 0, 1);
    this.scene.add(sky);
    this.key = new THREE.DirectionalLight(0xffffff, 0.55);
    this.scene.add(this.key);
    const fill = new THREE.DirectionalLight(0xdfe9ff, 0.2);
    fill.position.set(-3, 2, -1);
    this.scene.add(fill);
  }

  solid(color, more) {
    const material = new THREE.MeshPhongMaterial({
      shininess: 18, specular: 0x222222, side: THREE.DoubleSide,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
      ...more,
    });
    this.colored.push([material, color]);
    return material;
  }

  // Clear where one looks straight through it, dense at its rims.
  makeGlass(material) {
    material.transparent = true;
    material.depthWrite = false;
    material.onBeforeCompile = shader => {
      shader.fragmentShader = shader.fragmentShader.replace(
          '#include <premultiplied_alpha_fragment>',
          'gl_FragColor.a *= mix(0.55, 2.6, pow(1.0 - abs(dot(normalize(' +
          'vViewPosition), normal)), 2.5));\n' +
          '#include <premultiplied_alpha_fragment>');
    };
    this.glass.push(material);
  }

  addMesh(entry) {
    const mesh = decodeMesh(entry);
    const shaded = entry.role === 'contact' ? withoutWalls(mesh) : mesh;
    const geometry = shadedGeometry(shaded);
    const group = new THREE.Group();
    const clip = {clippingPlanes: [this.plane]};
    const lines = new THREE.LineBasicMaterial(
        {transparent: true, opacity: 0.55, ...clip});
    // What was simplified for display has creases that the solid has not.
    const isWhole = entry.shown === entry.triangles;
    const edges = new THREE.LineSegments(
        edgeGeometry(isWhole ? mesh : {positions: [], indices: []}), lines);
    edges.renderOrder = 3;
    const solid = {entry, mesh, shaded, geometry, edges, group, faces: []};
    if (entry.role === 'contact') {
      lines.opacity = 0.3;
      this.colored.push([lines, 'contact']);
      for (const side of [THREE.BackSide, THREE.FrontSide]) {
        const material = this.solid('contact', {side, ...clip});
        this.makeGlass(material);
        material.opacity = this.glassOpacity;
        const faces = new THREE.Mesh(geometry, material);
        faces.renderOrder = side === THREE.BackSide ? 10 : 11;
        solid.faces.push(faces);
      }
    } else {
      this.colored.push([lines, 'edge']);
      solid.faces.push(new THREE.Mesh(
          geometry, this.solid(this.colorName(entry), {...clip})));
      this.addStencil(solid);
    }
    group.add(...solid.faces, edges);
    this.groups[entry.role].add(group);
    this.solids.push(solid);
  }

  // Meshes side by side take turns.
  colorName(entry) {
    if (entry.role !== 'mesh') return entry.role;
    const i = this.data.meshes.filter(m => m.role === 'mesh').indexOf(entry);
    return ['mesh', 'mesh2', 'obstacle'][i % 3];
  }

  // Counts, at each pixel, how many of the solid's surfaces lie before the
  // plane; where they do not cancel, the plane runs inside.
  addStencil(solid) {
    for (const [side, operation] of [
             [THREE.BackSide, THREE.IncrementWrapStencilOp],
             [THREE.FrontSide, THREE.DecrementWrapStencilOp]]) {
      const material = new THREE.MeshBasicMaterial({
        side, depthWrite: false, depthTest: false, colorWrite: false,
        clippingPlanes: [this.plane], stencilWrite: true,
        stencilFunc: THREE.AlwaysStencilFunc, stencilFail: operation,
        stencilZFail: operation, stencilZPass: operation,
      });
      const mesh = new THREE.Mesh(solid.geometry, material);
      mesh.renderOrder = -2;
      this.groups.caps.add(mesh);
    }
  }

  addCap() {
    const material = new THREE.MeshBasicMaterial({
      side: THREE.DoubleSide, stencilWrite: true, stencilRef: 0,
      stencilFunc: THREE.NotEqualStencilFunc,
      stencilFail: THREE.ReplaceStencilOp,
      stencilZFail: THREE.ReplaceStencilOp,
      stencilZPass: THREE.ReplaceStencilOp,
    });
    this.colored.push([material, 'cap']);
    this.cap = new THREE.Mesh(new THREE.PlaneBufferGeometry(4, 4), material);
    this.cap.renderOrder = -1;
    this.groups.caps.add(this.cap);
  }

  // Where the plane cuts its axis; `box` is the stage's.
  clipLevel(clip) {
    const axis = 'xyz'.indexOf(clip.axis);
    const low = this.box.min.getComponent(axis);
    const high = this.box.max.getComponent(axis);
    return low + (clip.at * 1.004 - 0.002) * (high - low);
  }

  setClip(clip) {
    const axis = 'xyz'.indexOf(clip.axis);
    const normal = new THREE.Vector3();
    normal.setComponent(axis, clip.flip ? 1 : -1);
    const level = this.clipLevel(clip);
    this.plane.normal.copy(normal);
    this.plane.constant = clip.on ? (clip.flip ? -level : level) : 10;
    this.cap.position.set(0, 0, 0);
    this.cap.position.setComponent(axis, level);
    this.cap.lookAt(this.cap.position.clone().add(normal));
    this.isClipped = clip.on;
  }
}
