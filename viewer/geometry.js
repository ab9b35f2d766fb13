// Meshes out of the data block, and what is drawn of them.

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

function decodeMesh(entry) {
  return {
    positions: new Float32Array(bytesOf(entry.positions)),
    indices: new Uint32Array(bytesOf(entry.indices)),
  };
}

// Unit normal and double area of each triangle: nx, ny, nz, area.
function facesOf(mesh) {
  const {positions: p, indices: t} = mesh;
  const faces = new Float32Array(t.length / 3 * 4);
  for (let f = 0; f < t.length / 3; ++f) {
    const a = 3 * t[3 * f], b = 3 * t[3 * f + 1], c = 3 * t[3 * f + 2];
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    const area = Math.hypot(x, y, z);
    const s = area > 0 ? 1 / area : 0;
    faces.set([x * s, y * s, z * s, area], 4 * f);
  }
  return faces;
}

// Without what is on its own box and looks inwards: the walls that bounds make
// of free space.  Of what is bounded by nothing but itself such sides look out.
function withoutWalls(mesh) {
  const {positions: p, indices: t} = mesh;
  const low = [Infinity, Infinity, Infinity], high = low.map(x => -x);
  for (const v of t) {
    for (let k = 0; k < 3; ++k) {
      low[k] = Math.min(low[k], p[3 * v + k]);
      high[k] = Math.max(high[k], p[3 * v + k]);
    }
  }
  const faces = facesOf(mesh);
  const isWall = f => [0, 1, 2].some(k => {
    const at = [0, 1, 2].map(c => p[3 * t[3 * f + c] + k]);
    const normal = faces[4 * f + k];
    return (normal > 0.5 && at.every(x => x === low[k])) ||
        (normal < -0.5 && at.every(x => x === high[k]));
  });
  const indices = [];
  for (let f = 0; f < t.length / 3; ++f) {
    if (!isWall(f)) indices.push(t[3 * f], t[3 * f + 1], t[3 * f + 2]);
  }
  return {positions: p, indices: Uint32Array.from(indices)};
}

const kCrease = Math.cos(32 * Math.PI / 180);

// Corners of their own for each triangle.  A corner's normal is the mean, by
// area, of the faces around the vertex that turn by less than the crease.
function shadedGeometry(mesh) {
  const {positions: p, indices: t} = mesh;
  const faces = facesOf(mesh);
  const vertices = p.length / 3;
  const first = new Uint32Array(vertices + 1);
  for (const v of t) ++first[v + 1];
  for (let v = 0; v < vertices; ++v) first[v + 1] += first[v];
  const around = new Uint32Array(t.length);
  const next = first.slice();
  for (let i = 0; i < t.length; ++i) around[next[t[i]]++] = Math.floor(i / 3);

  const corners = new Float32Array(3 * t.length);
  const normals = new Float32Array(3 * t.length);
  for (let i = 0; i < t.length; ++i) {
    const v = t[i], f = 4 * Math.floor(i / 3);
    let x = 0, y = 0, z = 0;
    // Of a fan of thousands, those at its beginning will do.
    const end = Math.min(first[v + 1], first[v] + 256);
    for (let k = first[v]; k < end; ++k) {
      const g = 4 * around[k];
      const cosine = faces[f] * faces[g] + faces[f + 1] * faces[g + 1] +
          faces[f + 2] * faces[g + 2];
      if (cosine < kCrease) continue;
      x += faces[g] * faces[g + 3];
      y += faces[g + 1] * faces[g + 3];
      z += faces[g + 2] * faces[g + 3];
    }
    const length = Math.hypot(x, y, z);
    if (length > 0) {
      normals.set([x / length, y / length, z / length], 3 * i);
    } else {
      normals.set([faces[f], faces[f + 1], faces[f + 2]], 3 * i);
    }
    corners.set([p[3 * v], p[3 * v + 1], p[3 * v + 2]], 3 * i);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(corners, 3));
  geometry.setAttribute('normal', new THREE.BufferAttribute(normals, 3));
  return geometry;
}

// Calls visit(a, b, f, g) for every edge between vertices a and b with its
// triangles; g is -1 at a boundary.
function forEachEdge(mesh, visit) {
  const {positions, indices: t} = mesh;
  const count = positions.length / 3;
  const open = new Map();
  for (let i = 0; i < t.length; ++i) {
    const a = t[i], b = t[i % 3 === 2 ? i - 2 : i + 1];
    const f = Math.floor(i / 3);
    const key = a < b ? a * count + b : b * count + a;
    const other = open.get(key);
    if (other === undefined) {
      open.set(key, f);
    } else {
      open.delete(key);
      visit(a, b, f, other);
    }
  }
  for (const [key, f] of open) {
    visit(Math.floor(key / count), key % count, f, -1);
  }
}

