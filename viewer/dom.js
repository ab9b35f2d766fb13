// Elements of the page.

function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith('on')) {
      element.addEventListener(key.slice(2), value);
    } else if (value !== null && value !== false) {
      element.setAttribute(key, value);
    }
  }
  element.append(...children);
  return element;
}

// Fonts need not have one.
function linkIcon() {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', '0 0 16 16');
  const path = document.createElementNS('http://www.w3.org/2000/svg', 'path');
  path.setAttribute('d', 'M7 9a3 3 0 0 0 4.2 0l2.5-2.5a3 3 0 0 0-4.2-4.2L8.2 ' +
      '3.6M9 7a3 3 0 0 0-4.2 0L2.3 9.5a3 3 0 0 0 4.2 4.2l1.3-1.3');
  for (const [key, value] of Object.entries(
           {fill: 'none', stroke: 'currentColor', 'stroke-width': 1.6})) {
    path.setAttribute(key, value);
  }
  svg.append(path);
  return svg;
}

// Is the window as narrow as a phone?  The style has the same limit.
const isNarrow = () => innerWidth <= 760;

const byId = id => document.getElementById(id);
