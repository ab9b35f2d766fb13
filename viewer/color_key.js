// Scales of colour and their controls: which of some values is shown, and what
// the ends of the scale stand for.

// Told apart without red and green, and in print: dark to light (viridis).
const kMapColors = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98],
                    [253, 231, 37]];
// Of some values the largest are few and far off: those above this share of
// all have the last colour.
const kMapShare = 0.98, kMapFar = 1.25;

// Of some values, those that are no numbers apart: the ends of their scale.
// With `mayCut` it ends before the largest, if these are far off.
function scaleOf(values, map, mayCut) {
  const sorted = [...values].filter(Number.isFinite).sort((x, y) => x - y);
  const last = sorted.length ? sorted[sorted.length - 1] : 0;
  const most = sorted[Math.floor(kMapShare * (sorted.length - 1))];
  const low = map.least || 0;
  const isCut = mayCut && last > kMapFar * most;
  return {low, high: Math.max(isCut ? most : last, low), isCut,
          isEmpty: !sorted.length};
}

function mapColor(share) {
  const at = Math.min(1, Math.max(0, share)) * (kMapColors.length - 1);
  const i = Math.min(kMapColors.length - 2, Math.floor(at));
  return kMapColors[i].map(
      (c, k) => Math.round(c + (at - i) * (kMapColors[i + 1][k] - c)));
}

// The rows of `id` in the panel: a choice among `maps` (by name, with a text),
// the key and what is said where there is nothing.
function colorRows(id, text, maps, choose, empty) {
  const kinds = Object.entries(maps).map(
      ([value, map]) => make('option', {value}, map.text));
  return [
    make('label', {class: 'row wide'}, make('span', {}, text),
         make('select', {id, class: 'map', 'aria-label': text,
                         onchange: e => choose(e.target.value)},
              make('option', {value: ''}, 'nothing'), ...kinds)),
    make('div', {id: id + '-key', class: 'key map-key', hidden: ''},
         make('span', {id: id + '-low'}), make('i'),
         make('span', {id: id + '-high'})),
    make('p', {id: id + '-empty', class: 'soft', hidden: ''}, empty),
  ];
}

// Puts what is chosen and its range, {low, high, isCut, isEmpty} or null, into
// them; `map` says the unit.
function tellColors(viewer, id, chosen, range, map) {
  byId(id).value = chosen;
  byId(id + '-key').hidden = !range || range.isEmpty;
  byId(id + '-empty').hidden = !range || !range.isEmpty;
  if (!range || range.isEmpty) return;
  // "0.31 units", "≥ 2.4×".
  const text = (value, isCut) => (isCut ? '≥ ' : '') +
      (map.isLength ? viewer.text(value) : viewer.number(value) + map.unit);
  byId(id + '-low').textContent = text(range.low, false);
  byId(id + '-high').textContent = text(range.high, range.isCut);
}