// Edges at which the surface turns by more than the crease, and boundaries.
function edgeGeometry(mesh) {
  const {positions: p} = mesh;
  const faces = facesOf(mesh);
  const lines = [];
  forEachEdge(mesh, (a, b, f, g) => {
    if (g >= 0) {
      const cosine = faces[4 * f] * faces[4 * g] +
          faces[4 * f + 1] * faces[4 * g + 1] +
          faces[4 * f + 2] * faces[4 * g + 2];
      if (cosine > kCrease || faces[4 * f + 3] === 0 ||
          faces[4 * g + 3] === 0) {
        return;
      }
    }
    lines.push(p[3 * a], p[3 * a + 1], p[3 * a + 2], p[3 * b], p[3 * b + 1],
               p[3 * b + 2]);
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(lines, 3));
  return geometry;
}

// Mean curvature at the vertices (sum of angle times edge length over area),
// squeezed to (-1, 1): ridges are positive, valleys negative.
function bendOf(mesh) {
  const {positions: p, indices: t} = mesh;
  const faces = facesOf(mesh);
  const bend = new Float64Array(p.length / 3);
  const area = new Float64Array(p.length / 3);
  for (let i = 0; i < t.length; ++i) {
    area[t[i]] += faces[4 * Math.floor(i / 3) + 3];
  }
  forEachEdge(mesh, (a, b, f, g) => {
    if (g < 0) return;
    const n = k => [faces[4 * k], faces[4 * k + 1], faces[4 * k + 2]];
    const [x, y] = [n(f), n(g)];
    const cross = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2],
                   x[0] * y[1] - x[1] * y[0]];
    const e = [0, 1, 2].map(k => p[3 * b + k] - p[3 * a + k]);
    const dot = x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
    // Edge a-b runs along f, so that f × g points along it over a ridge.
    const side = cross[0] * e[0] + cross[1] * e[1] + cross[2] * e[2];
    const angle = Math.atan2(Math.hypot(...cross), dot) * Math.sign(side);
    const share = angle * Math.hypot(...e);
    bend[a] += share;
    bend[b] += share;
  });
  return bend.map((h, v) => area[v] > 0 ? Math.tanh(0.08 * h / area[v]) : 0);
}

// Of the corners, by their vertices: blue valleys, orange ridges, nearly white
// between, told apart without red and green.
function bendColors(mesh, corners) {
  const bend = bendOf(mesh);
  const colors = new Float32Array(3 * corners.length);
  const ends = [[0.13, 0.42, 0.75], [0.9, 0.9, 0.88], [0.86, 0.42, 0.05]];
  corners.forEach((v, i) => {
    const h = bend[v], share = Math.sqrt(Math.abs(h));
    const end = ends[h < 0 ? 0 : 2];
    for (let k = 0; k < 3; ++k) {
      colors[3 * i + k] = ends[1][k] + share * (end[k] - ends[1][k]);
    }
  });
  return new THREE.BufferAttribute(colors, 3);
}

// A polyline as pieces of it, for dashes.
function dashes(points, dash, gap) {
  const pieces = [];
  let piece = [points[0]], left = dash, isOn = true;
  for (let i = 1; i < points.length; ++i) {
    let from = points[i - 1];
    for (;;) {
      const length = from.distanceTo(points[i]);
      if (length <= left) {
        left -= length;
        piece.push(points[i]);
        break;
      }
      from = from.clone().lerp(points[i], left / length);
      piece.push(from);
      if (isOn) pieces.push(piece);
      isOn = !isOn;
      piece = [from];
      left = isOn ? dash : gap;
    }
  }
  if (isOn && piece.length > 1) pieces.push(piece);
  return pieces;
}

// At most `most` of the points, both ends among them.
function thinned(points, most) {
  if (points.length <= most) return points;
  return Array.from({length: most}, (_, i) =>
      points[Math.round(i * (points.length - 1) / (most - 1))]);
}

// Tubes around polylines, with round joints.
function tubeGeometry(pieces, radius) {
  const positions = [], normals = [], index = [], sides = 10;
  const along = new THREE.Vector3(), u = new THREE.Vector3();
  const v = new THREE.Vector3(), n = new THREE.Vector3();
  for (const points of pieces) {
    for (let i = 1; i < points.length; ++i) {
      along.subVectors(points[i], points[i - 1]);
      if (along.length() === 0) continue;
      along.normalize();
      const isFlat = Math.abs(along.z) < 0.9;
      u.set(isFlat ? 0 : 1, 0, isFlat ? 1 : 0);
      u.cross(along).normalize();
      v.crossVectors(along, u);
      const base = positions.length / 3;
      for (const end of [points[i - 1], points[i]]) {
        for (let k = 0; k < sides; ++k) {
          const angle = 2 * Math.PI * k / sides;
          n.copy(u).multiplyScalar(Math.cos(angle));
          n.addScaledVector(v, Math.sin(angle));
          positions.push(end.x + radius * n.x, end.y + radius * n.y,
                         end.z + radius * n.z);
          normals.push(n.x, n.y, n.z);
        }
      }
      for (let k = 0; k < sides; ++k) {
        const a = base + k, b = base + (k + 1) % sides;
        index.push(a, b, a + sides, b, b + sides, a + sides);
      }
    }
    const ball = new THREE.SphereBufferGeometry(radius, sides, 6);
    for (const point of points) {
      const base = positions.length / 3;
      const p = ball.attributes.position.array;
      for (let k = 0; k < p.length; k += 3) {
        positions.push(point.x + p[k], point.y + p[k + 1], point.z + p[k + 2]);
      }
      normals.push(...ball.attributes.normal.array);
      for (const k of ball.index.array) index.push(base + k);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position',
                        new THREE.Float32BufferAttribute(positions, 3));
  geometry.setAttribute('normal', new THREE.Float32BufferAttribute(normals, 3));
  geometry.setIndex(index);
  return geometry;
}
