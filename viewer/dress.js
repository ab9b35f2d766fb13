// Colours, and how the stage is dressed.

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

class DressedStage extends FramedStage {
  setXray(isOn) {
    for (const solid of this.solids) {
      if (solid.entry.role === 'contact') continue;
      const material = solid.faces[0].material;
      material.transparent = isOn;
      material.depthWrite = !isOn;
      material.opacity = isOn ? 0.11 : 1;
      solid.faces[0].renderOrder = isOn ? 8 : 0;
      material.needsUpdate = true;
    }
    this.isXray = isOn;
  }

  setBend(isOn) {
    for (const solid of this.solids) {
      if (solid.entry.role !== 'contact') continue;
      if (isOn && !solid.geometry.attributes.color) {
        solid.geometry.setAttribute('color', bendColors(solid.mesh, solid.shaded.indices));
      }
      for (const faces of solid.faces) {
        faces.material.vertexColors =
            isOn ? THREE.VertexColors : THREE.NoColors;
        faces.material.opacity = isOn ? 0.55 : this.glassOpacity;
        faces.material.needsUpdate = true;
      }
    }
    this.isBend = isOn;
  }

  setTheme(name) {
    const theme = kThemes[name];
    for (const [material, color] of this.colored) {
      material.color.set(theme[color]);
      if (this.isBend && this.glass.includes(material)) {
        material.color.set(0xffffff);
      }
    }
    this.wayMaterials.forEach((material, i) => {
      material.color.copy(asColor(this.colorOf(name, i)));
    });
    this.crew.setTheme(name);
    this.ghostMaterial.color.set(theme.ghost);
    this.arrows.forEach((arrow, i) => {
      const color = asColor(wayColor(name, this.arrowColor(i)));
      arrow.material.color.set(theme.mark);
      arrow.pale.color.copy(color);
    });
    // They share one picture, so each has its own colour.
    this.probeArrows.forEach((arrow, i) => {
      arrow.material.color.copy(asColor(wayColor(name, i)));
      arrow.pale.color.copy(asColor(wayColor(name, i)));
    });
  }

  // Traces of a motion have the colours; its line is the theme's.
  colorOf(theme, way) {
    return this.ways[way] && this.ways[way].kind === 'motion'
        ? '#' + kThemes[theme].ghost.toString(16)
        : wayColor(theme, way);
  }

  arrowColor(i) { return this.data.motion ? i : 1; }
}
