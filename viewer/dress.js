// How the stage is dressed: transparent, bent, in a theme.

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
    for (const {material, way} of this.ownMarks) {
      material.color.copy(asColor(this.colorOf(name, way)));
    }
    this.ghostMaterial.color.set(theme.ghost);
    this.arrows.forEach((arrow, i) => {
      const color = asColor(this.arrowColor(name, i));
      arrow.material.color.set(theme.mark);
      arrow.pale.color.copy(color);
    });
    // They share one picture, so each has its own colour.
    this.probeArrows.forEach((arrow, i) => {
      const color = asColor(nameColor(name, kProbeMetrics, i));
      arrow.material.color.copy(color);
      arrow.pale.color.copy(color);
    });
    const {solved} = this;
    solved.material.color.set(theme.mark);
    solved.pale.color.copy(asColor(kMetricColors[name].euclidean));
  }

  // Traces of a motion have the colours; its line is the theme's.
  colorOf(theme, way) {
    return this.ways[way] && this.ways[way].kind === 'motion'
        ? '#' + kThemes[theme].ghost.toString(16)
        : nameColor(theme, this.ways.map(w => w.name), way);
  }

  // Of a motion its trace's, of an answer that of the least depth.
  arrowColor(theme, i) {
    const {motion} = this.data;
    return motion ? nameColor(theme, motion.traces.map(t => t.name), i)
        : kMetricColors[theme].euclidean;
  }
}
