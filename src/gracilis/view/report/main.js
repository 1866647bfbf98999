// Puts the page together: one state, and everything that follows it.
const runs = JSON.parse(document.getElementById('data').textContent);
const element = id => document.getElementById(id);
for (const run of runs) {  // runs of one scene are told apart by their folders
  const same = runs.length > 1 && runs.every(other => other.name === run.name);
  run.label = spoken(same ? run.folder.split('/').filter(Boolean).pop() : run.name);
}

const muscles = [];  // of all runs, each once
for (const run of runs)
  for (const muscle of run.muscles) if (!muscles.some(each => each.name === muscle.name)) muscles.push(muscle);

const page = {
  runCount: runs.length,
  state: {frame: 0, playing: false, visible: new Set(muscles.map(muscle => muscle.name)), colorBy: 'natural', opacity: 1,
          bones: true, fibers: false, xAxis: 'frame'},

  // The slider counts the first run's frames. Others show their frame in the most similar pose.
  frameOf(index, frame) { return index === 0 ? frame : matches[index][frame]; },

  xOf(index) {
    const run = runs[index];
    const coordinate = run.coordinates.find(each => each.name === this.state.xAxis);
    return coordinate ? coordinate.values : run.times.map((_, frame) => frame);
  },

  xLabel() {
    const coordinate = runs[0].coordinates.find(each => each.name === this.state.xAxis);
    return coordinate ? `${coordinate.name} (${coordinate.unit.trim()})` : 'frame';
  },

  poseText(frame) {
    return `frame ${frame} of ${runs[0].frame_count - 1} · ${runs[0].poses[frame].replaceAll('-', '−')}`;
  },

  goTo(frame, index = 0) {
    if (index > 0) frame = Math.max(0, matches[index].indexOf(frame));
    this.pause();
    this.state.frame = frame;
    this.update();
  },

  pause() {
    this.state.playing = false;
    element('play').textContent = '▶';
    element('play').setAttribute('aria-label', 'Play');
  },

  play() {
    if (this.state.frame === runs[0].frame_count - 1) this.state.frame = 0;
    this.state.playing = true;
    element('play').textContent = '❚❚';
    element('play').setAttribute('aria-label', 'Pause');
    let last = null, exact = this.state.frame;
    const step = now => {
      if (!this.state.playing) return;
      // From the first image on: it was begun before the click, by its time.
      exact = (exact + (now - (last ?? now)) * 0.03) % runs[0].frame_count;  // 30 frames per second
      last = now;
      this.state.frame = Math.floor(exact);
      this.update();
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  },

  // Everything that depends on the frame or on what is shown in the view.
  update() {
    const {frame} = this.state;
    element('slider').value = frame;
    element('slider').setAttribute('aria-valuetext', this.poseText(frame));
    element('pose').textContent = this.poseText(frame);
    stage.shapes.forEach((shapes, i) => shapes.show(this.frameOf(i, frame), this.state));
    stage.draw();
    for (const chart of charts) chart.moveCursor();
  },

  redraw() {
    for (const chart of charts) chart.draw();
    this.update();
  },
};

// Per run and frame of the first run: the frame whose coordinates are nearest; of several, the one as far through.
const matches = runs.map(run => runs[0].times.map((_, frame) => {
  let best = 0, least = Infinity;
  run.times.forEach((__, other) => {
    let distance = 1e-3 * Math.abs(other / run.frame_count - frame / runs[0].frame_count);
    for (const coordinate of runs[0].coordinates) {
      const same = run.coordinates.find(each => each.name === coordinate.name);
      if (same) distance += Math.abs(same.values[other] - coordinate.values[frame]);
    }
    if (distance < least) [best, least] = [other, distance];
  });
  return best;
}));

writeHead(runs);
// What a gate says is seen in colors, where it is about shape.
const GATE_COLORS = {edge_ratio_max_near: 'shape', edge_ratio_max_free: 'shape', spike: 'shape', thickening: 'shape',
                     thinning: 'shape', volume_ratio: 'volume'};
writeGates(runs, (frame, index, measure) => {
  if (GATE_COLORS[measure]) chooseColor(GATE_COLORS[measure]);
  page.goTo(frame, index);
});
writeWarnings(runs);
writeProvenance(runs);
writeSettings(runs);

// Without WebGL everything but the view still works.
const stage = new Stage(runs, element('canvas'));
if (!stage.renderer) element('captions').append(make('span', 'This browser offers no WebGL, which the view needs.'));
const VIEWS = {
  anterior: stage.axes.anterior, posterior: stage.axes.anterior.clone().negate(),
  right: stage.axes.right, left: stage.axes.right.clone().negate(),
  superior: stage.axes.superior.clone().addScaledVector(stage.axes.anterior, 0.01),
  inferior: stage.axes.superior.clone().negate().addScaledVector(stage.axes.anterior, 0.01),
};
Object.entries(VIEWS).forEach(([name, direction], i) => {
  const button = make('button', name, {type: 'button', title: `Seen from ${name} (${i + 1})`});
  button.addEventListener('click', () => stage.lookFrom(direction));
  element('views').append(button);
});

// Charts with the same id, of all runs, in one.
const ids = [];
for (const run of runs) for (const chart of run.charts) if (!ids.includes(chart.id)) ids.push(chart.id);
const charts = ids.map(id => {
  const lines = [];
  runs.forEach((run, index) => {
    const chart = run.charts.find(each => each.id === id);
    for (const series of chart ? chart.series : []) {
      const line = {...series, run: index, dash: DASHES[index % DASHES.length],
                    color: muscles.find(each => each.name === series.muscle).color,
                    name: spoken(series.muscle) + (runs.length > 1 ? `, ${run.label}` : '')};
      Object.defineProperty(line, 'x', {get: () => page.xOf(index), enumerable: true});
      lines.push(line);
    }
  });
  const chart = new Chart(runs.flatMap(run => run.charts).find(each => each.id === id), lines, page);
  element('plots').append(chart.element);
  return chart;
});

for (const muscle of muscles) {
  const label = make('label'), box = make('input', '', {type: 'checkbox', 'data-muscle': muscle.name});
  const swatch = make('span', '', {class: 'swatch', style: `background: ${muscle.color}`});
  box.checked = true;
  box.addEventListener('change', () => {
    if (box.checked) page.state.visible.add(muscle.name);
    else page.state.visible.delete(muscle.name);
    page.redraw();
  });
  label.append(box, swatch, spoken(muscle.name));
  element('muscles').append(label);
}
for (const [id, checked] of [['all', true], ['none', false]]) {
  element(id).addEventListener('click', () => {
    for (const box of document.querySelectorAll('#muscles input')) box.checked = checked;
    page.state.visible = new Set(checked ? muscles.map(muscle => muscle.name) : []);
    page.redraw();
  });
}

function chooseColor(key) {
  element('color-by').value = key;
  element('color-by').dispatchEvent(new Event('change'));
}

const has = key => {
  const scale = SHAPE_COLORS[key];
  if (scale.fibers) return runs.some(run => run.shapes.fibers.length);
  return !scale.chart || runs.some(run => run.charts.some(chart => chart.id === scale.chart));
};
for (const key of Object.keys(SHAPE_COLORS).filter(has))
  element('color-by').append(make('option', SHAPE_COLORS[key].label, {value: key}));
element('color-by').addEventListener('change', event => {
  const scale = SHAPE_COLORS[page.state.colorBy = event.target.value], bar = element('color-bar');
  bar.hidden = !scale.colors;
  if (scale.colors) {
    const stops = scale.colors.map(color => `rgb(${color.join(',')})`).join(',');
    bar.querySelector('b').textContent = scale.title;
    bar.querySelector('i').style.background = `linear-gradient(90deg, ${stops})`;
    const shown = rangeOf(stage.shapes.flatMap(shapes => shapes.range(page.state.colorBy)));
    bar.querySelector('span').replaceChildren(...ticksOf(scale, shown).map(tick => make('span', tick)));
  }
  element('muscles-title').textContent = page.state.colorBy === 'muscle' ? 'Muscles' : 'Muscles, with their colors in plots';
  page.update();
});
element('x-axis').append(make('option', 'frame', {value: 'frame'}));
for (const coordinate of runs[0].coordinates) {
  if (new Set(coordinate.values).size < 2) continue;
  element('x-axis').append(make('option', `${coordinate.name} (${coordinate.unit.trim()})`, {value: coordinate.name}));
}
element('x-axis').addEventListener('change', event => { page.state.xAxis = event.target.value; page.redraw(); });

element('slider').max = runs[0].frame_count - 1;
element('slider').addEventListener('input', event => page.goTo(Number(event.target.value)));
element('play').addEventListener('click', () => page.state.playing ? page.pause() : page.play());
const step = by => page.goTo(Math.min(Math.max(page.state.frame + by, 0), runs[0].frame_count - 1));
element('back').addEventListener('click', () => step(-1));
element('forth').addEventListener('click', () => step(1));
element('opacity').addEventListener('input', event => { page.state.opacity = Number(event.target.value); page.update(); });
element('bones').addEventListener('change', event => { page.state.bones = event.target.checked; page.update(); });
element('fibers').addEventListener('change', event => { page.state.fibers = event.target.checked; page.update(); });
element('fibers-label').hidden = !has('strain');
document.addEventListener('keydown', event => {
  const typing = event.target.closest('button, select, summary, a, input:not(#slider)');
  if (event.key === ' ' && !typing) {
    event.preventDefault();
    element('play').click();
  } else if (event.key >= '1' && event.key <= '6' && !event.ctrlKey && !event.metaKey && !event.altKey) {
    element('views').children[Number(event.key) - 1].click();
  }
});
// Paper gets all settings, and two columns of plots.
window.addEventListener('beforeprint', () => {
  document.querySelectorAll('details').forEach(each => { each.open = true; });
  for (const chart of charts) chart.draw(330);
});
window.addEventListener('afterprint', () => { for (const chart of charts) chart.draw(); });

if (runs.length > 1) {
  runs.forEach((run, i) => {
    element('captions').append(make('span', run.label));
    const key = svg('svg', {width: 34, height: 10, 'aria-hidden': 'true'});
    svg('line', {x1: 0, x2: 34, y1: 5, y2: 5, stroke: '#1d2327', 'stroke-width': 2, 'stroke-dasharray': DASHES[i % 4]}, key);
    element('run-legend').append(key, ` ${run.label}  `);
  });
}
stage.drawn = () => {
  // The longest round length that takes no more than a quarter of the view.
  const perMetre = stage.pixelsPerMetre(), room = element('canvas').clientWidth / 4 / runs.length;
  const length = [0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001].find(each => each * perMetre <= room) || 0.001;
  element('scale').style.width = `${length * perMetre}px`;
  element('scale').firstElementChild.textContent = length >= 0.01 ? `${100 * length} cm` : `${1000 * length} mm`;
};
element('canvas').setAttribute('aria-label', `Bones and ${muscles.length} muscles in three dimensions: ` +
  `${muscles.map(muscle => spoken(muscle.name)).join(', ')}. Arrow keys turn, plus and minus zoom, 1 to 6 choose views.`);
// Flexion is seen best from the side of the leg, a little from the front.
const side = muscles.filter(muscle => muscle.name.endsWith('_l')).length > muscles.length / 2 ? -1 : 1;
stage.lookFrom(stage.axes.right.clone().multiplyScalar(side).addScaledVector(stage.axes.anterior, 0.45));
// The address may say what to show at first: report.html#frame=45&color=stretch
const wanted = new URLSearchParams(location.hash.slice(1));
if (SHAPE_COLORS[wanted.get('color')]) chooseColor(wanted.get('color'));
page.state.frame = Math.min(Math.max(Number(wanted.get('frame')) || 0, 0), runs[0].frame_count - 1);
page.redraw();
